// The meshers that there are: one file of this folder and one line in meshers.cpp each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "volume/mesher.h"
#include "volume/retries.h"

namespace kerf {

/// What a mesher makes of a body with F facets and volume V where tetrahedra of volume a are wanted, and what that
/// takes: means over many bodies. V/a is the integral of dV/a where sizes differ.
struct MesherForecast {
    double tets_per_facet;         ///< tetrahedra = tets_per_facet F
    double tets_per_volume_bound;  ///<              + tets_per_volume_bound V/a
    double most_tets_per_facet;    ///< the first of them where there must be room: four fifths of all bodies have less
    double seconds_per_facet;      ///< of one worker, at the pace of a core of 2.5 GHz
    double seconds_per_tet;        ///< beside them
    double bytes_per_tet;          ///< resident, of its worker
    double volume_weight;          ///< work = F + volume_weight V/a, in the units of LoadModel
    double most_tets;              ///< that one call can count
};

/// The mesher `lattice` has this one, and so has who asks it: of twelve surfaces with 5,000 to 330,000 facets and no
/// size, ten have 1.6 to 2.7 tetrahedra for each facet.
inline constexpr MesherForecast lattice_forecast = {.tets_per_facet = 2.1,
                                                    .tets_per_volume_bound = 1.7,
                                                    .most_tets_per_facet = 2.5,
                                                    .seconds_per_facet = 6e-6,
                                                    .seconds_per_tet = 1e-6,
                                                    .bytes_per_tet = 70,
                                                    .volume_weight = 0.1,
                                                    .most_tets = (std::int64_t{1} << 31) - 2};

/// What repeats a failed call without Kerf.
struct Reproducer {
    std::string ending;   ///< of the file beside the text that tells of the failure, with its dot
    std::string bytes;    ///< of that file
    std::string command;  ///< to be run in its folder
    std::string note;     ///< what the command leaves out: whole lines, or nothing
};

/// One way to fill surfaces. No function is null. None checks what check_mesher_options() and mesh_volume() do.
struct Mesher {
    const char* name;  ///< of --mesher
    MesherForecast forecast;

    /// Throws Error(usage), naming the option, for what this mesher does not take.
    void (*check)(const MesherOptions& options);
    /// See mesh_volume().
    Filling (*fill)(const SurfaceArrays& surface, const MesherOptions& options);
    /// See mesher_calls(). The calls may name another mesher.
    std::vector<MesherCall> (*calls)(const MesherOptions& wanted);
    /// The files are called `stem` and their endings.
    Reproducer (*reproducer)(const SurfaceArrays& surface, const MesherOptions& options, const std::string& stem);
};

/// All of them, in the order of the help; the first one is the default.
std::span<const Mesher* const> meshers();
/// The names of all meshers, in the order of the table.
std::vector<std::string> mesher_names();
/// Finds one by its name. Throws Error(usage) with the names that there are.
const Mesher& find_mesher(std::string_view name);

/// Improves the cells of a filling with dihedral angles below the threshold, if that is wanted, and says so in it: a
/// mesher's last step.
void improve_filling(Filling& filling, const MesherOptions& options,
                     double threshold_deg = ImproveOptions().threshold_deg);

/// A closed surface with its hole points as a .smesh of TetGen, counted from 0, with 17 digits: Kerf reads it, too. No
/// hole points where one cannot be found: that may be the very reason of a failure.
std::string smesh_text(const SurfaceArrays& surface);

}  // namespace kerf

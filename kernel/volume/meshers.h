// The meshers that there are: one file of this folder and one line in meshers.cpp each.
#pragma once

#include <array>
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
    /// Tetrahedra for each facet, beside those of the volume, where the edge that is wanted there over that of the
    /// facet is 1/4, 1/4 sqrt(2), 1/2, ... 8: coarse facets have a neighbourhood of small cells, fine ones one that
    /// grows.
    std::array<double, 11> tets_by_edge_ratio;
    double tets_per_volume_bound;  ///< of a constant size, in V/a
    double tets_per_sized_volume;  ///< the same where sizes differ
    double most_tets_per_facet;    ///< where there must be room: four fifths of all bodies have less
    double seconds_per_facet;      ///< of one worker, at the pace of a core of 2.5 GHz
    double seconds_per_tet;        ///< beside them
    double bytes_per_tet;          ///< resident, of its worker
    double volume_weight;          ///< work = F + volume_weight V/a, in the units of LoadModel
    double most_tets;              ///< that one call can count
};

/// The mesher `lattice` has this one, and so has who asks it. Of 10 surfaces of well-shaped facets and 8 sizes between
/// a quarter of their edges and eight of them, nearly all meshes have 0.9 to 1.1 times as many tetrahedra; with no
/// size, surfaces of any shape have 1.2 to 6.6 for each facet. Where sizes differ there are 0.7 to 1.15 times as many.
inline constexpr MesherForecast lattice_forecast = {
    .tets_by_edge_ratio = {31, 11, 1.6, 0.9, 0.48, 0.43, 1, 1.6, 2.05, 2.2, 2.3},
    .tets_per_volume_bound = 1.667,
    .tets_per_sized_volume = 1.25,
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

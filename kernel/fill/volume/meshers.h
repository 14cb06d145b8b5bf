// The table of meshers: one file of this folder and one line in meshers.cpp for each.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fill/volume/mesher.h"
#include "fill/volume/retries.h"

namespace kerf {

/// The known numbers of tetrahedra, time and memory of a mesher, for a body with F facets and volume V where tetrahedra
/// of volume a are wanted: means over many bodies. Where sizes differ, V/a stands for the integral of dV/a.
struct MesherForecast {
    /// Tetrahedra for each facet, beside those of the volume. Entry i is for a ratio of 2^(i/2 - 2), from 1/4 to 8, of
    /// the edge that is wanted there over that of the facet: coarse facets have a neighbourhood of small cells, fine
    /// ones one in which cells grow.
    std::array<double, 11> tets_by_edge_ratio;
    double tets_per_volume_bound;  ///< tetrahedra of the volume for a constant size, in V/a
    double tets_per_sized_volume;  ///< tetrahedra of the volume where sizes differ, in V/a
    double most_tets_per_facet;    ///< number for all that must have room: four fifths of all bodies have less
    double seconds_per_facet;      ///< seconds of one worker, at the pace of a core of 2.5 GHz
    double seconds_per_tet;        ///< seconds beside those of facets
    double bytes_per_tet;          ///< resident memory of its worker
    double volume_weight;          ///< work = F + volume_weight V/a, in the units of LoadModel
    double most_tets;              ///< most tetrahedra that one call can count
};

/// The forecast of the mesher `lattice`, and of those that ask it. Of 10 surfaces of well-shaped facets and 8 sizes
/// between a quarter of their edges and eight of them, nearly all meshes have 0.9 to 1.1 times as many tetrahedra; with
/// no size, surfaces of any shape have 1.2 to 6.6 for each facet. Where sizes differ there are 0.7 to 1.15 times as
/// many.
inline constexpr MesherForecast lattice_forecast = {
    .tets_by_edge_ratio = {31, 11, 1.6, 0.9, 0.48, 0.43, 1, 1.6, 2.05, 2.2, 2.3},
    .tets_per_volume_bound = 1.667,
    .tets_per_sized_volume = 1.87,
    .most_tets_per_facet = 2.5,
    .seconds_per_facet = 6e-6,
    .seconds_per_tet = 1e-6,
    .bytes_per_tet = 70,
    .volume_weight = 0.1,
    .most_tets = (std::int64_t{1} << 31) - 2};

/// A file and a command that repeat a failed call without Kerf.
struct Reproducer {
    std::string ending;   ///< ending of the file beside the text that tells of the failure, with its dot
    std::string bytes;    ///< content of that file
    std::string command;  ///< command to be run in its folder
    std::string note;     ///< whole lines on options that the command leaves out; empty if there are none
};

/// One way to fill surfaces. No function is null. None of them repeats the checks of check_mesher_options() and
/// mesh_volume().
struct Mesher {
    const char* name;  ///< value of --mesher
    MesherForecast forecast;

    /// Throws Error(usage), naming the option, for options that this mesher does not take.
    void (*check)(const MesherOptions& options);
    /// Fills a surface, see mesh_volume().
    Filling (*fill)(const SurfaceArrays& surface, const MesherOptions& options);
    /// Returns the calls for mesher_calls(). They may name another mesher.
    std::vector<MesherCall> (*calls)(const MesherOptions& wanted);
    /// Makes the reproducer of a failed call. Its files are called `stem` and their endings.
    Reproducer (*reproducer)(const SurfaceArrays& surface, const MesherOptions& options, const std::string& stem);
};

/// Returns all meshers, in the order of the help; the first one is the default.
std::span<const Mesher* const> meshers();
/// Returns the names of all meshers, in the order of the table.
std::vector<std::string> mesher_names();
/// Returns the mesher with a name. Throws Error(usage) with all names if there is none.
const Mesher& find_mesher(std::string_view name);

/// Improves the cells of a filling with dihedral angles below the threshold, if that is wanted, and counts that in it:
/// a mesher's last step.
void improve_filling(Filling& filling, const MesherOptions& options,
                     double threshold_deg = ImproveOptions().threshold_deg);

/// Returns the reproducer of a call by a command that reads a .smesh of TetGen: the closed surface with its hole
/// points, counted from 0, with 17 digits, which Kerf reads, too. There are no hole points where one cannot be found:
/// that may be the very reason of a failure. The note tells of sizes that differ, which no command can express.
Reproducer smesh_reproducer(const SurfaceArrays& surface, const MesherOptions& options, std::string command);

}  // namespace kerf

// Kerf for other programs: a closed surface goes in, tetrahedra come out, as arrays or as a run folder.
//
// This header is the promise of an installed Kerf; all that it needs is the standard library. A call that fails throws
// kerf::Error: its code is an exit code of docs/output.md, its message a sentence for people, its elements() the
// numbers and places of the defects. Calls may come from any thread, one after another; results depend on the surface
// and the options alone.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/core/error.h"

// The folder of kerf-worker, which the package of CMake defines.
#ifndef KERF_PROGRAMS_FOLDER
#define KERF_PROGRAMS_FOLDER ""
#endif

namespace kerf {

/// Returns the version of the library, major.minor.patch.
const char* library_version();

/// Options by their names and values on the command line: {{"radius-edge", "1.2"}, {"voids", "parity"}}.
using NamedOptions = std::vector<std::pair<std::string, std::string>>;

/// A question that is asked often while a call goes on, from any thread, also where there is no progress to tell of.
/// The answer true ends the call with Error(cancelled). Must not throw, and should be quick.
using IsCancelled = std::function<bool()>;

struct Input;

/// A closed surface that can be meshed. Copies share their data, which never changes.
class ClosedSurface {
 public:
    std::int64_t vertex_count() const;
    std::int64_t facet_count() const;
    double volume() const;  ///< enclosed, in cubed units of the input
    double area() const;
    std::vector<std::array<double, 3>> vertices() const;
    std::vector<std::array<std::int32_t, 3>> facets() const;  ///< corners counter-clockwise, seen from outside
    std::vector<std::int32_t> patches() const;                ///< of each facet: an index into patch_names()
    const std::vector<std::string>& patch_names() const;
    std::vector<std::string> region_names() const;           ///< empty if there is one region
    std::vector<std::array<std::int32_t, 2>> sides() const;  ///< of each facet: see surface_of_regions()
    std::vector<std::string> notes() const;                  ///< what was changed: the lines that `kerf mesh` prints

    explicit ClosedSurface(std::shared_ptr<const Input> input) : input_(std::move(input)) {}
    const Input& input() const { return *input_; }  ///< for Kerf itself

 private:
    std::shared_ptr<const Input> input_;
};

/// A defect of a surface: an error, or a cause of bad cells.
struct SurfaceDefect {
    std::string kind;                    ///< "open edge loop", ... as kerf check names it
    std::string severity;                ///< "error", "repaired": before meshing, or "warning": cells may be bad there
    std::vector<std::int64_t> facets;    ///< numbers of the input, counted from 0
    std::vector<std::int64_t> vertices;  ///< likewise; of a loop in the order of going around
    std::vector<std::array<double, 3>> points;  ///< of the vertices; a place at the defect if there are none
    double measure = 0;                ///< length of a loop or an edge, a needle's angle in degrees, a distance
    std::vector<std::string> regions;  ///< the regions that have it, or between which it is; empty for a single region
    std::string advice;                ///< the remedy
    std::string text;                  ///< the whole as a sentence
};

/// Error(input) of a surface that cannot be meshed as it is, with all its defects, in the order of kinds.
class SurfaceError : public Error {
 public:
    SurfaceError(const Error& error, std::vector<SurfaceDefect> defects)
        : Error(error), defects_(std::make_shared<const std::vector<SurfaceDefect>>(std::move(defects))) {}
    const std::vector<SurfaceDefect>& defects() const { return *defects_; }

 private:
    std::shared_ptr<const std::vector<SurfaceDefect>> defects_;  // copies of an exception must not throw
};

/// Makes the surface of arrays. `facets`: corners as numbers of vertices, counted from 0; facets that are turned
/// against each other are turned. `patches`: a number from 0 for each facet, or empty: one patch. `patch_names`: a name
/// for each number, or empty. `options`: those of the surface, as "weld", "voids", "fill-holes" (docs/options.md).
///
/// Everything is checked. Throws Error(usage) for sizes that do not fit, SurfaceError for a row that is wrong and for a
/// surface that is not closed or intersects itself: elements() has the numbers of vertices and facets. `is_cancelled`
/// ends repairs and wraps.
ClosedSurface surface_from_arrays(std::span<const std::array<double, 3>> vertices,
                                  std::span<const std::array<std::int32_t, 3>> facets,
                                  std::span<const std::int32_t> patches = {}, std::vector<std::string> patch_names = {},
                                  const NamedOptions& options = {}, const IsCancelled& is_cancelled = {});

/// Makes the surface of several bodies that share walls, each facet once. `sides`: of each facet the regions behind it
/// and in front of it, where its corners are counter-clockwise, as numbers of `region_names`, or -1: outside. The other
/// arguments are as for surface_from_arrays(); facets are not turned. Throws as that does, and SurfaceError for a facet
/// with the same on both sides and a region that its facets do not close, with its name.
ClosedSurface surface_of_regions(std::span<const std::array<double, 3>> vertices,
                                 std::span<const std::array<std::int32_t, 3>> facets,
                                 std::span<const std::array<std::int32_t, 2>> sides,
                                 std::vector<std::string> region_names, std::span<const std::int32_t> patches = {},
                                 std::vector<std::string> patch_names = {}, const NamedOptions& options = {},
                                 const IsCancelled& is_cancelled = {});

/// Reads the surface of a file of any format that `kerf mesh` reads. Throws Error(io) and as surface_from_arrays()
/// does.
ClosedSurface surface_from_file(const std::string& path, const NamedOptions& options = {},
                                const IsCancelled& is_cancelled = {});

/// Writes an .obj with patches, of several regions with a closed group for each instead, a .vtp or .vtk with patches
/// and regions, a .ply or .off without, or an .stl, whose coordinates have 7 digits. Throws Error(usage) for another
/// ending, and for regions in a file that cannot tell them apart, Error(io).
void surface_to_file(const ClosedSurface& surface, const std::string& path);

/// The answer of `kerf check` about a surface.
struct SurfaceCheck {
    bool can_be_meshed = false;
    std::string text;                    ///< lines for people
    std::string json;                    ///< every defect, and counts
    std::vector<SurfaceDefect> defects;  ///< if there is no surface, the reason: one without facets or vertices
};
using FileCheck = SurfaceCheck;

/// Checks a file. `needle_angle`: degrees below which a facet is a needle, 0 to 60. Throws Error(io) for a file that
/// cannot be opened, Error(usage) for options out of range.
SurfaceCheck check_file(const std::string& path, const NamedOptions& options = {}, double needle_angle = 1,
                        const IsCancelled& is_cancelled = {});

/// Checks arrays as surface_of_regions() takes them; with empty `sides` and `region_names` as surface_from_arrays()
/// does. Throws Error(usage) for sizes that do not fit, and options out of range.
SurfaceCheck check_arrays(std::span<const std::array<double, 3>> vertices,
                          std::span<const std::array<std::int32_t, 3>> facets,
                          std::span<const std::array<std::int32_t, 2>> sides = {},
                          std::vector<std::string> region_names = {}, std::span<const std::int32_t> patches = {},
                          std::vector<std::string> patch_names = {}, const NamedOptions& options = {},
                          double needle_angle = 1, const IsCancelled& is_cancelled = {});

/// A listener to the stages of a call, with steps that are done of all, 0 if their number is unknown. The answer false
/// ends the call with Error(cancelled). Must not throw.
using Progress = std::function<bool(const char* stage, std::size_t done, std::size_t total)>;

/// Returns a surface with triangles worth meshing, nowhere farther than `deviation` from the given one, 0: a twentieth
/// of `size`. `size`: wanted edge length, 0: as long as the deviation allows. Both in units of the surface. Patches
/// stay.
ClosedSurface remeshed(const ClosedSurface& surface, double deviation, double size = 0, const Progress& progress = {},
                       const IsCancelled& is_cancelled = {});
/// Returns the remeshed surface for options of `kerf remesh` on sizes, by their names: "size", "deviation", "cells",
/// "size-on", ... Throws Error(usage) for others.
ClosedSurface remeshed(const ClosedSurface& surface, const NamedOptions& options, const Progress& progress = {},
                       const IsCancelled& is_cancelled = {});

/// Wanted edge lengths at the vertices of tetrahedra that cover the surface: linear in these, and growing away from
/// them outside. Cells may have any orientation and overlap: then the smaller size counts.
struct GivenSizes {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::array<std::int32_t, 4>> tets;
    std::vector<double> sizes;  ///< #vertices; positive, in units of the surface
};

/// Throws Error(input), naming the row, for a place, a length or a corner that is none; else does nothing.
void check_sizes(const GivenSizes& sizes);

struct MeshOptions {
    double size = 0;                              ///< wanted edge length, in units of the surface; 0: none
    std::int32_t parts = 0;                       ///< number of parts; 0: as many as are of use here
    std::int32_t workers = 0;                     ///< processes that mesh parts; 0: one for each processor
    NamedOptions others = {};                     ///< of `kerf mesh` (docs/options.md), but none of the surface
    std::string programs = KERF_PROGRAMS_FOLDER;  ///< folder of kerf-worker, looked at first
    Progress progress = {};
    IsCancelled is_cancelled = {};
    std::shared_ptr<const GivenSizes> sizes = {};  ///< beside `size`: the smallest length at a point counts
};

/// A part that could not be meshed.
struct FailedPart {
    std::int32_t number = 1;        ///< in the tree of cuts
    std::array<double, 3> place{};  ///< its centre of mass
    std::string message;            ///< the reason
    std::string reproducer;         ///< file of the run folder that says how to repeat it; gone with a temporary one
};

/// The error of parts that could not be meshed: Error(subdomain), or Error(memory) if all ran out of it.
class PartsFailed : public Error {
 public:
    PartsFailed(ErrorCode code, const std::string& message, std::vector<FailedPart> parts)
        : Error(code, message), parts_(std::make_shared<const std::vector<FailedPart>>(std::move(parts))) {}
    const std::vector<FailedPart>& parts() const { return *parts_; }

 private:
    std::shared_ptr<const std::vector<FailedPart>> parts_;  // copies of an exception must not throw
};

/// One mesh of all parts.
struct MeshArrays {
    std::vector<std::array<double, 3>> vertices;         ///< for order 2 all nodes: those on edges follow the vertices
    std::vector<std::array<std::int64_t, 4>> tets;       ///< corners a, b, c, d with det[b-a, c-a, d-a] > 0
    std::vector<std::int32_t> part;                      ///< #tets; number of its part in the tree of cuts
    std::vector<std::array<std::int64_t, 3>> triangles;  ///< of the boundary, counter-clockwise seen from outside, and
                                                         ///< of walls, each once
    std::vector<std::int32_t> patch;                     ///< #triangles; an index into patch_names
    std::vector<std::string> patch_names;
    std::vector<std::int32_t> region;                ///< #tets; an index into region_names, 0 if there is one region
    std::vector<std::string> region_names;           ///< empty if there is one region
    std::vector<std::array<std::int32_t, 2>> sides;  ///< #triangles; regions behind and in front, -1: outside
    std::string report = {};                         ///< report.json of the run (docs/output.md); may be empty
    std::int64_t edge_nodes = 0;  ///< for order 2: number of nodes on edges among `vertices`; for order 1 0
    /// For order 2, else empty: the nodes of the rows of `tets` and `triangles`, corners first, then those of the edges
    /// 01 12 02 03 13 23, and 01 12 02.
    std::vector<std::array<std::int64_t, 10>> quadratic_tets = {};
    std::vector<std::array<std::int64_t, 6>> quadratic_triangles = {};
};

/// Meshes in memory, but for files of the parts in a temporary folder (TMPDIR), which is gone when this returns or
/// throws. Every law of the mesh is verified. Memory: that of the result and a few megabytes for each worker, once the
/// surface is cut. Throws PartsFailed if a part could not be meshed, Error(input) for given sizes that are no
/// sizes, Error(usage) for options that ask for files of formats, and as mesh_to_folder() does.
MeshArrays mesh_to_arrays(const ClosedSurface& surface, const MeshOptions& options = {});

/// Meshes into a run folder (docs/output.md), which replaces an older run there. Throws Error(usage) for an option out
/// of range, Error(io) for a folder that cannot be written or holds anything else, Error(subdomain) if parts could not
/// be meshed (PartsFailed): the others are in the folder then. The finished parts of an interrupted run into that
/// folder are taken over, if it is the same run.
void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder);

/// Meshes a file of any format that `kerf mesh` reads, as that does, into a run folder: `others` may be options of the
/// surface, too.
void mesh_file_to_folder(const std::string& path, const MeshOptions& options, const std::string& folder);

/// Returns the mesh of a finished run, or of a solution, with the nodes that this has. Throws Error(io).
MeshArrays arrays_of_run(const std::string& folder);

struct MeshFileOptions {
    std::string msh_version = "4.1";  ///< of Gmsh's files: 4.1 or 2.2
    bool msh_ascii = false;           ///< Gmsh's files as text
    IsCancelled is_cancelled = {};    ///< asked now and then
};

/// Writes a mesh into a file, whose ending chooses the format, as `kerf merge` does. Its arrays must be as the
/// functions above return them. Throws Error(usage) for another ending, naming those that there are, and Error(io).
void mesh_to_file(const MeshArrays& mesh, const std::string& path, const MeshFileOptions& options = {});
/// Returns for each tetrahedron those on the other sides of the faces opposite to its corners, -1 outside. O(n), some
/// 110 ns a tetrahedron. Throws Error(usage) for more than 2^31 vertices or tetrahedra, and so do the functions below.
std::vector<std::array<std::int64_t, 4>> neighbours_of(const MeshArrays& mesh);

/// Returns a measure of each tetrahedron: min-dihedral, max-dihedral (degrees), radius-edge, aspect, shape, volume,
/// min-edge, max-edge. Some 60 ns each. Throws Error(usage) for a name that is none of them.
std::vector<double> cell_quality(const MeshArrays& mesh, const std::string& measure);

/// The output of `kerf quality` for a run with this mesh, but for its path.
struct QualityTexts {
    std::string text;  ///< its tables
    std::string json;  ///< output of --json
};
/// Measures the mesh. Some 200 ns a tetrahedron; memory: of one part at a time.
QualityTexts quality_texts(const MeshArrays& mesh);

}  // namespace kerf

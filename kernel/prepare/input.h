// From a surface file to the closed surface that is cut.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"
#include "prepare/input_files.h"
#include "remesh/remesh.h"
#include "repair/repair_report.h"
#include "repair/wrap.h"
#include "request/input_options.h"
#include "size/size_options.h"
#include "surface/complex.h"
#include "surface/diagnosis.h"
#include "surface/orientation.h"

namespace kerf {

class StageListener;

/// What was repaired.
struct InputRepairs {
    std::int64_t welded_vertices = 0;  ///< merged because their coordinates are equal
    std::int64_t unused_vertices = 0;  ///< dropped because no facet uses them
    std::int64_t dropped_facets = 0;   ///< copies, and facets with a repeated vertex
    std::int64_t merged_vertices = 0;  ///< by weld_tolerance
    std::int64_t removed_facets = 0;   ///< by keep_largest
    std::int64_t filled_holes = 0;     ///< by fill_hole_edges
    std::int64_t added_facets = 0;     ///< in these holes
};

/// A surface file after the repairs that come before orientation, and what is wrong with it.
struct CheckedSoup {
    Soup soup;
    Diagnosis diagnosis;  ///< of `soup`, in which dropped facets still are
    InputRepairs repairs;
    double weld_tolerance = 0;  ///< that was used, units of the file
    RepairReport ladder = {};   ///< what InputOptions::repair did
    std::optional<WrapReport> wrapped = {};
};

/// Error(input) of a surface that cannot be meshed as it is, with all that was found.
class UnfitSurface : public Error {
 public:
    UnfitSurface(const std::string& message, CheckedSoup checked)
        : Error(ErrorCode::input, message, checked.diagnosis.elements(checked.soup)),
          checked_(std::make_shared<const CheckedSoup>(std::move(checked))) {}
    const CheckedSoup& checked() const { return *checked_; }

 private:
    std::shared_ptr<const CheckedSoup> checked_;  // copies of an exception must not throw
};

/// Error(input) of a row of an array.
class WrongRow : public Error {
 public:
    static constexpr const char* kind = "wrong row";
    WrongRow(const std::string& message, const ErrorElements& rows) : Error(ErrorCode::input, message, {rows}) {}
};

/// What remeshing, or division, did to a surface (prepare/remeshing.h).
struct InputRemeshing {
    std::int64_t facets_before = 0;
    std::int64_t facets_kept = 0;  ///< of these, because no sliver is near, or because they are as small as wanted
    bool only_divided = false;     ///< the shape is the same
    double smallest_angle_before_deg = 0, smallest_angle_deg = 0;
    double deviation = 0;  ///< that was allowed, units of the input
    double distance_to_input = 0,
           distance_from_input = 0;           ///< largest that was found, of the new surface and of the old
    std::int64_t feature_edges = 0;           ///< of the new surface
    FinerShares finer = {};                   ///< where its shape asks for smaller edges than sizes do, if any
    std::vector<double> volumes_before = {};  ///< of the regions
    /// Whether the volume may be another: where a deviation was asked for, where the surface is a wrap, and before
    /// vertices are put on the curved faces of a CAD model.
    bool may_change_volume = false;
};

/// The volume of a region may differ by this share from that before the surface was remeshed.
inline constexpr double largest_volume_change = 1e-3;

/// One of several regions.
struct InputRegion {
    std::int64_t facets = 0;
    std::int64_t components = 0;
    double volume = 0;
    double volume_error = 0;  ///< as BoundedVolume has it
    double area = 0;
};

/// Surfaces ready to be cut, and what was learnt about them.
struct Input {
    std::string path;
    std::string file_hash;  ///< of the file's bytes, or of the arrays, see hash_text()
    std::int64_t vertices = 0;
    std::int64_t facets = 0;
    std::int64_t components = 0;       ///< shells of all regions
    std::int64_t genus = 0;            ///< sum over the components
    double volume = 0;                 ///< of all regions
    double volume_error = 0;           ///< as BoundedVolume has it
    double area = 0;                   ///< each facet once
    std::vector<InputRegion> regions;  ///< of Complex::region_names(), in their order; empty if there is only one
    double largest_coordinate = 0;     ///< as an absolute value
    double diagonal = 0;               ///< of the bounding box
    InputRepairs repairs;
    double weld_tolerance = 0;  ///< that was used, units of the input
    OrientationReport orientation;
    std::int64_t moved_vertices = 0;  ///< by the optimisation of the surface
    double largest_move = 0;          ///< of a vertex by that
    std::optional<InputRemeshing> remeshed;
    std::vector<std::string> patch_names;
    std::vector<std::array<std::uint8_t, 4>> patch_colours;  ///< as Soup has them; empty: none
    std::vector<std::string> notes;                          ///< what the reader passed over
    bool is_cad = false;                                     ///< a file of curved faces, not of triangles
    bool is_ready = false;                                   ///< run() takes it as it is, and reads no file
    /// Edges of the surface as it was read that are creases of a CAD model, flat as they may be.
    std::vector<UndirectedEdge> creases;
    Complex complex;
    /// Volume that cells may have at most, as the file says it for each region; 0: it does not. Empty: for none.
    std::vector<double> largest_cells = {};
    RepairReport ladder = {};  ///< what InputOptions::repair did
    std::optional<WrapReport> wrapped = {};
};

/// Reads (several files and CAD files, too: prepare/input_files.h), repairs, diagnoses. Throws Error only for a file
/// that cannot be read. `poll`: as of check_files().
CheckedSoup check_input(const std::string& path, const InputOptions& options = {}, double needle_angle_deg = 1,
                        const std::function<void()>& poll = {});

/// Checks what a reader returned. Where facets do not say what they bound, their regions are found
/// (surface/region_finder.h): by points, or because several bodies touch. Throws Error(input) for points that are
/// misplaced, and Error(usage) for points where there are regions already.
CheckedSoup check_soup(Soup soup, const InputOptions& options = {}, double needle_angle_deg = 1,
                       const std::function<void()>& poll = {});

/// Checks files that have been read: each is a body of its own, and those of several are regions. `poll`: as repair()
/// and wrap() call it.
CheckedSoup check_files(InputFiles files, const InputOptions& options = {}, double needle_angle_deg = 1,
                        const std::function<void()>& poll = {});

/// Drops the superfluous facets of a soup without errors, and orients it.
OrientationReport apply_repairs(CheckedSoup& checked);

/// The complex of a soup that has been repaired.
Complex make_complex(Soup soup);

/// Fills the counts, volume, area and genus from the surface.
void measure_input(Input& input);

/// Of all regions, before the surface was remeshed.
double volume_before_remeshing(const Input& input);

/// The volumes of the regions; of one region that of the whole.
std::vector<double> region_volumes(const Input& input);

/// Regions whose volume is another than before the surface was remeshed, by more than largest_volume_change, although
/// it should not be.
std::int64_t count_changed_volumes(const Input& input);

/// Bounds of volumes of cells for each region of the input: what SizeOptions::in_region says, else the file; 0:
/// nothing. Empty if nothing is said at all. Throws as SizeOptions::max_volumes_of_regions().
std::vector<double> max_volumes_of_regions(const SizeOptions& sizes, const Input& input);

/// What stands for the path of a surface that no file has.
inline constexpr const char* name_of_arrays = "surface in memory";

/// Checks arrays as make_input() takes them, `soup`: nothing but its vertices, facets, patches, names and sides. Throws
/// as that does, but not for a surface that cannot be meshed.
CheckedSoup check_arrays(Soup soup, const InputOptions& options = {}, double needle_angle_deg = 1,
                         const std::function<void()>& poll = {});

/// The input that read_input() makes of a file, of arrays. `patch`: a number from 0 for each facet, or empty: one
/// patch. `patch_names`: a name for each number, or empty: "patch_0", "patch_1", ... Vertices of equal coordinates are
/// one.
///
/// All is checked, in every build. Throws Error(usage) for sizes that do not fit, WrongRow for a coordinate that is not
/// finite, a corner that is no vertex, a facet with a repeated corner, and a patch without a name, and Error(input) for
/// all that read_input() refuses: the message names the first row, Error::elements() all of them. `poll`: as of
/// check_files(). O(#F log #F).
Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<std::int32_t> patch = {},
                 std::vector<std::string> patch_names = {}, const InputOptions& options = {},
                 const std::function<void()>& poll = {});

/// The same for several regions. `sides`: what lies on the sides of each facet, by numbers of `region_names`; each
/// facet is given once. Throws as above, and Error(input) for what a Complex refuses.
Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<FacetSides> sides,
                 std::vector<std::string> region_names, std::vector<std::int32_t> patch = {},
                 std::vector<std::string> patch_names = {}, const InputOptions& options = {},
                 const std::function<void()>& poll = {});

/// check_input() and apply_repairs(), then builds the surface. Throws UnfitSurface, naming the file, the
/// first offenders and what to do, if the surface has errors; Error::elements() has all. Throws Error(usage) if the
/// sweeps of the optimisation would make it intersect itself; else that surface takes the place of the file's in all
/// that follows. `listener`, unless null, is told of the stage "repair" where there is one, and ends it once it is
/// cancelled.
Input read_input(const std::string& path, const InputOptions& options = {}, StageListener* listener = nullptr);

}  // namespace kerf

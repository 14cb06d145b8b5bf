// The way from a surface file to the closed surface that is cut.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "run/prepare/input_files.h"
#include "run/request/input_options.h"
#include "surface/complex/complex.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/diagnosis/orientation.h"
#include "surface/enclosure/enclosure_options.h"
#include "surface/remesh/remesh.h"
#include "surface/repair/repair_report.h"
#include "surface/size/size_options.h"
#include "surface/wrap/wrap.h"

namespace kerf {

class StageListener;

/// Counts of what goes from every surface without being asked for.
struct TidyCounts {
    std::int64_t welded_vertices = 0;  ///< vertices merged because their coordinates are equal
    std::int64_t unused_vertices = 0;  ///< vertices dropped because no facet uses them
    std::int64_t dropped_facets = 0;   ///< copies, and facets with a repeated vertex
};

/// A surface file after the repairs that come before orientation, and the defects that are left.
struct CheckedSoup {
    Soup soup;
    Diagnosis diagnosis;  ///< defects of `soup`, which still has the facets that are dropped later
    TidyCounts tidied = {};
    RepairReport ladder = {};  ///< the steps of InputOptions::repairs
    std::optional<WrapReport> wrapped = {};
    OrientationReport orientation = {};            ///< of the bodies, where they were oriented to be enclosed
    std::optional<Enclosure> enclosure = {};       ///< the box around the bodies: the soup is its air
    std::vector<PatchFace> faces_of_patches = {};  ///< see InputFiles
};

/// Error(input) for a surface that cannot be meshed as it is, with all that was found.
class UnfitSurface : public Error {
 public:
    UnfitSurface(const std::string& message, CheckedSoup checked)
        : Error(ErrorCode::input, message, checked.diagnosis.elements(checked.soup)),
          checked_(std::make_shared<const CheckedSoup>(std::move(checked))) {}
    const CheckedSoup& checked() const { return *checked_; }

 private:
    std::shared_ptr<const CheckedSoup> checked_;  // copies of an exception must not throw
};

/// Error(input) for a row of an array.
class WrongRow : public Error {
 public:
    static constexpr const char* kind = "wrong row";
    WrongRow(const std::string& message, const ErrorElements& rows) : Error(ErrorCode::input, message, {rows}) {}
};

/// The smallest angles of facets, in degrees.
struct FacetAngles {
    double smallest = 0;       ///< of all
    double first_percent = 0;  ///< one in a hundred facets has a smaller one
};

/// Report of the remeshing, or division, of a surface (run/prepare/remeshing.h).
struct InputRemeshing {
    std::int64_t facets_before = 0;
    std::int64_t facets_kept = 0;  ///< facets of these that stay: no sliver is near, or they are as small as wanted
    bool only_divided = false;     ///< the shape is the same
    FacetAngles angles_before, angles;
    double deviation = 0;  ///< the deviation that was allowed, units of the input
    double distance_to_input = 0,
           distance_from_input = 0;  ///< largest distances that were found, from the new surface and from the old
    std::int64_t feature_edges = 0;  ///< feature edges of the new surface
    FinerShares finer = {};          ///< shares of edges that the shape wants smaller than sizes do, if any
    FacetsByReason facets_by = {};   ///< none if facets are divided alone
    Array<RegionIndex, double> volumes_before = {};  ///< volumes of the regions
    /// Whether the volume may change: where a deviation was asked for, where the surface is a wrap, and before vertices
    /// are put on the curved faces of a CAD model.
    bool may_change_volume = false;
};

/// The largest change of the volume of a region by remeshing, as a share of the volume.
inline constexpr double largest_volume_change = 1e-3;

/// Measures of one of several regions.
struct InputRegion {
    std::int64_t facets = 0;
    std::int64_t components = 0;
    double volume = 0;
    double volume_error = 0;  ///< see BoundedVolume
    double area = 0;
};

/// Measures of the surfaces of an input.
struct InputMeasures {
    std::int64_t vertices = 0;
    std::int64_t facets = 0;
    std::int64_t components = 0;              ///< shells of all regions
    std::int64_t genus = 0;                   ///< sum over the components
    double volume = 0;                        ///< sum over all regions
    double volume_error = 0;                  ///< see BoundedVolume
    double area = 0;                          ///< area of all facets, each once
    Array<RegionIndex, InputRegion> regions;  ///< one for each of Complex::region_names(); empty if there is only one
    double largest_coordinate = 0;            ///< the largest absolute value of a coordinate
};

/// Surfaces ready to be cut, and the facts about them that reports tell.
struct Input : InputMeasures {
    std::string path;
    std::string file_hash;                    ///< hash of the file's bytes, or of the arrays, see hash_text()
    double diagonal = 0;                      ///< diagonal of the bounding box
    std::optional<Enclosure> enclosure = {};  ///< the box around the bodies of the file: the surface is that of its air
    TidyCounts tidied;
    OrientationReport orientation;
    std::int64_t moved_vertices = 0;  ///< vertices moved by the optimisation of the surface
    double largest_move = 0;          ///< largest move of a vertex by it
    std::optional<InputRemeshing> remeshed;
    std::vector<std::string> patch_names;
    std::vector<std::array<std::uint8_t, 4>> patch_colours;  ///< see Soup; empty: none
    std::vector<std::string> notes;                          ///< remarks of the reader and of later stages
    bool is_cad = false;                                     ///< whether the file has curved faces, not triangles
    /// Edges of the surface as it was read that are creases of a CAD model, flat as they may be.
    std::vector<UndirectedEdge> creases;
    Complex complex;
    /// The largest volume of cells for each region, where the file says one, else 0. Empty: it says none.
    Array<RegionIndex, double> largest_cells = {};
    RepairReport ladder = {};  ///< the steps of InputOptions::repairs
    std::optional<WrapReport> wrapped = {};

    /// The diagonal of the box around the bodies of the file, of which lengths are percentages.
    double body_diagonal() const { return enclosure ? enclosure->diagonal() : diagonal; }
    /// The volume of which the change of a region's volume is a share: that of the region or, of air around bodies,
    /// that of the bodies, if it is less.
    double reference_volume(double of_region) const {
        return enclosure ? std::min(of_region, enclosure->body_volume) : of_region;
    }
};

/// Reads files (several files and CAD files, too: run/prepare/input_files.h), repairs and diagnoses them. Throws Error
/// only for a file that cannot be read. `check_cancelled`: see check_files().
CheckedSoup check_input(const std::string& path, const InputChoices& choices = {}, double needle_angle_deg = 1,
                        const std::function<void()>& check_cancelled = {});

/// Checks a soup that a reader returned. Where facets do not say which regions they bound, these are found
/// (surface/regions/region_finder.h): by points, or because several bodies touch. Throws Error(input) for points that
/// are misplaced, and Error(usage) for points where there are regions already.
CheckedSoup check_soup(Soup soup, const InputChoices& choices = {}, double needle_angle_deg = 1,
                       const std::function<void()>& check_cancelled = {});

/// Checks files that have been read: each is a body of its own, and several bodies are regions. `check_cancelled`:
/// called by repair() and wrap().
CheckedSoup check_files(InputFiles files, const InputChoices& choices = {}, double needle_angle_deg = 1,
                        const std::function<void()>& check_cancelled = {});

/// Drops the superfluous facets of a soup without errors, and orients it.
OrientationReport apply_repairs(CheckedSoup& checked);

/// Makes the complex of a soup that has been repaired.
Complex make_complex(Soup soup);

/// Fills the counts, volume, area and genus from the surface.
void measure_input(Input& input);

/// Returns the number of facets before the surface was remeshed or wrapped: those of the file, but for its repairs.
std::int64_t facets_of_file(const Input& input);

/// Returns the volume of all regions before the surface was remeshed.
double volume_before_remeshing(const Input& input);

/// Returns the volumes of the regions; for one region that of the whole.
Array<RegionIndex, double> region_volumes(const Input& input);

/// Returns the number of regions whose volume differs from that before the surface was remeshed by more than
/// largest_volume_change, although it should not.
std::int64_t count_changed_volumes(const Input& input);

/// Returns bounds of volumes of cells for each region of the input: that of SizeOptions::in_region, else that of the
/// file, else 0. Empty if there are none at all. Throws as SizeOptions::max_volumes_of_regions().
Array<RegionIndex, double> max_volumes_of_regions(const SizeOptions& sizes, const Input& input);

/// The name of a surface that no file has, in the place of a path.
inline constexpr const char* name_of_arrays = "surface in memory";

/// Checks arrays as make_input() takes them. `soup`: nothing but its vertices, facets, patches, names and sides. Throws
/// as make_input(), but not for a surface that cannot be meshed.
CheckedSoup check_arrays(Soup soup, const InputChoices& choices = {}, double needle_angle_deg = 1,
                         const std::function<void()>& check_cancelled = {});

/// Makes the same input of arrays that read_input() makes of a file. `patch`: a number from 0 for each facet, or empty:
/// one patch. `patch_names`: a name for each number, or empty: "patch_0", "patch_1", ... Vertices of equal coordinates
/// are one.
///
/// All is checked, in every build. Throws Error(usage) for sizes that do not fit, WrongRow for a coordinate that is not
/// finite, a corner that is no vertex, a facet with a repeated corner, and a patch without a name, and Error(input) for
/// all that read_input() refuses: the message names the first row, Error::elements() all of them. `check_cancelled`:
/// see check_files(). O(#F log #F).
Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<std::int32_t> patch = {},
                 std::vector<std::string> patch_names = {}, const InputChoices& choices = {},
                 const std::function<void()>& check_cancelled = {});

/// Makes an input of several regions. `sides`: the regions on the sides of each facet, by numbers of `region_names`;
/// each facet is given once. Throws as the other make_input(), and Error(input) for arrays that a Complex refuses.
Input make_input(std::vector<Vec3> vertices, std::vector<Triangle> facets, std::vector<FacetSides> sides,
                 std::vector<std::string> region_names, std::vector<std::int32_t> patch = {},
                 std::vector<std::string> patch_names = {}, const InputChoices& choices = {},
                 const std::function<void()>& check_cancelled = {});

/// Reads a file: check_input() and apply_repairs(), then builds the surface. Throws UnfitSurface, naming the file, the
/// first offenders and the way out, if the surface has errors; Error::elements() has all. Throws Error(usage) if the
/// sweeps of the optimisation would make it intersect itself; else the optimised surface takes the place of the file's
/// from there on. `listener`, unless null, is told of the stage "repair" where there is one, and ends it once it is
/// cancelled.
Input read_input(const std::string& path, const InputChoices& choices = {}, StageListener* listener = nullptr);

}  // namespace kerf

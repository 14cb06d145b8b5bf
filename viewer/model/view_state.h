// What is shown and how, as one value: the window, the command line and the tests share it, and it is a JSON file.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cut/cut.h"
#include "request/options.h"
#include "viewer/model/camera.h"
#include "viewer/model/stage.h"

namespace kerf::view {

enum class Shading { flat, smooth };

enum class ClipStyle {
    cells,   ///< whole cells: those whose centre is on the shown side (crinkle)
    smooth,  ///< cells are cut at the plane
    layer,   ///< only the cells that the plane crosses
};

/// The half space on the side of -normal is shown, or the other one if flipped.
struct Clip {
    bool on = false;
    ClipStyle style = ClipStyle::cells;
    Vec3 normal = Vec3::UnitX();
    double position = 0.5;  ///< along the normal, 0 and 1 at the ends of the body's bounding box
    bool flipped = false;

    bool operator==(const Clip&) const = default;
};

struct ValueRange {
    double low = 0, high = 0;

    bool operator==(const ValueRange&) const = default;
};

/// Of n.p over the points p of a box: what Clip::position is a fraction of.
ValueRange extent_along(const Eigen::AlignedBox3d& box, const Vec3& n);
/// Makes the clip plane coincide with a plane that meets the box.
void snap_to(Clip& clip, const Plane& plane, const Eigen::AlignedBox3d& box);

/// What the colour of a cell or facet means.
enum class ColorBy {
    part,
    rank,
    level,   ///< of the tree at which its interface was cut; of cells: the level of the part
    region,  ///< of several, in which the part lies
    patch,
    deviation,  ///< of a facet: its distance from the surface before or after remeshing
    size,       ///< edge length that the size field asks for
    kind,       ///< cells at an interface and inner cells
    origin,     ///< of cells: see CellOrigin
    min_dihedral,
    radius_edge,
    aspect,
    shape,
    volume,
    edge_length,   ///< the longest
    error,         ///< of a solution: the estimate for a cell
    displacement,  ///< its length
    von_mises,
    stress_xx,
    stress_yy,
    stress_zz,
    stress_xy,
    stress_yz,
    stress_xz,
};
inline constexpr int color_by_count = static_cast<int>(ColorBy::stress_xz) + 1;
/// Of the shape of cells.
constexpr bool is_measure(ColorBy color) { return color >= ColorBy::min_dihedral && color <= ColorBy::edge_length; }
constexpr bool is_of_solution(ColorBy color) { return color >= ColorBy::error; }
constexpr bool is_at_vertices(ColorBy color) { return color >= ColorBy::displacement; }
/// A mode of vibration does not have it.
constexpr bool needs_load_case(ColorBy color) { return is_of_solution(color) && color != ColorBy::displacement; }
constexpr bool is_stress(ColorBy color) { return color >= ColorBy::von_mises; }
/// Cells are of few kinds, which the legend names.
constexpr bool is_kind(ColorBy color) { return color == ColorBy::kind || color == ColorBy::origin; }
/// Only cells have it.
constexpr bool is_of_cells(ColorBy color) { return is_measure(color) || is_kind(color) || is_of_solution(color); }
/// Has values on surfaces, those of parts included, and none in cells.
constexpr bool is_of_surface(ColorBy color) { return color == ColorBy::deviation || color == ColorBy::size; }

/// How the deformation of a solution moves, once around while ViewState::phase goes from 0 to 1.
enum class Motion {
    still,  ///< all of it
    swing,  ///< to both sides: the cosine of the phase, 1 to -1 to 1
    rise,   ///< between all and nothing: 1 to 0 to 1, smoothly
};
/// Of the whole deformation, at a phase.
double share_of_motion(Motion motion, double phase);

inline constexpr double least_percentile = 60;  ///< of ViewState::percentile

enum class Theme { light, dark };

/// Puts an item into an ascending list, or takes it out.
template <class T>
void set_member(std::vector<T>& ascending, const T& item, bool is_member) {
    const auto place = std::lower_bound(ascending.begin(), ascending.end(), item);
    const bool is_there = place != ascending.end() && *place == item;
    if (is_member && !is_there) ascending.insert(place, item);
    if (!is_member && is_there) ascending.erase(place);
}

/// What a click selects.
enum class PickMode { facet, cell, vertex };

struct Selection {
    enum class Kind { none, facet, cell, vertex, place, defect };
    Kind kind = Kind::none;
    NodeId owner = 0;           ///< node or part whose numbers follow
    std::int32_t index = -1;    ///< of the facet, cell or vertex there, or in Diagnosis::defects
    Vec3 place = Vec3::Zero();  ///< of the click, or of a defect

    bool operator==(const Selection&) const = default;
};

struct Panels {
    bool tree = true, display = true, timeline = true, keys = false, parameters = false, quality = false,
         problems = true;

    bool operator==(const Panels&) const = default;
};

struct ViewState {
    NodeId node = 1;
    Step step;
    std::optional<Camera> camera;  ///< none: everything fits, seen from the corner
    Shading shading = Shading::flat;
    bool edges = true;    ///< of triangles
    bool context = true;  ///< the rest of the body, translucent
    bool plane = true;
    bool axes = true;  ///< principal axes and centre of gravity
    bool contour = true;
    bool features = false;  ///< sharp edges and borders of patches
    bool surface = true;
    bool interfaces = true;
    double explode = 0;  ///< 0: together; 1: as far apart as the parts are large
    double shrink = 0;   ///< of cells about their centres, 0: none, 1: to points
    Clip clip;
    ColorBy color = ColorBy::part;
    std::optional<ValueRange> color_range;  ///< none: that of what is shown
    std::optional<ValueRange> filter;       ///< only cells with a value of `color` in it
    bool neighbours = false;                ///< of a selected cell: only it and the cells that share a vertex with it
    /// Where nobody has given a range, colours of stresses span so many per cent of the values that are drawn: single
    /// vertices at corners have far larger ones than all others.
    double percentile = 99;
    bool isolines = false;  ///< where values at vertices are alike
    bool extremes = false;  ///< the places of the least and the largest value are marked
    bool vectors = false;   ///< displacements of a solution as arrows
    int load_case = 0;      ///< of a solution, from 0; modes follow
    double deform = 0;      ///< displacements of a solution are drawn so many times as long
    Motion motion = Motion::still;
    double phase = 0;    ///< of the motion, in [0, 1]
    double speed = 0.5;  ///< of the motion while it plays, periods a second
    bool legend = true;
    bool numbers = true;         ///< of patches, on the faces that are coloured by them; of values, on isolines
    bool times = true;           ///< seconds in the tree
    std::vector<NodeId> hidden;  ///< ascending; what lies below them is not shown
    std::optional<NodeId> isolated;
    std::vector<std::string> hidden_regions;     ///< names, ascending; a document without them shows all it has
    std::vector<std::string> glass_regions;      ///< the same: translucent, so that what they hold is seen
    std::optional<std::string> isolated_region;  ///< the only one that is shown, where there is one of this name
    bool walls = false;                          ///< of parts: only facets between two regions
    bool explode_regions = false;                ///< `explode` moves regions as wholes
    PickMode pick = PickMode::facet;
    Selection selection;
    Theme theme = Theme::light;
    Panels panels;

    bool is_hidden(NodeId node) const;
    double drawn_deformation() const { return deform * share_of_motion(motion, phase); }  ///< at the phase
    void set_hidden(NodeId changed, bool hide) { set_member(hidden, changed, hide); }

    bool operator==(const ViewState&) const = default;
};

/// What a view was seen of, so that it can be drawn again. In its JSON: "input", "run": {"parts": "8"}, "size": [width,
/// height, scale], and "body": [lowest corner, highest corner]. What is not known is missing there.
struct ViewOrigin {
    std::string input;              ///< absolute path of what was open; empty: not known
    std::vector<OptionText> run;    ///< of `input`, if that is a surface; those that differ from the defaults
    int width = 0, height = 0;      ///< of the picture in pixels; 0: not known
    double scale = 1;               ///< of fonts and lines
    Eigen::AlignedBox3d body = {};  ///< the box that the camera was made for; empty: not known

    bool operator==(const ViewOrigin& o) const;
};

/// JSON as people write it; every field may be missing and then has its default.
std::string to_json(const ViewState& state, const ViewOrigin& origin = {});
/// Throws Error(usage) naming the first field that is unknown or has a value of another kind.
ViewState state_from_json(const std::string& text, const std::string& source, ViewOrigin* origin = nullptr);
/// Makes the camera of the state, if it has one, fit a body that is another one than that it was made for: the
/// direction stays. `aspect`: width over height.
void fit_to_body(ViewState& state, const ViewOrigin& origin, const Eigen::AlignedBox3d& body, double aspect);
/// "target", "turn" (a quaternion w, x, y, z), "height", "perspective"; for who writes it by hand, "back" (from the
/// target to the eye) and "up" are read instead of "turn".
std::string to_json(const Camera& camera);
Camera camera_from_json(const std::string& text, const std::string& source);

const char* name(ColorBy color);   ///< "min-dihedral"
const char* title(ColorBy color);  ///< "Min dihedral angle (deg)"
/// Throws Error(usage) naming all.
ColorBy color_by_from_name(const std::string& text);
const char* name(Motion motion);
Motion motion_from_name(const std::string& text);
const char* name(ClipStyle style);
ClipStyle clip_style_from_name(const std::string& text);

}  // namespace kerf::view

// The state of a view as one value: the window, the command line and the tests share it, and it is a JSON file.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cut/cut/cut.h"
#include "run/request/run_request.h"
#include "viewer/model/camera.h"
#include "viewer/model/stage.h"

namespace kerf::view {

enum class Shading { flat, smooth };

enum class ClipStyle {
    cells,   ///< whole cells whose centre is on the shown side (crinkle)
    smooth,  ///< cells are cut at the plane
    layer,   ///< only the cells that the plane crosses
};

/// A clip plane. The half space on the side of -normal is shown, or the other one if flipped.
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

/// Returns the range of n.p over the points p of a box; Clip::position is a fraction of it.
ValueRange extent_along(const Eigen::AlignedBox3d& box, const Vec3& n);
/// Returns the place of the clip plane along its normal, in units of the file, without digits that are rounding of the
/// body's coordinates.
double position_of(const Clip& clip, const Eigen::AlignedBox3d& box);
/// Makes the clip plane coincide with a plane that meets the box.
void snap_to(Clip& clip, const Plane& plane, const Eigen::AlignedBox3d& box);

/// Shows the half of the body whose cut face looks towards the eye. `back`: the direction to the eye.
void face(Clip& clip, const Vec3& back);

/// Moves the plane, along its normal and if need be, so that none of these points of the body is cut away.
void keep(Clip& clip, const std::vector<Vec3>& points, const Eigen::AlignedBox3d& box);

/// The meaning of the colour of a cell or facet.
enum class ColorBy {
    part,
    rank,
    level,   ///< level of the tree at which its interface was cut; for cells the level of the part
    region,  ///< the region in which the part lies, where there are several
    patch,
    deviation,  ///< distance of a facet from the surface before or after remeshing or repair
    size,       ///< edge length that the size field asks for
    kind,       ///< cells at an interface and inner cells
    origin,     ///< origin of cells: see CellOrigin
    min_dihedral,
    radius_edge,
    aspect,
    shape,
    volume,
    edge_length,   ///< the longest edge of a cell
    error,         ///< estimated error of a solution in a cell
    displacement,  ///< length of the displacement of a solution
    von_mises,
    stress_xx,
    stress_yy,
    stress_zz,
    stress_xy,
    stress_yz,
    stress_xz,
};
inline constexpr int color_by_count = static_cast<int>(ColorBy::stress_xz) + 1;
/// Returns whether the colouring is a measure of the shape or size of cells.
constexpr bool is_measure(ColorBy color) { return color >= ColorBy::min_dihedral && color <= ColorBy::edge_length; }
constexpr bool is_of_solution(ColorBy color) { return color >= ColorBy::error; }
constexpr bool is_at_vertices(ColorBy color) { return color >= ColorBy::displacement; }
/// Returns whether the values exist for loads, but not for a mode of vibration.
constexpr bool needs_load_case(ColorBy color) { return is_of_solution(color) && color != ColorBy::displacement; }
constexpr bool is_stress(ColorBy color) { return color >= ColorBy::von_mises; }
/// Returns whether the colouring sorts cells into few kinds, which the legend names.
constexpr bool is_kind(ColorBy color) { return color == ColorBy::kind || color == ColorBy::origin; }
/// Returns whether only cells have the values.
constexpr bool is_of_cells(ColorBy color) { return is_measure(color) || is_kind(color) || is_of_solution(color); }
/// Returns whether surfaces, those of parts included, have the values, and cells have none.
constexpr bool is_of_surface(ColorBy color) { return color == ColorBy::deviation || color == ColorBy::size; }

/// The motion of the deformation of a solution, once around while Deformation::phase goes from 0 to 1.
enum class Motion {
    still,  ///< the whole deformation at every phase
    swing,  ///< to both sides, as the cosine of the phase: 1 to -1 to 1
    rise,   ///< between all and nothing, smoothly: 1 to 0 to 1
};
/// Returns the share of the whole deformation that is drawn at a phase, in [-1, 1].
double share_of_motion(Motion motion, double phase);

inline constexpr double least_percentile = 60;  ///< the least value of Coloring::percentile

enum class Theme { light, dark };

/// Puts an item into an ascending list, or takes it out.
template <class T>
void set_member(std::vector<T>& ascending, const T& item, bool is_member) {
    const auto place = std::lower_bound(ascending.begin(), ascending.end(), item);
    const bool is_there = place != ascending.end() && *place == item;
    if (is_member && !is_there) ascending.insert(place, item);
    if (!is_member && is_there) ascending.erase(place);
}

/// The kind of thing that a click selects.
enum class PickMode { facet, cell, vertex };

struct Selection {
    enum class Kind { none, facet, cell, vertex, place, defect };
    Kind kind = Kind::none;
    NodeId owner = no_node;     ///< node or part whose numbers follow
    std::int32_t index = -1;    ///< index of the facet, cell or vertex there, or in Diagnosis::defects
    Vec3 place = Vec3::Zero();  ///< place of the click, or of a defect

    bool operator==(const Selection&) const = default;
};

struct Panels {
    bool tree = true, display = true, timeline = true, keys = false, parameters = false, quality = false,
         problems = true;

    bool operator==(const Panels&) const = default;
};

/// The layers of the scene that are drawn, and the look of facets.
struct Look {
    Shading shading = Shading::flat;
    bool edges = true;    ///< edges of triangles are drawn
    bool context = true;  ///< the rest of the body, translucent
    bool plane = true;
    std::optional<bool> axes = {};  ///< principal axes and centre of gravity; none: see has_axes()
    bool contour = true;
    bool features = false;  ///< sharp edges and borders of patches
    bool surface = true;
    bool interfaces = true;
    bool legend = true;
    bool scale_bar = true;
    bool numbers = true;  ///< numbers of patches on the faces that are coloured by them; values on isolines
    bool times = true;    ///< seconds in the tree
    bool beside = false;  ///< two runs stand side by side, where two are open

    /// Returns whether axes are drawn at a stage: where nobody has chosen they explain the plane of a cut.
    bool has_axes(Stage stage) const { return axes.value_or(stage == Stage::plane); }

    bool operator==(const Look&) const = default;
};

/// The parts, regions and cells that are shown of the node. Names of regions are ascending; a document without such a
/// region shows all it has.
struct Visibility {
    std::vector<NodeId> hidden;      ///< nodes, ascending; parts below them are not shown
    std::optional<NodeId> isolated;  ///< the only node below which parts are shown
    std::vector<std::string> hidden_regions;
    std::vector<std::string> glass_regions;      ///< translucent, so that regions inside of them are seen
    std::optional<std::string> isolated_region;  ///< the only region that is shown, where there is one of this name
    std::vector<std::string> hidden_patches;     ///< patches whose facets are not drawn; '*' stands for any characters
    bool walls = false;                          ///< only those facets of parts are shown that lie between two regions
    bool neighbours = false;  ///< only a selected cell is shown, and the cells that share a vertex with it

    bool is_hidden(NodeId node) const;
    void set_hidden(NodeId node, bool hide) { set_member(hidden, node, hide); }

    bool operator==(const Visibility&) const = default;
};

/// The meaning of the colours, and the values that they span.
struct Coloring {
    ColorBy by = ColorBy::part;
    std::optional<ValueRange> range;   ///< none: the range of the values that are shown
    std::optional<ValueRange> filter;  ///< only cells with a value of `by` in it
    /// Per cent of the drawn values that the colours of stresses span where no range is given: single vertices at
    /// corners have far larger values than all others.
    double percentile = 99;
    bool isolines = false;  ///< lines on which values at vertices are alike
    bool extremes = false;  ///< the places of the least and the largest value are marked

    bool operator==(const Coloring&) const = default;
};

/// The pulling apart of parts and cells.
struct Explosion {
    double amount = 0;     ///< 0: together; 1: as far apart as the parts are large
    bool regions = false;  ///< `amount` moves regions as wholes
    double shrink = 0;     ///< of cells about their centres; 0: none, 1: to points

    bool operator==(const Explosion&) const = default;
};

/// The displacements of a solution as they are drawn.
struct Deformation {
    int load_case = 0;  ///< case of the solution, from 0; modes follow the loads
    double factor = 0;  ///< displacements are drawn so many times as long
    Motion motion = Motion::still;
    double phase = 0;      ///< phase of the motion, in [0, 1]
    double speed = 0.5;    ///< speed of the motion while it plays, in periods a second
    bool vectors = false;  ///< displacements as arrows

    double drawn() const { return factor * share_of_motion(motion, phase); }  ///< returns the factor at the phase

    bool operator==(const Deformation&) const = default;
};

/// All that a view shows, apart from the document. In its JSON the fields of Look, Visibility, Coloring, Explosion and
/// Deformation are fields of the state.
struct ViewState {
    NodeId node = root_node;
    Step step;
    std::optional<Camera> camera;  ///< none: everything fits, seen from the corner
    Look look;
    Visibility visibility;
    Coloring coloring;
    Explosion explosion;
    Deformation deformation;
    Clip clip;
    PickMode pick = PickMode::facet;
    Selection selection;
    Theme theme = Theme::light;
    Panels panels;

    bool operator==(const ViewState&) const = default;
};

/// The document and the picture of a view, by which it can be drawn again. In its JSON: "input", "run": {"parts": "8"},
/// "size": [width, height, scale], and "body": [lowest corner, highest corner]. Facts that are not known are missing
/// there.
struct ViewOrigin {
    std::string input;              ///< absolute path of the open file or folder; empty: not known
    std::vector<OptionText> run;    ///< options for `input`, if that is a surface, that differ from the defaults
    int width = 0, height = 0;      ///< size of the picture in pixels; 0: not known
    double scale = 1;               ///< scale of fonts and lines
    Eigen::AlignedBox3d body = {};  ///< the box that the camera was made for; empty: not known

    bool operator==(const ViewOrigin& o) const;
};

/// Returns JSON as people write it. When it is read every field may be missing and then has its default.
std::string to_json(const ViewState& state, const ViewOrigin& origin = {});
/// Reads JSON of to_json(); `source` is its name in messages. Throws Error(usage) naming the first field that is
/// unknown or has a value of another kind.
ViewState state_from_json(const std::string& text, const std::string& source, ViewOrigin* origin = nullptr);
/// Makes the camera of the state, if it has one, fit a body that is another one than the body it was made for; the
/// direction stays. `aspect` is width over height.
void fit_to_body(ViewState& state, const ViewOrigin& origin, const Eigen::AlignedBox3d& body, double aspect);
/// Write and read a camera with the fields "target", "turn" (a quaternion w, x, y, z), "height" and "perspective". For
/// people who write it by hand, "back" (from the target to the eye) and "up" are read instead of "turn".
std::string to_json(const Camera& camera);
Camera camera_from_json(const std::string& text, const std::string& source);

const char* name(ColorBy color);   ///< "min-dihedral"
const char* title(ColorBy color);  ///< "Min dihedral angle (deg)"
/// Returns the colouring of a name. Throws Error(usage) naming all of them.
ColorBy color_by_from_name(const std::string& text);
const char* name(Motion motion);
Motion motion_from_name(const std::string& text);
const char* name(ClipStyle style);
ClipStyle clip_style_from_name(const std::string& text);

}  // namespace kerf::view

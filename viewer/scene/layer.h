// A scene as plain data: the scene builder makes it, the renderer draws it, tests count it.
//
// Coordinates are draw coordinates: the body's bounding box is centred at the origin and its diagonal is 2 long
// (Frame in model/camera.h), so that single precision suffices for any unit and place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "viewer/model/stage.h"

namespace kerf::view {

struct Color {
    float r = 0, g = 0, b = 0, a = 1;

    bool operator==(const Color&) const = default;
};

/// A line of a legend: a colour as it is drawn, and its meaning.
struct LegendEntry {
    enum class Mark { area, line, point };
    std::string text;
    Color color;  ///< with the opacity of glass, where it is glass
    Mark mark = Mark::area;
};

/// A value and the place where it is drawn, in coordinates of the file with parts pulled apart.
struct PlacedValue {
    double value = 0;
    Vec3 place = Vec3::Zero();
};

/// A corner of a triangle. Triangles share no corners, so that every one has its own edges and value.
struct Corner {
    std::array<float, 3> position = {};
    std::array<std::int16_t, 3> normal = {};  ///< of length 32767, for smooth shading; zero: the triangle's
    std::uint16_t edges = 7;  ///< bit i: the edge from corner i to the next is drawn; the same in all three corners
    float value = 0;          ///< for Fill::scale and Fill::categories; NaN: no value
};
static_assert(sizeof(Corner) == 24);

/// A straight line between two points.
struct Segment {
    std::array<float, 3> from = {}, to = {};
};

/// Triangles, segments or points: exactly one of the three is not empty. Immutable once a layer holds it; the renderer
/// keeps a copy on the GPU for as long as it is drawn.
struct Geometry {
    std::vector<Corner> corners;               ///< 3 per triangle; counter-clockwise seen from outside
    std::vector<Segment> segments;             ///< lines of a width in pixels
    std::vector<std::array<float, 3>> points;  ///< discs of a diameter in pixels
    /// Number of the facet or cell that is picked by each triangle or point. Empty: cannot be picked.
    std::vector<std::int32_t> element = {};
    bool has_normals = false;  ///< some corners have normals that are to be seen without smooth shading, too
    /// Position of each corner when nothing is deformed; empty: where it is drawn.
    std::vector<std::array<float, 3>> rest = {};
    /// The triangle on which a segment of an isoline lies, in the geometry of the layer below, and the value there.
    struct Origin {
        std::uint32_t triangle = 0;
        float value = 0;
    };
    std::vector<Origin> origins = {};  ///< per segment of isolines; else empty

    std::size_t triangle_count() const { return corners.size() / 3; }
};

/// A run of primitives that moves and is coloured as one: a part, or a half.
struct Range {
    std::uint32_t first = 0, count = 0;  ///< primitives: triangles, segments or points
    NodeId owner = no_node;              ///< the node or part that it belongs to
    std::array<float, 3> offset = {};    ///< added to the positions after clipping
    Color color;                         ///< colour of Fill::plain, lines and points
    /// The range, of a closed layer, is hidden by other layers from everywhere outside. It is drawn only where backs
    /// are to be seen.
    bool inside = false;
};

/// The source of the colour of triangles.
enum class Fill {
    plain,       ///< the colour of the range
    scale,       ///< the corner's value on Scene::scale
    categories,  ///< the corner's value, a whole number, in Scene::palette, repeated
};

/// The thing that a layer shows.
enum class LayerKind {
    surface,          ///< the closed surface of the node, its interface facets in their own colour
    file_surface,     ///< the surface as the file has it, where another one was cut
    features,         ///< sharp edges and borders of patches of a surface, half or part
    context,          ///< the rest of the body, translucent: the other half, which owns it, of a cut above the node
    defects,          ///< facets in which kerf check has found defects
    defect_edges,     ///< edges in which it has found defects
    warning_places,   ///< places of its warnings
    defect_places,    ///< places of errors
    axes,             ///< principal axes
    centre,           ///< centre of gravity
    plane,            ///< the cutting plane, until there is a section in it; the stages of a contour follow
    crossed_edges,    //
    hanging_removed,  //
    closed_loops,     //
    paths_removed,    //
    contour,          //
    projected,        //
    triangulation,    ///< the section in the plane
    interface,        ///< the section mapped back to the surface
    plane_outline,    ///< border of the plane, and its normal
    refused,          ///< contour of a refused try
    places,           ///< places where the try failed
    colliding,        ///< the interface's triangles of pairs of triangles that meet
    collided,         ///< the other triangles of these pairs
    half,             ///< a half of a split
    part,             ///< boundary of a part: all that can be shown of one without cells
    cells,            ///< cells of a part at the clip plane, by filter, shrunk or around another cell
    section,          ///< sections of cells with a smooth clip plane
    isolines,         ///< lines of equal values on the layer on which they lie
    extremes,         ///< places of the least and the largest value
    vectors,          ///< displacements as arrows
    wall,             ///< faces behind shrunk cells
    selected_cell,    ///< a selected cell inside, which is seen through the others, translucent then
    outline,          ///< sharp edges of the node, or of its parts, where only some cells are shown
    glass,            ///< facets of the node, or of its parts, where only some cells are shown
    selection,        ///< edges of the selected thing
    selected_place,   ///< the selected thing, where it is a point
};
/// Returns the layer of a stage from the plane to the interface.
constexpr LayerKind layer_of(Stage stage) {
    return static_cast<LayerKind>(static_cast<int>(LayerKind::plane) + static_cast<int>(stage) -
                                  static_cast<int>(Stage::plane));
}
static_assert(layer_of(Stage::interface) == LayerKind::interface);

/// Returns the number of a patch on its face and in the legend, counted from 1, as names, reports and solvers do.
inline std::int32_t patch_number(std::int32_t index) { return index + 1; }

/// Geometry that is drawn in one way.
struct Layer {
    LayerKind kind = LayerKind::surface;  ///< with the owner unique in a scene, but for isolines
    NodeId owner = no_node;               ///< the node or part that it belongs to, or no_node
    std::shared_ptr<const Geometry> geometry;
    std::vector<Range> ranges;
    Fill fill = Fill::plain;
    float opacity = 1;      ///< below 1: drawn after opaque layers, writes no depth
    float front_share = 1;  ///< factor of the opacity of faces towards the eye; small: glass does not tint its inside
    float shading = 1;      ///< 0: the colour as it is, 1: shaded by the light on it
    bool edges = false;     ///< dark lines are drawn along the edges of triangles
    bool smooth = false;    ///< shaded by the normals of corners
    bool clipped = true;    ///< cut by Scene::clip
    float pixels = 1;       ///< width of lines, diameter of points, at pixel ratio 1
    bool shines_through = false;  ///< lines and points: faint where something lies before them
    bool two_sided = false;       ///< the back looks like the front; else it is darker and greyer, as an inside
    /// Every range is the whole boundary of a body, facing outwards, of which no back is seen from outside. The
    /// renderer then draws none unless the plane or the eye cuts the body open, which is up to twice as fast.
    bool closed = false;
    /// Index of the patch of each triangle of the geometry; -1: none. Null unless colours are those of patches.
    std::shared_ptr<const std::vector<std::int32_t>> patch = nullptr;
    /// Only triangles that are seen from their back are drawn, as a ground behind other things that covers none of
    /// them; for opaque layers. Not picked.
    bool backs_only = false;
    int lies_on = -1;  ///< for isolines: index in Scene::layers of the layer on whose triangles they lie
};

/// A clip plane (a, b, c, d): the half space a x + b y + c z + d >= 0 is shown, in draw coordinates before offsets.
struct ClipPlane {
    std::array<float, 4> plane = {0, 0, 0, 1};  ///< this plane shows everything
};

/// The map from values to colours: linear between low and high; beyond them values have the end colours.
struct ColorScale {
    float low = 0, high = 1;
    std::vector<Color> colors;  ///< at equal distances, at least two; empty: not used
    Color none;                 ///< colour of NaN
};

/// All that is drawn of a view.
struct Scene {
    std::vector<Layer> layers;
    ClipPlane clip;
    ColorScale scale;
    std::vector<Color> palette;
    Color background_top, background_bottom;
    Color edge;           ///< colour of triangle edges; its alpha is their strength
    float occlusion = 0;  ///< how much darker opaque bodies are in hollows; 0 to 1

    /// Returns the first layer of a kind, of `owner` if one is given, or nullptr.
    const Layer* find(LayerKind kind, std::optional<NodeId> owner = {}) const {
        for (const Layer& layer : layers)
            if (layer.kind == kind && owner.value_or(layer.owner) == layer.owner) return &layer;
        return nullptr;
    }
};

}  // namespace kerf::view

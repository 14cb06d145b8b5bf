// What is drawn, as plain data: the scene builder makes it, the renderer draws it, tests count it.
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

#include "core/types.h"
#include "viewer/model/stage.h"

namespace kerf::view {

struct Color {
    float r = 0, g = 0, b = 0, a = 1;

    bool operator==(const Color&) const = default;
};

/// A line of a legend: a colour as it is drawn, and what it means.
struct LegendEntry {
    enum class Mark { area, line, point };
    std::string text;
    Color color;  ///< of glass, with its opacity
    Mark mark = Mark::area;
};

/// A value and where it is drawn; coordinates of the file, parts pulled apart.
struct PlacedValue {
    double value = 0;
    Vec3 place = Vec3::Zero();
};

/// A corner of a triangle. Triangles share no corners, so that every one has its own edges and value.
struct Corner {
    std::array<float, 3> position = {};
    std::array<std::int16_t, 3> normal = {};  ///< of length 32767, for smooth shading; zero: that of the triangle
    std::uint16_t edges = 7;  ///< bit i: the edge from corner i to the next is drawn; the same in all three corners
    float value = 0;          ///< for Fill::scale and Fill::categories; NaN: no value
};
static_assert(sizeof(Corner) == 24);

/// A straight line between two points.
struct Segment {
    std::array<float, 3> from = {}, to = {};
};

/// Immutable once a layer holds it; the renderer keeps a copy on the GPU for as long as it is drawn. Exactly one of the
/// three is not empty.
struct Geometry {
    std::vector<Corner> corners;               ///< 3 per triangle; counter-clockwise seen from outside
    std::vector<Segment> segments;             ///< lines of a width in pixels
    std::vector<std::array<float, 3>> points;  ///< discs of a diameter in pixels
    /// Per triangle or point, what it is for who picks it: a facet or cell number. Empty: cannot be picked.
    std::vector<std::int32_t> element = {};
    bool has_normals = false;  ///< some corners have normals that are to be seen without smooth shading, too
    /// Per corner, where it is when nothing is deformed; empty: where it is drawn.
    std::vector<std::array<float, 3>> rest = {};
    /// Per segment of isolines: the triangle of the geometry that they lie on, and the value there.
    struct Origin {
        std::uint32_t triangle = 0;
        float value = 0;
    };
    std::vector<Origin> origins = {};

    std::size_t triangle_count() const { return corners.size() / 3; }
};

/// A run of primitives that moves and is coloured as one: a part, or a half.
struct Range {
    std::uint32_t first = 0, count = 0;  ///< primitives: triangles, segments or points
    NodeId owner = 0;                    ///< the node or part that it belongs to
    std::array<float, 3> offset = {};    ///< added to the positions after clipping
    Color color;                         ///< of Fill::plain, lines and points
    /// Of a closed layer: other layers are before it from everywhere outside. Drawn only where backs are to be seen.
    bool inside = false;
};

/// How triangles get their colour.
enum class Fill {
    plain,       ///< that of the range
    scale,       ///< the corner's value on Scene::scale
    categories,  ///< the corner's value, a whole number, in Scene::palette, repeated
};

/// What a layer shows.
enum class LayerKind {
    surface,          ///< the closed surface of the node, its interface facets in their own colour
    file_surface,     ///< the surface as the file has it, where another one was cut
    features,         ///< sharp edges and borders of patches, of either, or of a half or part
    context,          ///< the rest of the body, translucent: the other half, which owns it, of a cut above the node
    defects,          ///< facets that kerf check found fault with
    defect_edges,     ///< likewise edges
    warning_places,   ///< where it warns
    defect_places,    ///< where something is wrong
    axes,             ///< principal axes
    centre,           ///< of gravity
    plane,            ///< the cutting plane, until there is a section in it; then on, the stages of a contour
    crossed_edges,    //
    hanging_removed,  //
    closed_loops,     //
    paths_removed,    //
    contour,          //
    projected,        //
    triangulation,    ///< the section in the plane
    interface,        ///< and on the surface
    plane_outline,    ///< with its normal
    refused,          ///< a refused try's contour
    places,           ///< where it failed
    colliding,        ///< of pairs of triangles that meet, those of the interface
    collided,         ///< and the others
    half,             ///< of a split
    part,             ///< a part's boundary, which is all there is of parts without cells
    cells,            ///< of a part at the clip plane, by filter, shrunk or around another
    section,          ///< smooth ones of cells
    isolines,         ///< of the layer that they lie on
    extremes,         ///< where the least and the largest value are
    vectors,          ///< displacements
    wall,             ///< behind shrunk cells
    selected_cell,    ///< where it is seen only through others, which are translucent then
    outline,          ///< of the node, or its parts, where only some cells are shown
    glass,            ///< the same, their facets
    selection,        ///< its edges
    selected_place,   ///< where it is a point
};
/// That of a stage from the plane to the interface.
constexpr LayerKind layer_of(Stage stage) {
    return static_cast<LayerKind>(static_cast<int>(LayerKind::plane) + static_cast<int>(stage) -
                                  static_cast<int>(Stage::plane));
}
static_assert(layer_of(Stage::interface) == LayerKind::interface);

/// What is read of a patch, on its face and in the legend: counted from 1, as names, reports and solvers do.
inline std::int32_t patch_number(std::int32_t index) { return index + 1; }

struct Layer {
    LayerKind kind = LayerKind::surface;  ///< with the owner unique in a scene, but for isolines
    NodeId owner = 0;                     ///< the node or part that it belongs to; 0: none
    std::shared_ptr<const Geometry> geometry;
    std::vector<Range> ranges;
    Fill fill = Fill::plain;
    float opacity = 1;            ///< below 1: drawn after what is opaque, writes no depth
    float front_share = 1;        ///< of the opacity: of what faces the eye, so that glass does not tint what is inside
    float shading = 1;            ///< 0: its colour as it is, 1: by the light on it
    bool edges = false;           ///< dark lines along the edges of triangles
    bool smooth = false;          ///< shading by the corner's normals
    bool clipped = true;          ///< by Scene::clip
    float pixels = 1;             ///< width of lines, diameter of points, at pixel ratio 1
    bool shines_through = false;  ///< lines and points: faint where something lies before them
    bool two_sided = false;       ///< the back looks like the front; else it is darker and greyer: one looks inside
    /// Every range is the whole boundary of a body, facing outwards: who is outside sees no backs. The renderer then
    /// draws none unless the plane or the eye cuts the body open, which is up to twice as fast.
    bool closed = false;
    /// Per triangle of the geometry, its patch as an index; -1: none. Null unless patches have the colours.
    std::shared_ptr<const std::vector<std::int32_t>> patch = nullptr;
    /// Of an opaque layer only what is seen from its back is drawn: a ground behind other things that covers none of
    /// them. Not picked.
    bool backs_only = false;
    int lies_on = -1;  ///< of isolines, the number in Scene::layers of the layer whose triangles they are on
};

/// The half space a x + b y + c z + d >= 0 is shown, in draw coordinates before offsets.
struct ClipPlane {
    std::array<float, 4> plane = {0, 0, 0, 1};  ///< this one shows everything
};

/// Values to colours: linear between low and high, beyond them the end colours.
struct ColorScale {
    float low = 0, high = 1;
    std::vector<Color> colors;  ///< at equal distances, at least two; empty: not used
    Color none;                 ///< of NaN
};

struct Scene {
    std::vector<Layer> layers;
    ClipPlane clip;
    ColorScale scale;
    std::vector<Color> palette;
    Color background_top, background_bottom;
    Color edge;  ///< of triangle edges; its alpha is their strength

    /// The first of a kind, of this owner if there is one.
    const Layer* find(LayerKind kind, std::optional<NodeId> owner = {}) const {
        for (const Layer& layer : layers)
            if (layer.kind == kind && owner.value_or(layer.owner) == layer.owner) return &layer;
        return nullptr;
    }
};

}  // namespace kerf::view

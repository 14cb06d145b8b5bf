// From what is open and what is to be shown to what is drawn.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/session.h"
#include "viewer/model/view_state.h"
#include "viewer/scene/geometry_cache.h"
#include "viewer/scene/layer.h"

namespace kerf::view {

/// What colours mean in a scene.
struct Legend {
    std::string title;                    ///< of a colouring; empty: what there is to see is explained
    std::optional<ValueRange> values;     ///< of a measure
    std::optional<ValueRange> extremes;   ///< of a solution: the least and the largest value that is drawn
    std::vector<PlacedValue> marked;      ///< where ViewState::extremes asks for them: of the least, the largest value
    double percentile = 100;              ///< per cent of the drawn values that the colours span, where they span fewer
    std::vector<Color> scale;             ///< from its low to its high end
    std::vector<LegendEntry> categories;  ///< what else there is to explain, also beside a scale
};

struct BuiltScene {
    Scene scene;
    Legend legend;
    Frame frame;
    Eigen::AlignedBox3d box;   ///< of what is drawn, moved parts included; coordinates of the file
    Eigen::AlignedBox3d left;  ///< of what the clip plane leaves of the body; empty without one
    bool pending = false;      ///< something is still being fetched: build again when it has arrived
};

/// Layers by name, in the order of drawing:
///
///     surface           the closed surface of the node, its interface facets in their own colour
///     file surface      the surface as the file has it, where another one was cut
///     features [N]      sharp edges and borders of patches, of either or of a half
///     context N         the rest of the body, translucent: the other half, N, of each cut above the node
///     defects, defect edges, warning places, defect places   what kerf check found
///     axes, centre      principal axes and centre of gravity
///     plane, plane outline                   the cutting plane, until there is a section in it, with its normal
///     crossed-edges, hanging-removed, closed-loops, paths-removed, contour, projected   the contour at the stage
///     refused, places, colliding, collided   a refused try's contour, where it failed, pairs of triangles that meet
///     triangulation, interface               the section in the plane, and on the surface
///     half N            of a split, by node
///     part N, cells N, section N             of the tetrahedra: a part's boundary, which is all there is of parts
///                                            without cells; its cells at the clip plane, by filter, shrunk or around
///                                            another; their smooth sections
///     isolines of NAME                       of the layer NAME
///     extremes                               where the least and the largest value are
///     vectors                                displacements
///     wall N                                 behind shrunk cells
///     selected cell                          where it is seen only through others, which are translucent then
///     outline N, glass N                     of the node, or its parts, where only some cells are shown
///     selection, selected place
///
/// Deterministic: a function of state and document. What was drawn before costs no more than a look-up.
class SceneBuilder {
 public:
    BuiltScene build(const ViewState& state, Session& session);
    /// How much geometry had to be made so far: stays as it is when one goes back.
    std::int64_t geometry_made() const { return cache_.made(); }

 private:
    GeometryCache cache_;
};

/// Where a part or half goes when the parts below `root` are pulled apart: a sum over the cuts between them, along the
/// normals. Coordinates of the file.
Vec3 explosion_offset(const Tree& tree, NodeId part, NodeId root, double explode, double diagonal);

}  // namespace kerf::view

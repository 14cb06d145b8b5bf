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
    bool goes_below = false;              ///< values that are drawn lie below `values`
    bool goes_above = false;              ///< or above
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

/// Makes the layers, of kinds (LayerKind) that suit step and view.
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

// Surfaces of nodes and parts, whole, by walls, or of glass.
#pragma once

#include <set>

#include "viewer/scene/layer_sink.h"

namespace kerf::view {

/// Which facets of a part's surface are drawn where not all are: walls alone, or those of a region of glass.
struct PartFacets {
    bool all = true;
    bool outer = true;          ///< what no other part lies behind
    std::set<NodeId> left_out;  ///< parts, of which those in front are not drawn

    bool wants(const NodeSurface& surface, std::int32_t facet) const;
    std::string key() const;
};
/// Of two facets in one place one is drawn: the opaque one, or that of the smaller number. Cuts within glass are none.
PartFacets chosen_facets(const SceneContext& context, NodeId part, const NodeSurface& surface);

/// The values that surfaces themselves have: numbers of patches, or measures; at most one of the two.
struct FacetColors {
    std::vector<float> patches;
    std::shared_ptr<const SurfaceValues> values;

    FacetColors(const SceneContext& context, LayerSink& sink, const std::shared_ptr<const NodeSurface>& surface);
    bool any() const { return values || !patches.empty(); }
    void set_values(const NodeSurface& surface, FacetChoice& choice) const;
    /// The fill, and numbers of patches where they are to be read on the faces.
    void finish(const SceneContext& context, const NodeSurface& surface, Layer& layer) const;
};

class SurfaceLayers {
 public:
    SurfaceLayers(const SceneContext& context, LayerSink& sink) : context_(context), sink_(sink) {}

    /// One range of the facets of the input and one of the interfaces'. Null if the clip plane leaves none.
    Layer* add(LayerKind kind, const std::shared_ptr<const NodeSurface>& surface, NodeId owner, const Color& color,
               const Color& interface_color, const Vec3& offset = Vec3::Zero());
    void add_features(const std::shared_ptr<const NodeSurface>& surface, NodeId owner,
                      const Vec3& offset = Vec3::Zero());
    /// not_remeshed or not_repaired. What was cut looks like it from afar, so that the one comes in the place of the
    /// other.
    void add_of_file(NodeId which);
    /// Of a run without cells.
    void add_parts();
    /// The rest of the body.
    void add_context();

 private:
    const SceneContext& context_;
    LayerSink& sink_;
};

}  // namespace kerf::view

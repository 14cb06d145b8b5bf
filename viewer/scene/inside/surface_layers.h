// The layers of surfaces of nodes and parts, whole, by walls, or of glass.
#pragma once

#include <set>

#include "viewer/scene/inside/layer_sink.h"

namespace kerf::view {

/// The facets of a surface that are drawn, where not all are: patches are hidden, or there are walls alone, or it is a
/// part of a region of glass.
struct PartFacets {
    bool all = true;
    std::vector<char> hidden_patches = {};  ///< 1 for those whose facets are not drawn; empty: none
    bool by_neighbours = false;             ///< the following two decide
    bool outer = true;                      ///< facets behind which no other part lies are drawn
    std::set<NodeId> left_out;              ///< parts in front of which no facets are drawn

    bool wants(const NodeSurface& surface, std::int32_t facet) const;
    std::string key() const;
};
/// Returns the facets of a part that are drawn, one of two in the same place: the opaque one, or else that of the
/// region with the smaller number. Cuts within glass are not drawn.
PartFacets chosen_facets(const SceneContext& context, NodeId part, const NodeSurface& surface);

/// The values by which a surface is coloured: numbers of patches, or values of its own; at most one of the two.
struct FacetColors {
    std::vector<float> patches;
    std::shared_ptr<const SurfaceValues> values;

    FacetColors(const SceneContext& context, LayerSink& sink, const std::shared_ptr<const NodeSurface>& surface);
    bool any() const { return values || !patches.empty(); }
    void set_values(const NodeSurface& surface, FacetChoice& choice) const;
    /// Sets the fill of a layer, and the numbers of patches where they are to be read on the faces.
    void finish(const SceneContext& context, const NodeSurface& surface, Layer& layer) const;
};

/// Adds layers of whole surfaces.
class SurfaceLayers {
 public:
    SurfaceLayers(const SceneContext& context, LayerSink& sink) : context_(context), sink_(sink) {}

    /// Adds a surface with a range for the facets of the input and one for those of interfaces. Null if no facet is
    /// left.
    Layer* add(LayerKind kind, const std::shared_ptr<const NodeSurface>& surface, NodeId owner, const Color& color,
               const Color& interface_color, const Vec3& offset = Vec3::Zero());
    void add_features(const std::shared_ptr<const NodeSurface>& surface, NodeId owner,
                      const Vec3& offset = Vec3::Zero());
    /// Adds the surface not_remeshed or not_repaired, in the place of the surface that was cut: from afar both look
    /// alike.
    void add_of_file(NodeId which);
    /// Adds the surfaces of the parts of a run without cells.
    void add_parts();
    /// Adds the rest of the body around the node, translucent.
    void add_context();

 private:
    const SceneContext& context_;
    LayerSink& sink_;
};

}  // namespace kerf::view

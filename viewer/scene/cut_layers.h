// What one cut did, stage by stage, and what is wrong with what is to be cut.
#pragma once

#include "viewer/scene/surface_layers.h"

namespace kerf::view {

/// Of what the scene shows at the stage and not before.
Color color_of(Stage stage, const SceneColors& colors);

class CutLayers {
 public:
    CutLayers(const SceneContext& context, LayerSink& sink, SurfaceLayers& surfaces)
        : context_(context), sink_(sink), surfaces_(surfaces) {}

    /// The surface of the node itself, and what its cut did to it.
    void add_node(const std::shared_ptr<const NodeSurface>& surface);
    /// Both take the contour along. `parent` may be null.
    void add_halves(const NodeSurface* parent);

 private:
    const Cut* cut() const;
    void add_axes(const TreeRow& row);
    void add_plane(const Plane& plane);
    void add_try(const CutTry& attempt, const NodeSurface& surface);
    void add_collisions(const CutTry& attempt);
    void add_stage(const Cut& cut, const NodeSurface& surface);
    void add_section(LayerKind kind, const std::vector<Vec3>& places, const std::vector<Triangle>& facets,
                     float shading);
    Layer& add_contour(const Cut& cut, const NodeSurface& surface);

    const SceneContext& context_;
    LayerSink& sink_;
    SurfaceLayers& surfaces_;
};

/// What kerf check has found; null: nothing.
void add_defects(const SceneContext& context, LayerSink& sink, const CheckedSoup* found);

}  // namespace kerf::view

// The layers of one cut, stage by stage, and of the defects of the surface that is to be cut.
#pragma once

#include "viewer/scene/inside/surface_layers.h"

namespace kerf::view {

/// Returns the colour of the things that the scene shows at the stage and not before.
Color color_of(Stage stage, const SceneColors& colors);

/// Adds the layers of a node and of its cut, as far as the step of the view shows them.
class CutLayers {
 public:
    CutLayers(const SceneContext& context, LayerSink& sink, SurfaceLayers& surfaces)
        : context_(context), sink_(sink), surfaces_(surfaces) {}

    /// Adds the surface of the node itself, and the stage or the refused try of its cut.
    void add_node(const std::shared_ptr<const NodeSurface>& surface);
    /// Adds both halves, which take the contour along. `parent` is the surface of the node, or null: no contour is
    /// drawn.
    void add_halves(const NodeSurface* parent);
    /// Adds the principal axes of the node and its centre of gravity, where they are wanted (Look::has_axes()).
    void add_axes();

 private:
    const Cut* cut() const;
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

/// Adds the defects that kerf check has found, at the root alone; null: none are known.
void add_defects(const SceneContext& context, LayerSink& sink, const CheckedSoup* found);

}  // namespace kerf::view

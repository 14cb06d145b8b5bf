// Adds layers to a scene, and keeps the boxes around them.
#pragma once

#include "viewer/scene/inside/scene_context.h"

namespace kerf::view {

/// Adds layers to a scene under construction, and extends the scene's boxes. References to layers last until the next
/// one is added.
class LayerSink {
 public:
    LayerSink(const SceneContext& context, BuiltScene& built) : context_(context), built_(built) {}

    /// Adds a layer with one range of this colour, with edges and shading as the view asks for them.
    Layer& add(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color, NodeId owner = no_node,
               const Vec3& offset = Vec3::Zero());
    /// Adds lines or points that shine through everything and belong to the node of the view.
    Layer& add_strokes(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color, float pixels);
    Layer& add_lines(LayerKind kind, const std::vector<std::array<Vec3, 2>>& ends, const Color& color, float pixels) {
        return add_strokes(kind, segments(ends, context_.frame), color, pixels);
    }
    void add_points(LayerKind kind, const std::vector<Vec3>& places, const Color& color, float pixels) {
        add_strokes(kind, points(places, context_.frame), color, pixels);
    }
    /// Returns an offset in coordinates of the file as one in draw coordinates.
    std::array<float, 3> move_of(const Vec3& offset) const;

    /// Extends box and outline of the scene by a body of which nothing is cut away.
    void extend(Eigen::AlignedBox3d box, const Vec3& offset = Vec3::Zero());
    /// Extends them by a body with these vertices, whose outline is tighter than its box.
    void extend(const std::vector<Vec3>& vertices, const Vec3& offset = Vec3::Zero());
    /// Extends the boxes of the scene by the facets of a body that the clip plane may cut.
    void extend_by_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Vec3& offset);

    /// Passes on a value that a session gives; if it is null the scene is to be built again.
    template <class T>
    T awaited(T found) {
        built_.pending |= !found;
        return found;
    }

    std::vector<Layer>& layers() { return built_.scene.layers; }
    const Eigen::AlignedBox3d& box() const { return built_.box; }
    /// Returns the parts of the node of which surface or cells are drawn.
    std::vector<NodeId> drawn_parts() const;

 private:
    const SceneContext& context_;
    BuiltScene& built_;
};

/// Makes a layer translucent, so that things inside of it are seen.
void make_glass(Layer& layer);

}  // namespace kerf::view

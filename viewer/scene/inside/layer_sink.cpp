#include "viewer/scene/inside/layer_sink.h"

#include <algorithm>
#include <set>

namespace kerf::view {

namespace {

constexpr float glass_front_share = 0.4f;

}  // namespace

void make_glass(Layer& layer) {
    layer.opacity = context_opacity;
    layer.front_share = glass_front_share;
    layer.edges = false;
    layer.two_sided = true;
}

Layer& LayerSink::add(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color, NodeId owner,
                      const Vec3& offset) {
    Layer layer;
    layer.kind = kind;
    layer.owner = owner;
    Range range;
    range.count = static_cast<std::uint32_t>(
        std::max({geometry->triangle_count(), geometry->segments.size(), geometry->points.size()}));
    range.owner = owner;
    range.offset = move_of(offset);
    range.color = color;
    layer.ranges.push_back(range);
    layer.geometry = std::move(geometry);
    layer.edges = context_.state.look.edges;
    layer.smooth = context_.state.look.shading == Shading::smooth;
    return layers().emplace_back(std::move(layer));
}

Layer& LayerSink::add_strokes(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color,
                              float pixels) {
    Layer& layer = add(kind, std::move(geometry), color, context_.state.node);
    layer.pixels = pixels;
    layer.shines_through = true;
    layer.clipped = false;
    return layer;
}

std::array<float, 3> LayerSink::move_of(const Vec3& offset) const {
    const Eigen::Vector3f move = (offset * context_.frame.scale).cast<float>();
    return {move.x(), move.y(), move.z()};
}

void LayerSink::extend_by_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const Vec3& offset) {
    extend(box_of(vertices), offset);
    if (!context_.side) return;
    Eigen::AlignedBox3d left = box_of_shown(vertices, facets, *context_.side, context_.state.clip.style);
    if (!left.isEmpty()) built_.left.extend(left.translate(offset));
}

std::vector<NodeId> LayerSink::drawn_parts() const {
    std::set<NodeId> owners;
    for (const Layer& layer : built_.scene.layers)
        if (layer.kind == LayerKind::part || layer.kind == LayerKind::cells || layer.kind == LayerKind::section)
            owners.insert(layer.owner);
    std::vector<NodeId> drawn;
    for (const NodeId part : context_.document.tree.parts_below(context_.state.node))
        if (owners.contains(part)) drawn.push_back(part);
    return drawn;
}

}  // namespace kerf::view

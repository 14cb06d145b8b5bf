// The outline of a body is the set of its vertices that lie farthest along axes that are spread evenly: their hull is a
// little smaller than that of the body, by less than the margin with which a camera fits it. Of a large body every so
// many vertices are looked at, since a scene is built often.
#include "viewer/scene/inside/layer_sink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace kerf::view {

namespace {

constexpr float glass_front_share = 0.4f;
constexpr std::size_t outline_axes = 32, outline_vertices = 10000;

// Axes that are spread evenly over a half sphere, by the golden angle.
std::array<Vec3, outline_axes> spread_axes() {
    std::array<Vec3, outline_axes> axes;
    for (std::size_t i = 0; i < outline_axes; ++i) {
        const double z = (i + 0.5) / outline_axes, r = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
        axes[i] = {r * std::cos(turn), r * std::sin(turn), z};
    }
    return axes;
}

// The vertices that lie farthest in many directions; of a large body every so many vertices are looked at.
std::vector<Vec3> outermost_points(const std::vector<Vec3>& vertices) {
    static const std::array<Vec3, outline_axes> axes = spread_axes();
    struct Ends {
        double low = HUGE_VAL, high = -HUGE_VAL;
        const Vec3 *lowest = nullptr, *highest = nullptr;
    };
    std::array<Ends, outline_axes> ends;
    const std::size_t step = vertices.size() / outline_vertices + 1;
    for (std::size_t v = 0; v < vertices.size(); v += step) {
        if (!vertices[v].allFinite()) continue;
        for (std::size_t i = 0; i < outline_axes; ++i) {
            const double place = axes[i].dot(vertices[v]);
            if (place < ends[i].low) ends[i].low = place, ends[i].lowest = &vertices[v];
            if (place > ends[i].high) ends[i].high = place, ends[i].highest = &vertices[v];
        }
    }
    std::vector<Vec3> points;
    for (const Ends& end : ends)
        for (const Vec3* p : {end.lowest, end.highest})
            if (p) points.push_back(*p);
    return points;
}

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

void LayerSink::extend(Eigen::AlignedBox3d box, const Vec3& offset) {
    if (box.isEmpty()) return;
    built_.box.extend(box.translate(offset));
    for (int i = 0; i < 8; ++i)
        built_.outline.emplace_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
}

void LayerSink::extend(const std::vector<Vec3>& vertices, const Vec3& offset) {
    Eigen::AlignedBox3d box = box_of(vertices);
    if (box.isEmpty()) return;
    built_.box.extend(box.translate(offset));
    for (const Vec3& p : outermost_points(vertices)) built_.outline.emplace_back(p + offset);
}

void LayerSink::extend_by_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const Vec3& offset) {
    extend(vertices, offset);
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

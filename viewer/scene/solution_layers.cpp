// Of a solution: where vertices move, their values, lines where these are alike, arrows.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>

#include "viewer/scene/arrows.h"
#include "viewer/scene/scene_build.h"

namespace kerf::view {

std::shared_ptr<const PartSolution> SceneBuild::solution_of(NodeId part) {
    if (!needs_solution()) return nullptr;
    auto solution = session_.solution(part, static_cast<std::size_t>(state_.load_case));
    built_.pending |= !solution;
    return solution;
}

// Empty where they stay.
std::vector<Vec3> SceneBuild::moved_places(const std::vector<Vec3>& vertices, const PartSolution* solution) const {
    std::vector<Vec3> places;
    if (!solution || state_.deform == 0) return places;
    const double factor = state_.drawn_deformation();
    for (std::size_t v = 0; v < vertices.size(); ++v)
        places.emplace_back(vertices[v] + factor * solution->displacement[v]);
    return places;
}

// Empty where the colour is none of them.
std::vector<float> SceneBuild::values_at_vertices(std::size_t count, const PartSolution* solution) const {
    std::vector<float> values;
    if (!solution || !is_at_vertices(state_.color)) return values;
    for (std::size_t v = 0; v < count; ++v) values.push_back(solution->value_at(state_.color, v));
    return values;
}

// Of a solution of first order, means of the ends of edges.
SceneBuild::NodesOnEdges SceneBuild::nodes_on_edges(const EdgePoints& edges, const PartSolution* solution) const {
    NodesOnEdges nodes;
    const bool moves = solution && state_.deform != 0, has_values = solution && is_at_vertices(state_.color);
    const double factor = state_.drawn_deformation();
    for (std::size_t e = 0; (moves || has_values) && e < edges.places.size(); ++e) {
        const auto n = static_cast<std::size_t>(edges.node[e]);
        const auto a = static_cast<std::size_t>(edges.ends[e][0]), b = static_cast<std::size_t>(edges.ends[e][1]);
        const bool is_known = n < solution->displacement.size();
        if (moves) {
            const Vec3 displacement = is_known ? solution->displacement[n]
                                               : Vec3((solution->displacement[a] + solution->displacement[b]) / 2);
            nodes.moved.push_back(edges.places[e] + factor * displacement);
        }
        if (has_values)
            nodes.value.push_back(
                is_known ? solution->value_at(state_.color, n)
                         : (solution->value_at(state_.color, a) + solution->value_at(state_.color, b)) / 2);
    }
    return nodes;
}

// By all that it reaches, so that a picture of each phase is as large.
void SceneBuild::extend_by_motion(const NodeSurface& surface, const PartSolution* solution, const Vec3& offset) {
    if (!solution || state_.motion == Motion::still || state_.deform == 0) return;
    for (const double share : {1.0, 0.0, state_.motion == Motion::swing ? -1.0 : 0.0}) {
        Eigen::AlignedBox3d box;
        for (std::size_t v = 0; v < surface.vertices.size(); ++v)
            box.extend(surface.vertices[v] + share * state_.deform * solution->displacement[v]);
        extend(box, offset);
    }
}

// Interfaces of a part, which come last, are seen only where parts are apart.
std::size_t SceneBuild::triangles_seen(const Layer& layer) const {
    const auto surface = session_.part_surface(layer.owner);
    if (!layer.closed || !surface || state_.explode > 0) return layer.geometry->triangle_count();
    const auto& element = layer.geometry->element;
    return static_cast<std::size_t>(
        std::find_if(element.begin(), element.end(), [&](std::int32_t f) { return surface->is_interface(f); }) -
        element.begin());
}

// At the tenths of the range of colours.
void SceneBuild::add_isolines() {
    if (!state_.isolines || !is_at_vertices(state_.color) || !built_.legend.values) return;
    const auto [low, high] = *built_.legend.values;
    std::vector<float> levels;
    for (int i = 1; i < 10; ++i) levels.push_back(static_cast<float>(low + i * (high - low) / 10));
    std::vector<Layer> lines;
    for (std::size_t i = 0; i < built_.scene.layers.size(); ++i) {
        const Layer& layer = built_.scene.layers[i];
        if (layer.fill != Fill::scale) continue;
        Layer line;
        line.kind = LayerKind::isolines;
        line.owner = layer.owner;
        line.lies_on = static_cast<int>(i);
        line.geometry =
            cache_.get(fmt::format("isolines of {} {} {} {} {}{}", static_cast<int>(layer.kind), layer.owner, low, high,
                                   state_.explode > 0, solution_key()),
                       layer.geometry, [&] { return isolines(*layer.geometry, triangles_seen(layer), levels); });
        if (line.geometry->segments.empty()) continue;
        Range range = layer.ranges.front();
        range.count = static_cast<std::uint32_t>(line.geometry->segments.size());
        range.color = colors_.feature;
        line.ranges.push_back(range);
        line.pixels = thin_pixels;
        line.clipped = layer.clipped;
        lines.push_back(std::move(line));
    }
    std::move(lines.begin(), lines.end(), std::back_inserter(built_.scene.layers));
}

// Of vertices at the surface, about evenly spread; those between parts only where these are apart.
void SceneBuild::add_vectors() {
    if (!state_.vectors || !document_.solution || step_.stage != Stage::tetrahedra) return;
    const auto number = static_cast<std::size_t>(state_.load_case);
    if (number >= document_.solution->cases.size()) return;
    std::vector<Arrow> arrows;
    std::shared_ptr<const void> source;
    const std::vector<NodeId> parts = drawn_parts();
    for (const NodeId part : parts) {
        const auto surface = session_.part_surface(part);
        const auto solution = solution_of(part);
        if (!surface || !solution) continue;
        if (!source) source = solution;
        add_arrows(*surface, *solution, offset_of(part, state_.node), arrows);
    }
    if (!source) return;
    const std::string key =
        fmt::format("vectors of {} {} {}{}", fmt::join(parts, " "), state_.explode, clip_key(0), solution_key());
    const auto geometry = cache_.get(key, source, [&] {
        const double diagonal = document_.box.diagonal().norm();
        return arrow_segments(spread(arrows, diagonal), document_.solution->cases[number].largest_displacement,
                              diagonal, built_.frame);
    });
    if (geometry->segments.empty()) return;
    const Vec3 reach = Vec3::Constant(longest_arrow(document_.box.diagonal().norm()));
    extend({built_.box.min() - reach, built_.box.max() + reach});
    Layer& layer = add(LayerKind::vectors, geometry, colors_.feature, state_.node);
    layer.pixels = thin_pixels;
    layer.shines_through = true;
    layer.clipped = false;
}

void SceneBuild::add_arrows(const NodeSurface& surface, const PartSolution& solution, const Vec3& offset,
                            std::vector<Arrow>& arrows) const {
    const double factor = state_.drawn_deformation();
    std::vector<char> is_outside(surface.vertices.size(), 0);
    for (std::int32_t f = 0; f < std::ssize(surface.facets); ++f)
        if (!surface.is_interface(f) || state_.explode > 0)
            for (const std::int32_t v : surface.facets[static_cast<std::size_t>(f)])
                is_outside[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < is_outside.size(); ++v) {
        const Vec3 place = surface.vertices[v] + factor * solution.displacement[v];
        if (is_outside[v] && (!side_ || side_->distance(place) <= 0))
            arrows.push_back({place + offset, solution.displacement[v], surface.vertices[v]});
    }
}

}  // namespace kerf::view

// Vertices are moved by the displacement times the factor of the view, in double precision and before anything is
// clipped; places at rest go along, so that the file's coordinates of a place can be told. Nodes on edges have values
// of their own in a solution of second order; in one of first order they get the mean of the ends of their edges.
// Isolines are made on the triangles of a layer as it is drawn, for which they are cached by the layer's geometry, and
// each keeps the number of its layer; the lines of all layers are added at the end, because references to layers do not
// last. Arrows stand at vertices that can be seen: on interfaces only where parts are pulled apart.
#include "viewer/scene/inside/solution_layers.h"

#include <iterator>

#include "base/core/ids.h"

namespace kerf::view {

SolvedNodes::SolvedNodes(const SceneContext& context, LayerSink& sink, NodeId part, const std::vector<Vec3>& vertices,
                         const EdgePoints& edges) {
    const ViewState& state = context.state;
    if (!context.needs_solution()) return;
    found = sink.awaited(context.session.fetched().solution(part, state.deformation.load_case));
    if (!found) return;
    const double factor = state.deformation.drawn();
    for (std::size_t v = 0; state.deformation.factor != 0 && v < vertices.size(); ++v)
        moved.emplace_back(vertices[v] + factor * found->displacement[v]);
    for (std::size_t v = 0; is_at_vertices(state.coloring.by) && v < vertices.size(); ++v)
        at_vertices.push_back(found->value_at(state.coloring.by, v));
    add_edges(state, edges);
}

// Nodes on edges of a solution of first order have the means of the ends of the edges.
void SolvedNodes::add_edges(const ViewState& state, const EdgePoints& edges) {
    const double factor = state.deformation.drawn();
    for (std::size_t e = 0; e < edges.places.size(); ++e) {
        const std::int32_t n = edges.node[e];
        const auto [a, b] = edges.ends[e];
        const bool is_known = n < count_of(found->displacement);
        if (state.deformation.factor != 0) {
            const Vec3 displacement =
                is_known ? found->displacement[n] : Vec3((found->displacement[a] + found->displacement[b]) / 2);
            moved_edges.push_back(edges.places[e] + factor * displacement);
        }
        if (is_at_vertices(state.coloring.by))
            at_edges.push_back(
                is_known ? found->value_at(state.coloring.by, n)
                         : (found->value_at(state.coloring.by, a) + found->value_at(state.coloring.by, b)) / 2);
    }
}

// Interfaces of a part, which come last, are seen only where parts are apart.
std::size_t SolutionLayers::triangles_seen(const Layer& layer) const {
    const auto surface = context_.session.fetched().part_surface(layer.owner);
    if (!layer.closed || !surface || context_.state.explosion.amount > 0) return layer.geometry->triangle_count();
    return input_triangles(*layer.geometry, *surface);
}

void SolutionLayers::add_isolines(const ValueRange& range) {
    if (!context_.state.coloring.isolines || !is_at_vertices(context_.state.coloring.by)) return;
    const auto [low, high] = range;
    std::vector<float> levels;
    for (int i = 1; i < 10; ++i) levels.push_back(static_cast<float>(low + i * (high - low) / 10));
    std::vector<Layer> lines;
    for (std::int32_t i = 0; i < count_of(sink_.layers()); ++i) {
        const Layer& layer = sink_.layers()[i];
        if (layer.fill != Fill::scale) continue;
        Layer line;
        line.kind = LayerKind::isolines;
        line.owner = layer.owner;
        line.lies_on = i;
        line.geometry = context_.cache.get(
            fmt::format("isolines of {} {} {} {} {}{}", static_cast<int>(layer.kind), layer.owner.value(), low, high,
                        context_.state.explosion.amount > 0, context_.solution_key()),
            layer.geometry, [&] { return isolines(*layer.geometry, triangles_seen(layer), levels); });
        if (line.geometry->segments.empty()) continue;
        Range all = layer.ranges.front();
        all.count = count_of(line.geometry->segments);
        all.color = context_.colors.feature;
        line.ranges.push_back(all);
        line.pixels = thin_pixels;
        line.clipped = layer.clipped;
        lines.push_back(std::move(line));
    }
    std::move(lines.begin(), lines.end(), std::back_inserter(sink_.layers()));
}

// Adds arrows at some vertices of the surface, about evenly spread; at interfaces only where parts are apart.
void SolutionLayers::add_vectors() {
    if (!context_.state.deformation.vectors || !context_.document.solution || context_.step.stage != Stage::tetrahedra)
        return;
    const std::size_t number = context_.state.deformation.load_case;
    if (number >= context_.document.solution->cases.size()) return;
    std::vector<Arrow> arrows;
    std::shared_ptr<const void> source;
    const std::vector<NodeId> parts = sink_.drawn_parts();
    for (const NodeId part : parts) {
        const auto surface = context_.session.fetched().part_surface(part);
        const auto solution = sink_.awaited(context_.session.fetched().solution(part, number));
        if (!surface || !solution) continue;
        if (!source) source = solution;
        add_arrows(*surface, *solution, context_.offset_of(part), arrows);
    }
    if (!source) return;
    const std::string key = fmt::format("vectors of {} {} {}{}", numbers_text(parts), context_.state.explosion.amount,
                                        context_.clip_key(0), context_.solution_key());
    const auto geometry = context_.cache.get(key, source, [&] {
        const double diagonal = context_.document.box.diagonal().norm();
        return arrow_segments(spread(arrows, diagonal), context_.document.solution->cases[number].largest_displacement,
                              diagonal, context_.frame);
    });
    if (geometry->segments.empty()) return;
    const Vec3 reach = Vec3::Constant(longest_arrow(context_.document.box.diagonal().norm()));
    sink_.extend(Eigen::AlignedBox3d(sink_.box().min() - reach, sink_.box().max() + reach));
    sink_.add_strokes(LayerKind::vectors, geometry, context_.colors.feature, thin_pixels);
}

void SolutionLayers::add_arrows(const NodeSurface& surface, const PartSolution& solution, const Vec3& offset,
                                std::vector<Arrow>& arrows) const {
    const double factor = context_.state.deformation.drawn();
    std::vector<char> is_outside(surface.vertices.size(), 0);
    for (std::int32_t f = 0; f < std::ssize(surface.facets); ++f)
        if (!surface.is_interface(f) || context_.state.explosion.amount > 0)
            for (const std::int32_t v : surface.facets[f]) is_outside[v] = 1;
    for (std::size_t v = 0; v < is_outside.size(); ++v) {
        const Vec3 place = surface.vertices[v] + factor * solution.displacement[v];
        if (is_outside[v] && (!context_.side || context_.side->distance(place) <= 0))
            arrows.push_back({place + offset, solution.displacement[v], surface.vertices[v]});
    }
}

}  // namespace kerf::view

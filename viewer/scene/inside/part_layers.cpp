// A part is drawn by the facets of its surface as long as nothing else of it can be seen, and by its cells where clip
// plane, filter, shrink or a selection look into it; the facets stand in while the cells are being fetched. A clip
// plane brings out the cells only of parts from which it takes something away. Walls and glass are always drawn by
// facets. Where all parts are shown whole and together, the facets between them are a range marked `inside`, which the
// renderer skips: they are most of the triangles. Where only some cells are shown, an outline of sharp edges and the
// far side as glass tell where they lie. The box of a scene holds all phases of a motion, so that every picture of it
// has the same scale.
#include "viewer/scene/inside/part_layers.h"

#include <algorithm>

namespace kerf::view {

namespace {

bool touches(const NodeSurface& surface, const std::array<std::int64_t, 4>& numbers) {
    return std::any_of(surface.vertex_number.begin(), surface.vertex_number.end(), [&](std::int64_t number) {
        return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
    });
}

}  // namespace

void PartLayers::add(const std::shared_ptr<const NodeSurface>& surface) {
    const std::vector<NodeId> parts = context_.document.tree.parts_below(context_.state.node);
    for (const NodeId part : parts)
        if (context_.is_shown(part) && context_.document.tree.find(part)->state == NodeState::done) add_part(part);
    cells_.add_selected(surface.get());
    mark_inside(parts.size());
    if (!context_.ring && !context_.has_filter()) return;
    if (context_.state.explosion.amount > 0) {
        for (const NodeId part : parts)
            if (const auto own = context_.is_shown(part) ? context_.session.fetched().part_surface(part) : nullptr)
                add_outline(part, own, context_.offset_of(part));
    } else if (surface) {
        add_outline(context_.state.node, surface, Vec3::Zero());
    }
}

// Where all parts of the body are there, whole and together, nobody sees the facets between them, which are most of the
// triangles of many parts.
void PartLayers::mark_inside(std::size_t part_count) {
    const ViewState& state = context_.state;
    std::vector<Layer>& layers = sink_.layers();
    const bool is_whole = layers.size() == part_count && std::all_of(layers.begin(), layers.end(), [](const Layer& l) {
                              return l.kind == LayerKind::part && l.closed && l.opacity == 1;
                          });
    if (!is_whole || state.node != root_node || state.explosion.amount > 0 || context_.side) return;
    for (Layer& layer : layers) {
        const auto surface = context_.session.fetched().part_surface(layer.owner);
        if (!surface) continue;
        Range& outer = layer.ranges.front();
        Range inner = outer;
        inner.first = outer.count = input_triangles(*layer.geometry, *surface);
        inner.count -= outer.count;
        inner.inside = true;
        layer.ranges.push_back(inner);
    }
}

void PartLayers::add_part(NodeId part) {
    const auto surface = sink_.awaited(context_.session.fetched().part_surface(part));
    if (!surface) return;
    const ViewState& state = context_.state;
    const Vec3 offset = context_.offset_of(part);
    const SolvedNodes solved(context_, sink_, part, surface->vertices, surface->edges);
    const std::vector<Vec3>& places = solved.places(surface->vertices);
    if (context_.ring && !touches(*surface, *context_.ring) && part != state.selection.owner) return;
    const PartFacets chosen = context_.ring ? PartFacets() : chosen_facets(context_, part, *surface);
    bool by_cells = state.explosion.shrink > 0 || context_.has_filter() || context_.ring;
    if (const auto& side = context_.side) {
        const Eigen::AlignedBox3d box = box_of(places);
        const double middle = side->distance(box.center());
        const double half = side->normal.cwiseAbs().dot(box.sizes()) / 2;
        if (middle - half > 0 || (state.clip.style == ClipStyle::layer && middle + half < 0)) return;
        by_cells |= middle + half > 0;
    }
    sink_.extend_by_facets(places, surface->facets, offset);
    extend_by_motion(*surface, solved.found.get(), offset);
    by_cells &= chosen.all;
    if (!by_cells || !sink_.awaited(cells_.add(part, *surface))) add_facets(part, surface, chosen, solved);
}

void PartLayers::add_facets(NodeId part, const std::shared_ptr<const NodeSurface>& surface, const PartFacets& chosen,
                            const SolvedNodes& solved) {
    const ColorBy color = context_.state.coloring.by;
    const Vec3 offset = context_.offset_of(part);
    std::shared_ptr<const std::vector<float>> values;
    if (context_.needs_values()) values = sink_.awaited(context_.session.fetched().facet_values(part, color));
    FacetChoice choice;
    choice.smooth = context_.state.look.shading == Shading::smooth;
    const FacetColors colors(context_, sink_, surface);
    colors.set_values(*surface, choice);
    if (values) choice.value = *values;
    const bool shows_error = solved.found && color == ColorBy::error;
    if (!solved.at_vertices.empty()) choice.vertex_value = solved.at_vertices;
    if (shows_error) choice.value = solved.found->error_at_facet;
    choice.places = solved.moved;
    choice.edges = solved.drawn(surface->edges);
    sink_.extend(solved.moved_edges.empty() ? surface->edges.places : solved.moved_edges, offset);
    if (!chosen.all) choice.wanted = [&](std::int32_t f) { return chosen.wants(*surface, f); };
    const std::shared_ptr<const void> source = solved.found    ? std::shared_ptr<const void>(solved.found)
                                               : values        ? std::shared_ptr<const void>(values)
                                               : colors.values ? std::shared_ptr<const void>(colors.values)
                                                               : surface;
    const bool is_colored = values || colors.any() || !solved.at_vertices.empty() || shows_error;
    const std::string key = fmt::format("part {} {} {}{}{}", part.value(), context_.shading_key(),
                                        is_colored ? name(color) : "plain", context_.solution_key(), chosen.key());
    const auto geometry =
        context_.cache.get(key, source, [&] { return facet_triangles(*surface, context_.frame, choice); });
    if (geometry->corners.empty()) return;
    Layer& layer = sink_.add(LayerKind::part, geometry, context_.color_of(part), part, offset);
    layer.closed = chosen.all;
    layer.two_sided = !chosen.all;
    if (is_glass(context_.state, context_.document, part)) make_glass(layer);
    if (values) layer.fill = fill_of_values(color);
    if (shows_error || !solved.at_vertices.empty()) layer.fill = Fill::scale;
    colors.finish(context_, *surface, layer);
    layer.smooth |= geometry->has_normals;
}

// Shows where in the body the shown cells lie: sharp edges, and the far side as glass, which covers no cell.
void PartLayers::add_outline(NodeId owner, const std::shared_ptr<const NodeSurface>& surface, const Vec3& offset) {
    sink_.extend(surface->vertices, offset);
    const auto lines = context_.feature_lines(surface, owner);
    if (!lines->segments.empty()) {
        Layer& layer = sink_.add(LayerKind::outline, lines, context_.colors.feature, owner, offset);
        layer.pixels = thin_pixels;
        layer.clipped = false;
    }
    FacetChoice choice;
    choice.smooth = true;
    const auto facets = context_.cache.get(fmt::format("glass of {}", owner.value()), surface,
                                           [&] { return facet_triangles(*surface, context_.frame, choice); });
    Layer& layer = sink_.add(LayerKind::glass, facets, context_.colors.context, owner, offset);
    layer.opacity = context_opacity;
    layer.edges = layer.clipped = false;
    layer.front_share = 0;
    layer.smooth = layer.two_sided = true;
}

// Extends the box by all places that a motion reaches, so that pictures of all phases have one scale.
void PartLayers::extend_by_motion(const NodeSurface& surface, const PartSolution* solution, const Vec3& offset) {
    const ViewState& state = context_.state;
    if (!solution || state.deformation.motion == Motion::still || state.deformation.factor == 0) return;
    for (const double share : {1.0, 0.0, state.deformation.motion == Motion::swing ? -1.0 : 0.0}) {
        Eigen::AlignedBox3d box;
        for (std::size_t v = 0; v < surface.vertices.size(); ++v)
            box.extend(surface.vertices[v] + share * state.deformation.factor * solution->displacement[v]);
        sink_.extend(box, offset);
    }
}

}  // namespace kerf::view

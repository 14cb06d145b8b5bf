// A surface is drawn as one geometry with two ranges, the facets of the input and those of interfaces, each with a
// colour and a switch of its own. Its layer is `closed` only if all facets are drawn, unshrunk, and known to face
// outwards: the renderer leaves out backs of such a layer, and would leave out faces of a surface that its file has
// turned. Where walls or glass are drawn, a facet with a neighbour behind it is there twice, once for each part; one of
// them is left out, by an order in which opaque regions come before glass and smaller numbers before larger ones, but
// only if the neighbour is drawn and touches the part. The context of a node is the other half of each cut above it,
// without interfaces.
#include "viewer/scene/inside/surface_layers.h"

#include <algorithm>
#include <utility>

namespace kerf::view {

namespace {

bool is_facet_shown(const NodeSurface& surface, std::int32_t facet, const ShownSide& side, ClipStyle style) {
    const Triangle& t = surface.facets[facet];
    std::array<double, 3> d = {};
    for (std::size_t k = 0; k < 3; ++k) d[k] = side.distance(surface.vertices[t[k]]);
    if (style == ClipStyle::cells) return d[0] + d[1] + d[2] <= 0;
    return std::min({d[0], d[1], d[2]}) < 0 && std::max({d[0], d[1], d[2]}) >= 0;
}

// A surface as its file has it may be open or turned; one that was cut is neither.
bool is_outward(const Document& document) {
    if (document.trace) return true;
    if (!document.checked || !document.checked->diagnosis.clean()) return false;
    const Diagnosis& diagnosis = document.checked->diagnosis;
    return diagnosis.count(DefectKind::inverted_shell) == 0 &&
           diagnosis.count(DefectKind::inconsistent_orientation) == 0 &&
           diagnosis.count(DefectKind::duplicate_facet) == 0;
}

// Whether the neighbour is drawn, too, in a place where it touches the part.
bool is_met(const SceneContext& context, NodeId part, NodeId neighbour) {
    if (!lies_below(neighbour, context.state.node) || !context.is_shown(neighbour)) return false;
    const TreeRow* row = context.document.tree.find(neighbour);
    const bool is_there = context.step.stage == Stage::parts || (row && row->state == NodeState::done);
    return is_there && context.offset_of(part) == context.offset_of(neighbour);
}

// Divides the range of a layer into two, of which those are left that the view shows; returns the number of their
// triangles.
std::size_t divide_at_interfaces(const NodeSurface& surface, const ViewState& state, const Color& interface_color,
                                 Layer& layer) {
    Range input = layer.ranges.front(), interface = input;
    input.count = input_triangles(*layer.geometry, surface);
    interface.first = input.count;
    interface.count -= input.count;
    interface.color = interface_color;
    layer.ranges.clear();
    if (state.look.surface && input.count > 0) layer.ranges.push_back(input);
    if (state.look.interfaces && interface.count > 0) layer.ranges.push_back(interface);
    std::size_t shown = 0;
    for (const Range& range : layer.ranges) shown += range.count;
    return shown;
}

}  // namespace

bool PartFacets::wants(const NodeSurface& surface, std::int32_t facet) const {
    if (!hidden_patches.empty()) {
        const std::int32_t patch = surface.patch.empty() ? -1 : surface.patch[facet];
        if (surface.is_interface(facet)) return false;  // which would stand in the way
        if (patch >= 0 && patch < std::ssize(hidden_patches) && hidden_patches[patch]) return false;
    }
    if (!by_neighbours) return true;
    const NodeId neighbour = surface.neighbour[facet];
    return neighbour.is_valid() ? !left_out.contains(neighbour) : outer;
}

std::string PartFacets::key() const {
    if (all) return "";
    std::string patches;
    for (const char is_hidden : hidden_patches) patches += is_hidden ? '1' : '0';
    return fmt::format(" {}without {}, {}", outer ? "" : "outer, ", numbers_text(left_out), patches);
}

PartFacets chosen_facets(const SceneContext& context, NodeId part, const NodeSurface& surface) {
    PartFacets chosen;
    const Document& document = context.document;
    const bool walls = context.state.visibility.walls;
    const std::string* region = context.shows_parts() ? region_of(document, part) : nullptr;
    chosen.hidden_patches = hidden_patches(context.state, document);
    chosen.by_neighbours = region && !surface.neighbour.empty() && (walls || is_glass(context.state, document, part));
    chosen.all = !chosen.by_neighbours && chosen.hidden_patches.empty();
    if (!chosen.by_neighbours) return chosen;
    chosen.outer = !walls;
    const auto order = [&](NodeId one) {
        return std::pair(is_glass(context.state, document, one), document.tree.find(one)->region);
    };
    std::set<NodeId> neighbours(surface.neighbour.begin(), surface.neighbour.end());
    neighbours.erase(NodeId::none());
    for (const NodeId neighbour : neighbours) {
        const std::string* beyond = region_of(document, neighbour);
        const bool is_wall = beyond && beyond != region;
        if (is_wall ? is_met(context, part, neighbour) && order(neighbour) < order(part)
                    : walls || is_met(context, part, neighbour))
            chosen.left_out.insert(neighbour);
    }
    return chosen;
}

FacetColors::FacetColors(const SceneContext& context, LayerSink& sink,
                         const std::shared_ptr<const NodeSurface>& surface)
    : patches(context.patch_values(*surface)),
      values(context.session.fetched().values_on(surface, context.state.coloring.by)) {
    if (context.session.pending()) sink.awaited(values);
}

void FacetColors::set_values(const NodeSurface& surface, FacetChoice& choice) const {
    choice.value = patches;
    if (!values) return;
    (values->values.size() == surface.facets.size() ? choice.value : choice.vertex_value) = values->values;
}

void FacetColors::finish(const SceneContext& context, const NodeSurface& surface, Layer& layer) const {
    if (values) layer.fill = Fill::scale;
    if (!patches.empty()) layer.fill = Fill::categories;
    if (!context.shows_patches() || surface.patch.empty()) return;
    auto numbers = std::make_shared<std::vector<std::int32_t>>();
    numbers->reserve(layer.geometry->element.size());
    for (const std::int32_t facet : layer.geometry->element) numbers->push_back(surface.patch[facet]);
    layer.patch = std::move(numbers);
}

Layer* SurfaceLayers::add(LayerKind kind, const std::shared_ptr<const NodeSurface>& surface, NodeId owner,
                          const Color& color, const Color& interface_color, const Vec3& offset) {
    const ViewState& state = context_.state;
    FacetChoice choice;
    choice.smooth = state.look.shading == Shading::smooth;
    choice.shrink = state.explosion.shrink;
    const bool by_facets = context_.side && state.clip.style != ClipStyle::smooth;
    const PartFacets chosen = chosen_facets(context_, owner, *surface);
    if (by_facets || !chosen.all)
        choice.wanted = [&](std::int32_t f) {
            return (!by_facets || is_facet_shown(*surface, f, *context_.side, state.clip.style)) &&
                   (chosen.all || chosen.wants(*surface, f));
        };
    const FacetColors colors(context_, sink_, surface);
    colors.set_values(*surface, choice);
    const std::string key = fmt::format(
        "{} of {} {} {} {}{}", static_cast<int>(kind), owner.value(), context_.shading_key(),
        by_facets ? context_.clip_key(state.explosion.shrink) : fmt::format("shrink {}", state.explosion.shrink),
        colors.any() ? name(state.coloring.by) : "plain", chosen.key());
    const auto source = colors.values ? std::shared_ptr<const void>(colors.values) : surface;
    auto geometry = context_.cache.get(key, source, [&] { return facet_triangles(*surface, context_.frame, choice); });
    sink_.extend_by_facets(surface->vertices, surface->facets, offset);
    if (geometry->corners.empty()) return nullptr;
    Layer& layer = sink_.add(kind, geometry, color, owner, offset);
    layer.clipped = !by_facets;
    colors.finish(context_, *surface, layer);
    const std::size_t shown = divide_at_interfaces(*surface, state, interface_color, layer);
    layer.closed =
        chosen.all && shown == surface->facets.size() && state.explosion.shrink == 0 && is_outward(context_.document);
    layer.two_sided = !chosen.all;
    if (context_.shows_parts() && is_glass(state, context_.document, owner)) make_glass(layer);
    return &layer;
}

void SurfaceLayers::add_features(const std::shared_ptr<const NodeSurface>& surface, NodeId owner, const Vec3& offset) {
    if (!context_.state.look.features) return;
    const auto lines = context_.feature_lines(surface, owner);
    if (lines->segments.empty()) return;
    sink_.add(LayerKind::features, lines, context_.colors.feature, owner, offset).pixels = feature_pixels;
}

void SurfaceLayers::add_of_file(NodeId which) {
    const auto surface = sink_.awaited(context_.session.fetched().surface(which));
    if (!surface || context_.state.visibility.is_hidden(root_node)) return;
    const SceneColors& colors = context_.colors;
    Layer* layer = add(LayerKind::file_surface, surface, which, colors.surface, colors.interface);
    if (!layer) return;
    if (which == not_repaired) layer->closed = false;
    add_features(surface, which);
}

void SurfaceLayers::add_parts() {
    for (const NodeId part : context_.document.tree.parts_below(context_.state.node)) {
        if (!context_.is_shown(part)) continue;
        const auto surface = sink_.awaited(context_.session.fetched().part_surface(part));
        const Color color = context_.color_of(part);
        const Vec3 offset = context_.offset_of(part);
        if (surface && add(LayerKind::part, surface, part, color, color, offset)) add_features(surface, part, offset);
    }
}

// The facets of the input that the node does not have: those of the other half at each cut above it. Numbers would not
// tell, since a facet that a straight cut has split has pieces on both sides.
void SurfaceLayers::add_context() {
    if (!context_.state.look.context) return;
    for (NodeId node = context_.state.node; node > root_node; node = parent_of(node)) {
        const NodeId other = sibling_of(node);
        const auto surface = sink_.awaited(context_.session.fetched().surface(other));
        if (!surface) continue;
        FacetChoice choice;
        choice.wanted = [&](std::int32_t f) { return !surface->is_interface(f); };
        choice.smooth = true;
        auto geometry = context_.cache.get(fmt::format("context {}", other.value()), surface,
                                           [&] { return facet_triangles(*surface, context_.frame, choice); });
        if (geometry->corners.empty()) continue;
        Layer& layer = sink_.add(LayerKind::context, geometry, context_.colors.context, other);
        make_glass(layer);
        layer.smooth = true;
        sink_.extend(surface->vertices);
    }
}

}  // namespace kerf::view

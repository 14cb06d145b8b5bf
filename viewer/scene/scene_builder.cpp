#include "viewer/scene/scene_builder.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/scene_build.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr float shell_opacity = 0.55f, shell_front_share = 0.12f;  // of the node's surface around what is inside

bool is_facet_shown(const NodeSurface& surface, std::int32_t facet, const ShownSide& side, ClipStyle style) {
    const Triangle& t = surface.facets[static_cast<std::size_t>(facet)];
    std::array<double, 3> d = {};
    for (std::size_t k = 0; k < 3; ++k) d[k] = side.distance(surface.vertices[static_cast<std::size_t>(t[k])]);
    if (style == ClipStyle::cells) return d[0] + d[1] + d[2] <= 0;
    return std::min({d[0], d[1], d[2]}) < 0 && std::max({d[0], d[1], d[2]}) >= 0;
}

// A surface as its file has it may be open or turned; what was cut is neither.
bool is_outward(const Document& document) {
    if (document.trace) return true;
    if (!document.checked || !document.checked->diagnosis.clean()) return false;
    const Diagnosis& diagnosis = document.checked->diagnosis;
    return diagnosis.count(DefectKind::inverted_shell) == 0 &&
           diagnosis.count(DefectKind::inconsistent_orientation) == 0 &&
           diagnosis.count(DefectKind::duplicate_facet) == 0;
}

}  // namespace

std::string SceneBuild::clip_key(double shrink) const {
    std::string key = fmt::format("shrink {}", shrink);
    if (side_)
        key += fmt::format(" {} {} {} {} {}", name(state_.clip.style), side_->normal.x(), side_->normal.y(),
                           side_->normal.z(), side_->offset);
    if (ring_) key += fmt::format(" around {}", fmt::join(*ring_, " "));
    if (has_filter()) key += fmt::format(" filter {} {}", state_.filter->low, state_.filter->high);
    return key;
}

Layer& SceneBuild::add(LayerKind kind, std::shared_ptr<const Geometry> geometry, const Color& color, NodeId owner,
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
    layer.edges = state_.edges;
    layer.smooth = state_.shading == Shading::smooth;
    return built_.scene.layers.emplace_back(std::move(layer));
}

Layer& SceneBuild::add_lines(LayerKind kind, const std::vector<std::array<Vec3, 2>>& ends, const Color& color,
                             float pixels) {
    Layer& layer = add(kind, segments(ends, built_.frame), color, state_.node);
    layer.pixels = pixels;
    layer.shines_through = true;
    layer.clipped = false;
    return layer;
}

void SceneBuild::add_points(LayerKind kind, const std::vector<Vec3>& places, const Color& color, float pixels) {
    Layer& layer = add(kind, points(places, built_.frame), color, state_.node);
    layer.pixels = pixels;
    layer.shines_through = true;
    layer.clipped = false;
}

// Empty unless they are asked for.
std::vector<float> SceneBuild::patch_values(const NodeSurface& surface) const {
    std::vector<float> values;
    if (state_.color != ColorBy::patch) return values;
    for (const std::int32_t patch : surface.patch) {
        const auto i = static_cast<std::size_t>(patch);
        if (patch < 0)
            values.push_back(std::nanf(""));
        else
            values.push_back(i < palette_of_patch_.size() ? palette_of_patch_[i] : static_cast<float>(patch));
    }
    return values;
}

std::shared_ptr<const SurfaceValues> SceneBuild::values_on(const std::shared_ptr<const NodeSurface>& surface) {
    auto values = session_.values_on(surface, state_.color);
    built_.pending |= !values && session_.pending();
    return values;
}

// `values` may be null, `patches` empty.
void SceneBuild::color_facets(const NodeSurface& surface, const SurfaceValues* values,
                              const std::vector<float>& patches, FacetChoice& choice) const {
    choice.value = patches;
    if (!values) return;
    (values->values.size() == surface.facets.size() ? choice.value : choice.vertex_value) = values->values;
}

// The facets of a surface: one range of the input's and one of the interfaces'. Nothing if the clip plane leaves none.
Layer* SceneBuild::add_surface(LayerKind kind, const std::shared_ptr<const NodeSurface>& surface, NodeId owner,
                               const Color& color, const Color& interface_color, const Vec3& offset) {
    FacetChoice choice;
    choice.smooth = state_.shading == Shading::smooth;
    choice.shrink = state_.shrink;
    const bool by_facets = side_ && state_.clip.style != ClipStyle::smooth;
    const PartFacets chosen = chosen_facets(owner, *surface);
    if (by_facets || !chosen.all)
        choice.wanted = [&](std::int32_t f) {
            return (!by_facets || is_facet_shown(*surface, f, *side_, state_.clip.style)) &&
                   (chosen.all || chosen.wants(*surface, f));
        };
    const std::vector<float> patches = patch_values(*surface);
    const auto values = values_on(surface);
    color_facets(*surface, values.get(), patches, choice);
    const std::string key = fmt::format("{} of {} {} {} {}{}", static_cast<int>(kind), owner, shading_key(),
                                        by_facets ? clip_key(state_.shrink) : fmt::format("shrink {}", state_.shrink),
                                        values || !patches.empty() ? view::name(state_.color) : "plain", chosen.key());
    const std::shared_ptr<const void> source = values ? std::shared_ptr<const void>(values) : surface;
    auto geometry = cache_.get(key, source, [&] { return facet_triangles(*surface, built_.frame, choice); });
    extend_by_facets(surface->vertices, surface->facets, offset);
    if (geometry->corners.empty()) return nullptr;
    Layer& layer = add(kind, geometry, color, owner, offset);
    layer.clipped = !by_facets;
    if (!patches.empty()) layer.fill = Fill::categories;
    if (values) layer.fill = Fill::scale;
    number_facets(layer, *surface);
    const auto& element = geometry->element;
    const auto first_interface =
        std::find_if(element.begin(), element.end(), [&](std::int32_t f) { return surface->is_interface(f); });
    Range input = layer.ranges.front(), interface = input;
    input.count = static_cast<std::uint32_t>(first_interface - element.begin());
    interface.first = input.count;
    interface.count -= input.count;
    interface.color = interface_color;
    layer.ranges.clear();
    if (state_.surface && input.count > 0) layer.ranges.push_back(input);
    if (state_.interfaces && interface.count > 0) layer.ranges.push_back(interface);
    std::size_t shown = 0;
    for (const Range& range : layer.ranges) shown += range.count;
    layer.closed = chosen.all && shown == surface->facets.size() && state_.shrink == 0 && is_outward(document_);
    layer.two_sided = !chosen.all;
    if (shows_parts() && is_glass(state_, document_, owner)) make_glass(layer);
    return &layer;
}

// Patches by their numbers, where these are to be read on the faces.
void SceneBuild::number_facets(Layer& layer, const NodeSurface& surface) const {
    if (!numbers_patches() || surface.patch.empty()) return;
    auto patches = std::make_shared<std::vector<std::int32_t>>();
    patches->reserve(layer.geometry->element.size());
    for (const std::int32_t facet : layer.geometry->element)
        patches->push_back(surface.patch[static_cast<std::size_t>(facet)]);
    layer.patch = std::move(patches);
}

// The surface of the node itself, and what its cut did to it.
void SceneBuild::add_node(const std::shared_ptr<const NodeSurface>& surface) {
    Layer* layer = nullptr;
    if (!state_.is_hidden(state_.node))
        layer = add_surface(LayerKind::surface, surface, state_.node, colors_.surface, colors_.interface, Vec3::Zero());
    const Cut* cut = document_.trace ? document_.trace->find(state_.node) : nullptr;
    const TreeRow* row = document_.tree.find(state_.node);
    const auto number = static_cast<std::size_t>(step_.refused_try);
    const CutTry* attempt = step_.refused_try >= 0 && cut && number < cut->tries.size() ? &cut->tries[number] : nullptr;
    // What lies inside is to be seen.
    if (layer && (step_.stage >= Stage::projected || (attempt && !attempt->collisions.empty()))) {
        layer->opacity = shell_opacity;
        layer->front_share = shell_front_share;
        layer->edges = false;
        layer->two_sided = true;
    }
    if (attempt)
        add_try(*attempt, *surface);
    else if (step_.stage >= Stage::plane && row && row->plane())
        add_plane(*row->plane());
    if (cut && step_.refused_try < 0) add_stage(*cut, *surface);
    if (step_.stage == Stage::input && row) add_axes(*row);
    if (layer) add_features(surface, state_.node, Vec3::Zero());
}

// What was cut looks like it from afar, so that the one comes in the place of the other. `which`: not_remeshed or
// not_repaired.
void SceneBuild::add_file_surface(NodeId which) {
    const auto surface = session_.surface(which);
    built_.pending |= !surface;
    if (!surface || state_.is_hidden(1)) return;
    Layer* layer =
        add_surface(LayerKind::file_surface, surface, which, colors_.surface, colors_.interface, Vec3::Zero());
    if (!layer) return;
    if (which == not_repaired) layer->closed = false;
    add_features(surface, which, Vec3::Zero());
}

void SceneBuild::add_features(const std::shared_ptr<const NodeSurface>& surface, NodeId owner, const Vec3& offset) {
    if (!state_.features) return;
    const auto geometry = cache_.get(fmt::format("features of {}", owner), surface,
                                     [&] { return segments(feature_edges(*surface), built_.frame); });
    if (geometry->segments.empty()) return;
    add(LayerKind::features, geometry, colors_.feature, owner, offset).pixels = feature_pixels;
}

// The facets of the input that the node does not have: those of the other half at each cut above it. Numbers would not
// tell, since a facet that a straight cut has split has pieces on both sides.
void SceneBuild::add_context() {
    if (!state_.context) return;
    for (NodeId node = state_.node; node > 1; node /= 2) {
        const NodeId other = node ^ 1;
        const auto surface = session_.surface(other);
        built_.pending |= !surface;
        if (!surface) continue;
        FacetChoice choice;
        choice.wanted = [&](std::int32_t f) { return !surface->is_interface(f); };
        choice.smooth = true;
        auto geometry = cache_.get(fmt::format("context {}", other), surface,
                                   [&] { return facet_triangles(*surface, built_.frame, choice); });
        if (geometry->corners.empty()) continue;
        Layer& layer = add(LayerKind::context, geometry, colors_.context, other);
        make_glass(layer);
        layer.smooth = true;
        extend(document_.box);
    }
}

void SceneBuild::add_selection() {
    const Selection& s = state_.selection;
    if (s.kind == Selection::Kind::none) return;
    std::vector<Vec3> corners = selected_points(session_, s);
    built_.pending |= corners.empty();
    const bool moves = s.kind != Selection::Kind::place && s.kind != Selection::Kind::defect;
    const bool apart = step_.stage >= Stage::split && moves && s.owner != state_.node;
    const Vec3 offset = apart ? offset_of(s.owner, state_.node) : Vec3::Zero();
    for (Vec3& p : corners) p += offset;
    std::vector<std::array<Vec3, 2>> edges = selected_edges(session_, s);
    for (auto& [from, to] : edges) {
        from += offset;
        to += offset;
    }
    if (!edges.empty()) add_lines(LayerKind::selection, edges, colors_.selection, contour_pixels);
    if (corners.size() == 1) add_points(LayerKind::selected_place, corners, colors_.selection, 12);
}

BuiltScene SceneBuild::run() {
    built_.frame = Frame::around(document_.box);
    const std::vector<Step> steps = steps_of(document_, state_.node);
    step_ = steps[nearest_step(steps, state_.step)];
    for (const NodeId part : document_.tree.parts_below(1)) part_order_.emplace(part, part_order_.size());
    if (state_.clip.on && !document_.box.isEmpty()) {
        side_ = shown_side(state_.clip, document_.box);
        built_.scene.clip = clip_plane(*side_, built_.frame);
    }
    if (state_.explode > 0) moves_of_regions_ = moves_apart(document_.region_places);
    set_colors();
    if (document_.kind == Document::Kind::none || document_.box.isEmpty()) return std::move(built_);

    const auto surface = surface_of(session_, state_.node);
    built_.pending |= !surface;
    if (step_.stage == Stage::before_repair)
        add_file_surface(not_repaired);
    else if (step_.stage == Stage::before_remeshing)
        add_file_surface(not_remeshed);
    else if (step_.stage == Stage::tetrahedra)
        add_tetrahedra(surface);
    else if (step_.stage == Stage::parts)
        add_part_surfaces();
    else if (step_.stage == Stage::split)
        add_halves(surface.get());
    else if (surface)
        add_node(surface);
    if (surface) add_context();
    if (step_.stage == Stage::before_repair)
        add_defects(document_.unrepaired.get());
    else if (step_.stage == (document_.remeshed ? Stage::before_remeshing : Stage::input))
        add_defects(document_.checked.get());
    add_selection();
    set_range_of_values();
    add_isolines();
    mark_extremes();
    add_vectors();
    set_legend();
    if (state_.context) extend(document_.box);
    built_.pending &= session_.pending() || session_.busy();  // what failed does not come
    return std::move(built_);
}

Vec3 explosion_offset(const Tree& tree, NodeId part, NodeId root, double explode, double diagonal) {
    Vec3 offset = Vec3::Zero();
    if (!(explode > 0)) return offset;
    for (NodeId node = part; node > root; node /= 2) {
        const TreeRow* parent = tree.find(node / 2);
        if (!parent || !parent->plane()) continue;
        // As long as a cube of the parent's volume; without a volume, less with every level.
        const double length = parent->volume > 0 ? std::cbrt(parent->volume) : diagonal / (2 + level_of(node));
        offset += (node % 2 == 0 ? -0.5 : 0.5) * explode * length * parent->plane()->normal;
    }
    return offset;
}

BuiltScene SceneBuilder::build(const ViewState& state, Session& session) {
    BuiltScene built = SceneBuild(state, session, cache_).run();
    cache_.age();
    return built;
}

}  // namespace kerf::view

// The order of building matters. The colour scale begins with all that is known before layers exist; add_layers() adds
// the layers of the step, the rest of the body and the defects; the scale then follows the values that are drawn.
// Isolines, extremes and arrows need its range and the layers below them, and the legend, at the end, explains a
// finished scene. Each maker of layers (SurfaceLayers, CutLayers, PartLayers with CellLayers, SolutionLayers) reads one
// SceneContext and writes to one LayerSink. A scene is pending where something was not there yet and is still on its
// way: a fetch that has failed does not make it wait for ever. In explosions each cut between a part and the root moves
// its halves apart along its normal, by the edge of a cube with the volume of its node (times Explosion::amount), so
// that pieces of very different sizes part in proportion.
#include "viewer/scene/scene_builder.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/inside/cut_layers.h"
#include "viewer/scene/inside/legend.h"
#include "viewer/scene/inside/part_layers.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

// Between cells everything is a hollow, and values are to be found in the legend, too.
constexpr float occlusion_of_bodies = 1, occlusion_of_cells = 0.4;

constexpr std::size_t most_cached_bytes = std::size_t{1} << 30;

std::size_t bytes_in(const Geometry& geometry) {
    return geometry.corners.size() * sizeof(Corner) + geometry.segments.size() * sizeof(Segment) +
           geometry.points.size() * sizeof(geometry.points[0]) + geometry.element.size() * sizeof(std::int32_t) +
           geometry.rest.size() * sizeof(geometry.rest[0]) + geometry.origins.size() * sizeof(geometry.origins[0]);
}

void add_selection(const SceneContext& context, LayerSink& sink) {
    const Selection& s = context.state.selection;
    if (s.kind == Selection::Kind::none) return;
    std::vector<Vec3> corners = selected_points(context.session, s);
    sink.awaited(!corners.empty());
    const bool moves = s.kind != Selection::Kind::place && s.kind != Selection::Kind::defect;
    const bool apart = context.step.stage >= Stage::split && moves && s.owner != context.state.node;
    const Vec3 offset = apart ? context.offset_of(s.owner) : Vec3::Zero();
    for (Vec3& p : corners) p += offset;
    std::vector<std::array<Vec3, 2>> edges = selected_edges(context.session, s);
    for (auto& [from, to] : edges) {
        from += offset;
        to += offset;
    }
    if (!edges.empty()) sink.add_lines(LayerKind::selection, edges, context.colors.selection, contour_pixels);
    if (corners.size() == 1) sink.add_points(LayerKind::selected_place, corners, context.colors.selection, 12);
}

// Adds the layers of the step, and those of its surroundings.
void add_layers(const SceneContext& context, LayerSink& sink) {
    const Document& document = context.document;
    const Stage stage = context.step.stage;
    SurfaceLayers surfaces(context, sink);
    CutLayers cuts(context, sink, surfaces);
    const auto surface = sink.awaited(surface_of(context.session, context.state.node));
    if (stage == Stage::before_repair)
        surfaces.add_of_file(not_repaired);
    else if (stage == Stage::before_remeshing)
        surfaces.add_of_file(not_remeshed);
    else if (stage == Stage::tetrahedra)
        PartLayers(context, sink).add(surface);
    else if (stage == Stage::parts)
        surfaces.add_parts();
    else if (stage == Stage::split)
        cuts.add_halves(surface.get());
    else if (surface)
        cuts.add_node(surface);
    cuts.add_axes();
    if (surface) surfaces.add_context();
    if (stage == Stage::before_repair)
        add_defects(context, sink, document.unrepaired.get());
    else if (stage == (document.remeshed ? Stage::before_remeshing : Stage::input))
        add_defects(context, sink, document.checked.get());
    add_selection(context, sink);
    // The picture has one scale from step to step.
    if (context.state.look.context && !surface)
        sink.extend(document.box);
    else if (context.state.look.context)
        sink.extend(surface->vertices);
}

BuiltScene build_scene(SceneContext& context) {
    const ViewState& state = context.state;
    const Document& document = context.document;
    BuiltScene built;
    Scene& scene = built.scene;
    built.frame = context.frame;
    if (context.side) scene.clip = clip_plane(*context.side, context.frame);
    scene.background_top = context.colors.background_top;
    scene.background_bottom = context.colors.background_bottom;
    scene.edge = context.colors.edge;
    scene.palette = context.palette;
    LayerSink sink(context, built);
    ScaleMaker scale(context, sink, built);
    scale.begin();
    if (document.kind == Document::Kind::none || document.box.isEmpty()) return built;

    if (context.step.stage == Stage::tetrahedra && state.visibility.neighbours &&
        state.selection.kind == Selection::Kind::cell)
        context.ring = sink.awaited(selected_cell(context.session, state.selection));
    add_layers(context, sink);
    scale.follow_layers();
    SolutionLayers lines(context, sink);
    if (built.legend.values) lines.add_isolines(*built.legend.values);
    scale.mark_extremes();
    const bool is_busy = std::any_of(scene.layers.begin(), scene.layers.end(), [](const Layer& layer) {
        return layer.fill != Fill::plain || layer.kind == LayerKind::cells;
    });
    scene.occlusion = is_busy ? occlusion_of_cells : occlusion_of_bodies;
    lines.add_vectors();
    LegendMaker(context, scene, sink.drawn_parts(), built.legend).run();
    built.pending &= context.session.pending() || context.session.busy();  // a value whose fetch failed does not come
    return built;
}

}  // namespace

void GeometryCache::age() {
    std::size_t bytes = 0;
    std::vector<std::pair<std::int64_t, std::string>> oldest;
    for (const auto& [key, entry] : entries_) {
        bytes += bytes_in(*entry.geometry);
        oldest.emplace_back(entry.last_use, key);
    }
    if (bytes > most_cached_bytes) std::sort(oldest.begin(), oldest.end());
    for (const auto& [last_use, key] : oldest) {
        if (bytes <= most_cached_bytes || last_use == now_) break;
        bytes -= bytes_in(*entries_.at(key).geometry);
        entries_.erase(key);
    }
    ++now_;
}

Vec3 explosion_offset(const Tree& tree, NodeId part, NodeId root, double explode, double diagonal) {
    Vec3 offset = Vec3::Zero();
    if (!(explode > 0)) return offset;
    for (NodeId node = part; node > root; node = parent_of(node)) {
        const TreeRow* parent = tree.find(parent_of(node));
        if (!parent || !parent->plane()) continue;
        // As long as a cube of the parent's volume; without a volume, less with every level.
        const double length = parent->volume > 0 ? std::cbrt(parent->volume) : diagonal / (2 + level_of(node));
        offset += (side_of(node) == 0 ? -0.5 : 0.5) * explode * length * parent->plane()->normal;
    }
    return offset;
}

BuiltScene SceneBuilder::build(const ViewState& state, Session& session) {
    SceneContext context(state, session, cache_);
    BuiltScene built = build_scene(context);
    cache_.age();
    return built;
}

}  // namespace kerf::view

// A node is drawn as its surface and the layers of one step of its cut: a refused try with the places where it failed,
// or a stage from the plane to the interface. Stages of the contour are lists of edges by the vertex numbers of the
// node's surface, as the trace has them, so that they can only be drawn on that surface; loops of the contour are drawn
// as they are, or projected into the plane. The stages from `projected` on lie inside of the body, for which its
// surface becomes a translucent shell. Sections are shaded little or not at all, so that they have the colour of the
// legend. Halves are drawn apart, each with a copy of the contour as a range of one layer. Principal axes reach twice
// the standard deviation of the vertices to both sides. With C_k for the sum of squared distances along axis k, the
// eigenvalues of inertia are C_0 + C_1 + C_2 - C_k, and half of their sum is C_0 + C_1 + C_2, from which C_k and the
// variance follow.
#include "viewer/scene/inside/cut_layers.h"

#include "base/core/ids.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr float plane_opacity = 0.3f;
constexpr float shell_opacity = 0.55f, shell_front_share = 0.12f;  // of the node's surface around things inside of it
constexpr float flat_shading = 0, interface_shading = 0.4f;        // so that sections have the colour of the legend

// The lines of edges of a try or a cut.
std::vector<std::array<Vec3, 2>> ends_of(const std::vector<SurfaceEdge>& edges, const NodeSurface& surface) {
    std::vector<std::array<Vec3, 2>> ends;
    for (const SurfaceEdge& edge : edges)
        if (std::min(edge[0], edge[1]).is_valid() && std::max(edge[0], edge[1]).value() < count_of(surface.vertices))
            ends.push_back({surface.vertices[edge[0].value()], surface.vertices[edge[1].value()]});
    return ends;
}

std::vector<std::array<Vec3, 2>> loops_of(const Cut& cut, const NodeSurface& surface, bool projected) {
    std::vector<std::array<Vec3, 2>> ends;
    const auto place = [&](Vertex v) -> Vec3 {
        const Vec3& p = surface.vertices[v.value()];
        return projected ? cut.plane.lift(cut.plane.project(p), 0) : p;
    };
    for (const std::vector<Vertex>& loop : cut.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            ends.push_back({place(loop[i]), place(loop[(i + 1) % loop.size()])});
    return ends;
}

const std::vector<SurfaceEdge>* edges_of(const Cut& cut, Stage stage) {
    switch (stage) {
        case Stage::crossed_edges:
            return &cut.stages.crossed_edges;
        case Stage::hanging_removed:
            return &cut.stages.hanging_edges_removed;
        case Stage::closed_loops:
            return &cut.stages.closed_loops;
        case Stage::paths_removed:
            return &cut.stages.multiple_paths_removed;
        default:
            return nullptr;
    }
}

}  // namespace

Color color_of(Stage stage, const SceneColors& colors) {
    if (stage == Stage::plane) return colors.plane;
    if (stage < Stage::contour) return colors.crossed;
    if (stage == Stage::contour) return colors.contour;
    return stage == Stage::projected ? colors.projected : colors.interface;
}

const Cut* CutLayers::cut() const {
    return context_.document.trace ? context_.document.trace->find(context_.state.node) : nullptr;
}

void CutLayers::add_node(const std::shared_ptr<const NodeSurface>& surface) {
    const SceneColors& colors = context_.colors;
    const NodeId node = context_.state.node;
    const Step& step = context_.step;
    Layer* layer = nullptr;
    if (!context_.state.visibility.is_hidden(node))
        layer = surfaces_.add(LayerKind::surface, surface, node, colors.surface, colors.interface);
    const Cut* cut = this->cut();
    const TreeRow* row = context_.document.tree.find(node);
    const std::int32_t number = step.refused_try;
    const CutTry* attempt = number >= 0 && cut && number < count_of(cut->tries) ? &cut->tries[number] : nullptr;
    // Things inside of the surface are to be seen.
    if (layer && (step.stage >= Stage::projected || (attempt && !attempt->collisions.empty()))) {
        layer->opacity = shell_opacity;
        layer->front_share = shell_front_share;
        layer->edges = false;
        layer->two_sided = true;
    }
    if (attempt)
        add_try(*attempt, *surface);
    else if (step.stage >= Stage::plane && row && row->plane())
        add_plane(*row->plane());
    if (cut && step.refused_try < 0) add_stage(*cut, *surface);
    if (layer) surfaces_.add_features(surface, node);
}

// Axes reach twice the standard deviation of the vertices to both sides.
void CutLayers::add_axes() {
    const TreeRow* found = context_.document.tree.find(context_.state.node);
    if (!found || found->regions > 1 || !context_.state.look.has_axes(context_.step.stage)) return;
    const TreeRow& row = *found;
    if (!sink_.awaited(row.centroid) || row.vertices <= 0) return;
    const double half_trace = row.eigenvalues.sum() / 2;
    std::vector<std::array<Vec3, 2>> ends;
    for (int k = 0; k < 3; ++k) {
        const double variance = (half_trace - row.eigenvalues[k]) / row.vertices;
        const Vec3 reach = 2 * std::sqrt(std::max(variance, 0.0)) * row.axes.col(k);
        ends.push_back({*row.centroid - reach, *row.centroid + reach});
    }
    Layer& layer = sink_.add_lines(LayerKind::axes, ends, context_.colors.axes[0], contour_pixels);
    const Range all = layer.ranges.front();
    layer.ranges.clear();
    for (std::uint32_t k = 0; k < 3; ++k) {
        Range range = all;
        range.first = k;
        range.count = 1;
        range.color = context_.colors.axes[k];
        layer.ranges.push_back(range);
    }
    sink_.add_points(LayerKind::centre, {*row.centroid}, context_.colors.contour, 11);
}

void CutLayers::add_plane(const Plane& plane) {
    if (!context_.state.look.plane) return;
    const auto surface = context_.session.fetched().surface(context_.state.node);
    const Eigen::AlignedBox3d box = surface ? box_of(surface->vertices) : context_.document.box;
    // Where the section lies in the plane, its own colour is to be seen.
    if (context_.step.stage < Stage::triangulation) {
        Layer& sheet = sink_.add(LayerKind::plane, plane_rectangle(plane, box, context_.frame), context_.colors.plane);
        sheet.opacity = plane_opacity;
        sheet.clipped = sheet.edges = sheet.smooth = false;
        sheet.two_sided = true;
    }
    Layer& outline =
        sink_.add(LayerKind::plane_outline, plane_outline(plane, box, context_.frame), context_.colors.normal);
    outline.pixels = thin_pixels;
    outline.clipped = false;
    sink_.extend(box);
}

void CutLayers::add_try(const CutTry& attempt, const NodeSurface& surface) {
    add_plane(attempt.plane);
    if (context_.state.look.contour && !attempt.contour.empty())
        sink_.add_lines(LayerKind::refused, ends_of(attempt.contour, surface), context_.colors.refused, contour_pixels);
    if (!attempt.places.empty())
        sink_.add_points(LayerKind::places, attempt.places, context_.colors.error, place_pixels);
    add_collisions(attempt);
}

// Pairs of triangles of which one goes through the other.
void CutLayers::add_collisions(const CutTry& attempt) {
    if (attempt.collisions.empty() || !context_.state.look.interfaces) return;
    const auto add_side = [&](LayerKind kind, std::array<Vec3, 3> Collision::*side, const Color& color) {
        std::vector<Vec3> corners;
        std::vector<Triangle> sides;
        for (const Collision& pair : attempt.collisions) {
            const std::int32_t first = count_of(corners);
            corners.insert(corners.end(), (pair.*side).begin(), (pair.*side).end());
            sides.push_back({first, first + 1, first + 2});
        }
        Layer& layer = sink_.add(kind, triangles(corners, sides, context_.frame), color);
        layer.two_sided = layer.edges = true;
        layer.smooth = false;
    };
    add_side(LayerKind::colliding, &Collision::first, context_.colors.colliding);
    add_side(LayerKind::collided, &Collision::second, context_.colors.collided);
}

Layer& CutLayers::add_contour(const Cut& cut, const NodeSurface& surface) {
    return sink_.add_lines(LayerKind::contour, loops_of(cut, surface, false), context_.colors.contour, contour_pixels);
}

void CutLayers::add_section(LayerKind kind, const std::vector<Vec3>& places, const std::vector<Triangle>& facets,
                            float shading) {
    Layer& layer = sink_.add(kind, triangles(places, facets, context_.frame), context_.colors.interface);
    layer.two_sided = true;
    layer.smooth = false;
    layer.shading = shading;
}

// The stages from the crossed edges to the interface.
void CutLayers::add_stage(const Cut& cut, const NodeSurface& surface) {
    const Stage stage = context_.step.stage;
    const bool shows_contour = context_.state.look.contour, shows_section = context_.state.look.interfaces;
    if (const std::vector<SurfaceEdge>* edges = edges_of(cut, stage)) {
        if (shows_contour)
            sink_.add_lines(layer_of(stage), ends_of(*edges, surface), color_of(stage, context_.colors),
                            stage == Stage::crossed_edges ? 2.f : contour_pixels);
        return;
    }
    if (stage < Stage::contour) return;
    if (shows_contour && stage != Stage::triangulation) add_contour(cut, surface);
    if (shows_contour && (stage == Stage::projected || stage == Stage::triangulation))
        sink_.add_lines(LayerKind::projected, loops_of(cut, surface, true), context_.colors.projected, contour_pixels);
    if (shows_section && stage == Stage::triangulation) {
        std::vector<Vec3> places;
        for (const Vec2& q : cut.interface.planar) places.push_back(cut.plane.lift(q, 0));
        add_section(LayerKind::triangulation, places, cut.interface.triangles, flat_shading);
    }
    if (shows_section && stage == Stage::interface)
        add_section(LayerKind::interface, cut.interface.points, cut.interface.triangles, interface_shading);
}

void CutLayers::add_halves(const NodeSurface* parent) {
    const NodeId node = context_.state.node;
    const Cut* cut = this->cut();
    Layer* contour = cut && parent && context_.state.look.contour ? &add_contour(*cut, *parent) : nullptr;
    std::vector<Range> contours;
    for (const NodeId half : halves_of(node)) {
        if (!contour || !context_.is_shown(half)) continue;
        contours.push_back(contour->ranges.front());
        contours.back().owner = half;
        contours.back().offset = sink_.move_of(context_.offset_of(half));
    }
    if (contour) contour->ranges = contours;
    for (const NodeId half : halves_of(node)) {
        if (!context_.is_shown(half)) continue;
        const auto surface = sink_.awaited(surface_of(context_.session, half));
        const Vec3 offset = context_.offset_of(half);
        if (surface &&
            surfaces_.add(LayerKind::half, surface, half, half_color(half), context_.colors.interface, offset))
            surfaces_.add_features(surface, half, offset);
    }
}

void add_defects(const SceneContext& context, LayerSink& sink, const CheckedSoup* found) {
    if (!found || context.state.node != root_node) return;
    const CheckedSoup& checked = *found;
    const Soup& soup = checked.soup;
    const auto point = [&](std::int32_t v) { return soup.vertices[v]; };
    std::vector<Vec3> errors, warnings;
    std::vector<std::array<Vec3, 2>> edges;
    std::vector<Triangle> facets;
    for (const Defect& defect : checked.diagnosis.defects) {
        if (defect.severity == Severity::repaired) continue;
        const bool is_error = defect.severity == Severity::error;
        (is_error ? errors : warnings).push_back(defect.where);
        if (!is_error) continue;
        const bool is_loop = defect.kind == DefectKind::open_edge;
        if (is_loop || defect.kind == DefectKind::non_manifold_edge)
            for (std::size_t i = 0; i + 1 < defect.vertices.size() + (is_loop ? 1 : 0); ++i)
                edges.push_back({point(defect.vertices[i]), point(defect.vertices[(i + 1) % defect.vertices.size()])});
        if (!is_loop)
            for (const std::int32_t f : defect.facets) facets.push_back(soup.facets[f]);
    }
    // Warnings are many, and keep no mesh away: errors are seen without them, and a repair has taken what mattered.
    if (!errors.empty() || context.document.unrepaired) warnings.clear();
    if (!facets.empty()) {
        Layer& layer = sink.add(LayerKind::defects, triangles(soup.vertices, facets, context.frame),
                                context.colors.error, root_node);
        layer.two_sided = true;
    }
    if (!edges.empty()) sink.add_lines(LayerKind::defect_edges, edges, context.colors.error, contour_pixels);
    if (!warnings.empty())
        sink.add_points(LayerKind::warning_places, warnings, context.colors.warning, place_pixels - 2);
    if (!errors.empty()) sink.add_points(LayerKind::defect_places, errors, context.colors.error, place_pixels);
}

}  // namespace kerf::view

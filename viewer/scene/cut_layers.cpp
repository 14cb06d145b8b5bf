// What one cut did, stage by stage.
#include "viewer/scene/scene_build.h"

namespace kerf::view {

namespace {

constexpr float plane_opacity = 0.3f;
constexpr float flat_shading = 0, interface_shading = 0.4f;  // so that sections have the colour of the legend

// Sides of a try or a cut that lines are drawn from.
std::vector<std::array<Vec3, 2>> ends_of(const std::vector<SurfaceEdge>& edges, const NodeSurface& surface) {
    std::vector<std::array<Vec3, 2>> ends;
    for (const SurfaceEdge& edge : edges)
        if (static_cast<std::size_t>(std::max(edge[0], edge[1])) < surface.vertices.size())
            ends.push_back({surface.vertices[static_cast<std::size_t>(edge[0])],
                            surface.vertices[static_cast<std::size_t>(edge[1])]});
    return ends;
}

std::vector<std::array<Vec3, 2>> loops_of(const Cut& cut, const NodeSurface& surface, bool projected) {
    std::vector<std::array<Vec3, 2>> ends;
    const auto place = [&](std::int32_t v) -> Vec3 {
        const Vec3& p = surface.vertices[static_cast<std::size_t>(v)];
        return projected ? cut.plane.lift(cut.plane.project(p), 0) : p;
    };
    for (const std::vector<std::int32_t>& loop : cut.loops)
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

// Of what the scene shows at the stage and not before.
Color SceneBuild::color_of(Stage stage) const {
    if (stage == Stage::plane) return colors_.plane;
    if (stage < Stage::contour) return colors_.crossed;
    if (stage == Stage::contour) return colors_.contour;
    return stage == Stage::projected ? colors_.projected : colors_.interface;
}

// Along each axis twice the standard deviation of the vertices.
void SceneBuild::add_axes(const TreeRow& row) {
    if (!state_.axes || row.regions > 1) return;
    built_.pending |= !row.centroid;
    if (!row.centroid || row.vertices <= 0) return;
    const double half_trace = row.eigenvalues.sum() / 2;
    std::vector<std::array<Vec3, 2>> ends;
    for (int k = 0; k < 3; ++k) {
        const double variance = (half_trace - row.eigenvalues[k]) / static_cast<double>(row.vertices);
        const Vec3 reach = 2 * std::sqrt(std::max(variance, 0.0)) * row.axes.col(k);
        ends.push_back({*row.centroid - reach, *row.centroid + reach});
    }
    Layer& layer = add_lines(LayerKind::axes, ends, colors_.axes[0], contour_pixels);
    const Range all = layer.ranges.front();
    layer.ranges.clear();
    for (std::uint32_t k = 0; k < 3; ++k) {
        Range range = all;
        range.first = k;
        range.count = 1;
        range.color = colors_.axes[k];
        layer.ranges.push_back(range);
    }
    add_points(LayerKind::centre, {*row.centroid}, colors_.contour, 11);
}

void SceneBuild::add_plane(const Plane& plane) {
    if (!state_.plane) return;
    const auto surface = session_.surface(state_.node);
    const Eigen::AlignedBox3d box = surface ? box_of(surface->vertices) : document_.box;
    // Where the section lies in the plane, its own colour is what is to be seen.
    if (step_.stage < Stage::triangulation) {
        Layer& sheet = add(LayerKind::plane, plane_rectangle(plane, box, built_.frame), colors_.plane);
        sheet.opacity = plane_opacity;
        sheet.clipped = sheet.edges = sheet.smooth = false;
        sheet.two_sided = true;
    }
    Layer& outline = add(LayerKind::plane_outline, plane_outline(plane, box, built_.frame), colors_.normal);
    outline.pixels = thin_pixels;
    outline.clipped = false;
    extend(box);
}

void SceneBuild::add_try(const CutTry& attempt, const NodeSurface& surface) {
    add_plane(attempt.plane);
    if (state_.contour && !attempt.contour.empty())
        add_lines(LayerKind::refused, ends_of(attempt.contour, surface), colors_.refused, contour_pixels);
    if (!attempt.places.empty()) add_points(LayerKind::places, attempt.places, colors_.error, place_pixels);
    add_collisions(attempt);
}

// Pairs of triangles of which one goes through the other.
void SceneBuild::add_collisions(const CutTry& attempt) {
    if (attempt.collisions.empty() || !state_.interfaces) return;
    const auto add_side = [&](LayerKind kind, std::array<Vec3, 3> Collision::*side, const Color& color) {
        std::vector<Vec3> corners;
        std::vector<Triangle> sides;
        for (const Collision& pair : attempt.collisions) {
            const auto first = static_cast<std::int32_t>(corners.size());
            corners.insert(corners.end(), (pair.*side).begin(), (pair.*side).end());
            sides.push_back({first, first + 1, first + 2});
        }
        Layer& layer = add(kind, triangles(corners, sides, built_.frame), color);
        layer.two_sided = layer.edges = true;
        layer.smooth = false;
    };
    add_side(LayerKind::colliding, &Collision::first, colors_.colliding);
    add_side(LayerKind::collided, &Collision::second, colors_.collided);
}

Layer* SceneBuild::add_contour(const Cut& cut, const NodeSurface& surface) {
    if (!state_.contour) return nullptr;
    return &add_lines(LayerKind::contour, loops_of(cut, surface, false), colors_.contour, contour_pixels);
}

// The stages from the crossed edges to the interface.
void SceneBuild::add_stage(const Cut& cut, const NodeSurface& surface) {
    if (const std::vector<SurfaceEdge>* edges = edges_of(cut, step_.stage)) {
        if (state_.contour)
            add_lines(layer_of(step_.stage), ends_of(*edges, surface), color_of(step_.stage),
                      step_.stage == Stage::crossed_edges ? 2.f : contour_pixels);
        return;
    }
    if (step_.stage < Stage::contour) return;
    if (step_.stage != Stage::triangulation) add_contour(cut, surface);
    if (state_.contour && (step_.stage == Stage::projected || step_.stage == Stage::triangulation))
        add_lines(LayerKind::projected, loops_of(cut, surface, true), colors_.projected, contour_pixels);
    if (!state_.interfaces) return;
    if (step_.stage == Stage::triangulation) {
        std::vector<Vec3> places;
        for (const Vec2& q : cut.interface.planar) places.push_back(cut.plane.lift(q, 0));
        Layer& layer =
            add(LayerKind::triangulation, triangles(places, cut.interface.triangles, built_.frame), colors_.interface);
        layer.two_sided = true;
        layer.shading = flat_shading;
        layer.smooth = false;
    }
    if (step_.stage == Stage::interface) {
        Layer& layer = add(LayerKind::interface, triangles(cut.interface.points, cut.interface.triangles, built_.frame),
                           colors_.interface);
        layer.two_sided = true;
        layer.shading = interface_shading;
        layer.smooth = false;
    }
}

// Both halves take the contour along.
void SceneBuild::add_halves(const NodeSurface* parent) {
    const Cut* cut = document_.trace ? document_.trace->find(state_.node) : nullptr;
    Layer* contour = cut && parent ? add_contour(*cut, *parent) : nullptr;
    std::vector<Range> contours;
    for (const NodeId half : {2 * state_.node, 2 * state_.node + 1}) {
        if (!is_shown(half)) continue;
        if (contour) {
            contours.push_back(contour->ranges.front());
            contours.back().owner = half;
            contours.back().offset = move_of(offset_of(half, state_.node));
        }
    }
    if (contour) contour->ranges = contours;
    for (const NodeId half : {2 * state_.node, 2 * state_.node + 1}) {
        if (!is_shown(half)) continue;
        const auto surface = session_.surface(half);
        built_.pending |= !surface;
        const Color color = half_color(half);
        const Vec3 offset = offset_of(half, state_.node);
        if (surface && add_surface(LayerKind::half, surface, half, color, colors_.interface, offset))
            add_features(surface, half, offset);
    }
}

}  // namespace kerf::view

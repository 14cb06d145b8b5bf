// The tetrahedra: boundaries of parts as long as these are all one sees, cells where one looks into them.
#include "viewer/scene/scene_build.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace kerf::view {

void SceneBuild::add_parts() {
    for (const NodeId part : document_.tree.parts_below(state_.node)) {
        const TreeRow* row = document_.tree.find(part);
        if (is_shown(part) && row->state == NodeState::done) add_part(part);
    }
}

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
    for (std::size_t v = 0; v < vertices.size(); ++v)
        places.emplace_back(vertices[v] + state_.deform * solution->displacement[v]);
    return places;
}

// Empty where the colour is none of them.
std::vector<float> SceneBuild::values_at_vertices(std::size_t count, const PartSolution* solution) const {
    std::vector<float> values;
    if (!solution || !is_at_vertices(state_.color)) return values;
    for (std::size_t v = 0; v < count; ++v) values.push_back(solution->value_at(state_.color, v));
    return values;
}

void SceneBuild::add_part(NodeId part) {
    const auto surface = session_.part_surface(part);
    if (!surface) {
        built_.pending = true;
        return;
    }
    const Vec3 offset = offset_of(part, state_.node);
    const auto solution = solution_of(part);
    const std::vector<Vec3> moved = moved_places(surface->vertices, solution.get());
    const Eigen::AlignedBox3d box = box_of(moved.empty() ? surface->vertices : moved);
    bool by_cells = state_.shrink > 0 || (state_.filter && is_measure(state_.color));
    if (side_) {
        const double middle = side_->distance(box.center());
        const double half = side_->normal.cwiseAbs().dot(box.sizes()) / 2;
        if (middle - half > 0 || (state_.clip.style == ClipStyle::layer && middle + half < 0)) return;
        by_cells |= middle + half > 0;
    }
    extend(box, offset);
    if (by_cells && add_cells(part, *surface, offset)) return;
    if (by_cells) built_.pending = true;

    std::shared_ptr<const std::vector<float>> values;
    if (needs_values()) {
        values = session_.facet_values(part, state_.color);
        built_.pending |= !values;
    }
    FacetChoice choice;
    choice.smooth = state_.shading == Shading::smooth;
    const std::vector<float> patches = patch_values(*surface);
    const auto on_surface = values_on(surface);
    color_facets(*surface, on_surface.get(), patches, choice);
    if (values) choice.value = *values;
    const std::vector<float> at_vertices = values_at_vertices(surface->vertices.size(), solution.get());
    const bool shows_error = solution && state_.color == ColorBy::error;
    if (!at_vertices.empty()) choice.vertex_value = at_vertices;
    if (shows_error) choice.value = solution->error_at_facet;
    choice.places = moved;
    const std::shared_ptr<const void> source = solution     ? std::shared_ptr<const void>(solution)
                                               : values     ? std::shared_ptr<const void>(values)
                                               : on_surface ? std::shared_ptr<const void>(on_surface)
                                                            : surface;
    const bool is_colored = values || on_surface || !patches.empty() || !at_vertices.empty() || shows_error;
    const std::string key =
        fmt::format("part {} {} {}{}", part, shading_key(), is_colored ? name(state_.color) : "plain", solution_key());
    const auto geometry = cache_.get(key, source, [&] { return facet_triangles(*surface, built_.frame, choice); });
    Layer& layer = add(fmt::format("part {}", part), geometry, color_of(part), part, offset);
    layer.closed = true;
    if (values) layer.fill = fill_of_values();
    if (on_surface || shows_error || !at_vertices.empty()) layer.fill = Fill::scale;
    if (!patches.empty()) layer.fill = Fill::categories;
}

// Interfaces of a part, which come last, are seen only where parts are apart.
std::size_t SceneBuild::triangles_seen(const Layer& layer) const {
    const auto surface = session_.part_surface(layer.ranges.front().owner);
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
    for (const Layer& layer : built_.scene.layers) {
        if (layer.fill != Fill::scale) continue;
        Layer line;
        line.name = "isolines of " + layer.name;
        line.geometry = cache_.get(fmt::format("{} {} {} {}", line.name, low, high, state_.explode > 0), layer.geometry,
                                   [&] { return isolines(*layer.geometry, triangles_seen(layer), levels); });
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

// Faces of chosen cells, and their sections; false if the cells are not there yet.
bool SceneBuild::add_cells(NodeId part, const NodeSurface& surface, const Vec3& offset) {
    const auto cells = session_.cells(part);
    std::shared_ptr<const std::vector<float>> values;
    if (needs_values()) values = session_.cell_values(part, state_.color);
    const auto solution = solution_of(part);
    if (!cells || (needs_values() && !values) || (needs_solution() && !solution)) return false;
    CellChoice choice;
    if (values) choice.value = *values;
    const std::vector<Vec3> moved = moved_places(cells->vertices, solution.get());
    const std::vector<float> at_vertices = values_at_vertices(cells->vertices.size(), solution.get());
    const bool shows_error = solution && state_.color == ColorBy::error;
    choice.places = moved;
    choice.vertex_value = at_vertices;
    if (shows_error) choice.value = solution->error_of_tet;
    if (is_measure(state_.color)) choice.filter = state_.filter;
    choice.side = side_ ? &*side_ : nullptr;
    choice.style = state_.clip.style;
    choice.shrink = state_.shrink;
    const std::vector<float> patches = patch_values(surface);
    std::vector<std::array<float, 4>> of_faces;
    const std::string key = fmt::format("{} {}", value_key(), clip_key());
    const std::shared_ptr<const void> source = solution ? std::shared_ptr<const void>(solution)
                                               : values ? std::shared_ptr<const void>(values)
                                                        : cells;
    const auto finish = [&](Layer& layer) {
        layer.smooth = false;
        layer.fill = needs_values() ? fill_of_values() : patches.empty() ? Fill::plain : Fill::categories;
        if (shows_error || !at_vertices.empty()) layer.fill = Fill::scale;
    };
    auto faces = cache_.get(fmt::format("cells {} {}", part, key), source, [&] {
        if (!patches.empty()) choice.face_value = of_faces = face_values(*cells, surface, patches);
        return cell_faces(*cells, built_.frame, choice);
    });
    if (!faces->corners.empty()) {
        Layer& layer = add(fmt::format("cells {}", part), faces, color_of(part), part, offset);
        finish(layer);
        layer.clipped = side_ && state_.clip.style == ClipStyle::smooth;
    }
    if (!side_ || state_.clip.style != ClipStyle::smooth) return true;
    auto sections = cache_.get(fmt::format("section {} {}", part, key), source,
                               [&] { return cell_sections(*cells, built_.frame, choice); });
    if (!sections->corners.empty()) {
        Layer& layer = add(fmt::format("section {}", part), sections, color_of(part), part, offset);
        finish(layer);
        if (!patches.empty()) layer.fill = Fill::plain;
        layer.clipped = false;
    }
    return true;
}

}  // namespace kerf::view

// The tetrahedra: boundaries of parts as long as these are all one sees, cells where one looks into them.
#include "viewer/scene/scene_build.h"

#include <cmath>

namespace kerf::view {

void SceneBuild::add_parts() {
    for (const NodeId part : document_.tree.parts_below(state_.node)) {
        const TreeRow* row = document_.tree.find(part);
        if (is_shown(part) && row->state == NodeState::done) add_part(part);
    }
}

void SceneBuild::add_part(NodeId part) {
    const auto surface = session_.part_surface(part);
    if (!surface) {
        built_.pending = true;
        return;
    }
    const Vec3 offset = offset_of(part, state_.node);
    const Eigen::AlignedBox3d box = box_of(surface->vertices);
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
    const std::shared_ptr<const void> source = values       ? std::shared_ptr<const void>(values)
                                               : on_surface ? std::shared_ptr<const void>(on_surface)
                                                            : surface;
    const bool is_colored = values || on_surface || !patches.empty();
    const std::string key =
        fmt::format("part {} {} {}", part, shading_key(), is_colored ? name(state_.color) : "plain");
    const auto geometry = cache_.get(key, source, [&] { return facet_triangles(*surface, built_.frame, choice); });
    Layer& layer = add(fmt::format("part {}", part), geometry, color_of(part), part, offset);
    layer.closed = true;
    if (values) layer.fill = fill_of_values();
    if (on_surface) layer.fill = Fill::scale;
    if (!patches.empty()) layer.fill = Fill::categories;
}

// Faces of chosen cells, and their sections; false if the cells are not there yet.
bool SceneBuild::add_cells(NodeId part, const NodeSurface& surface, const Vec3& offset) {
    const auto cells = session_.cells(part);
    std::shared_ptr<const std::vector<float>> values;
    if (needs_values()) values = session_.cell_values(part, state_.color);
    if (!cells || (needs_values() && !values)) return false;
    CellChoice choice;
    if (values) choice.value = *values;
    if (is_measure(state_.color)) choice.filter = state_.filter;
    choice.side = side_ ? &*side_ : nullptr;
    choice.style = state_.clip.style;
    choice.shrink = state_.shrink;
    const std::vector<float> patches = patch_values(surface);
    std::vector<std::array<float, 4>> of_faces;
    const std::string key = fmt::format("{} {}", value_key(), clip_key());
    const std::shared_ptr<const void> source = values ? std::shared_ptr<const void>(values) : cells;
    const auto finish = [&](Layer& layer) {
        layer.smooth = false;
        layer.fill = needs_values() ? fill_of_values() : patches.empty() ? Fill::plain : Fill::categories;
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

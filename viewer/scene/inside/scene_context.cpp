// The context is computed once for a scene: the step nearest to the wanted one that the node has, the frame, the shown
// side of the clip plane, the palette. A palette of the file's colours has each colour once, and maps patches to these;
// else patches have the colours of category_color() by number. Offsets of parts add up moves of regions, where the node
// has several, and those of cuts. The keys at the end are parts of the names of cached geometry: all members of the
// view that change a geometry must be in one of them, as a picture would show an old one otherwise. The deformation at
// a phase is in solution_key(), so that each step of a motion is made once.
#include "viewer/scene/inside/scene_context.h"

#include <cmath>

#include "base/core/ids.h"
#include "viewer/model/surface_values.h"

namespace kerf::view {

SceneContext::SceneContext(const ViewState& shown, Session& source, GeometryCache& geometry)
    : state(shown),
      session(source),
      document(source.document()),
      cache(geometry),
      colors(scene_colors(shown.theme)),
      frame(Frame::around(document.box)) {
    const std::vector<Step> steps = steps_of(document, state.node);
    step = steps[nearest_step(steps, state.step)];
    for (const NodeId part : document.tree.parts_below(root_node)) part_order_.emplace(part, part_order_.size());
    if (state.clip.on && !document.box.isEmpty()) side = shown_side(state.clip, document.box);
    if (state.explosion.amount > 0) moves_of_regions_ = moves_apart(document.region_places);
    if (has_patch_colors())
        set_patch_palette();
    else
        for (std::size_t i = 0; i < category_count; ++i) palette.push_back(category_color(i));
}

// Many patches share few colours.
void SceneContext::set_patch_palette() {
    std::map<std::array<std::uint8_t, 4>, float> places;
    for (std::size_t i = 0; i < document.patch_colours.size(); ++i) {
        const auto [place, is_new] = places.emplace(document.patch_colours[i], palette.size());
        if (is_new) palette.push_back(patch_color(i));
        palette_of_patch.push_back(place->second);
    }
}

bool SceneContext::has_patch_colors() const {
    return state.coloring.by == ColorBy::patch && !document.patch_colours.empty() &&
           document.patch_colours.size() == document.patch_names.size();
}

bool SceneContext::shows_values() const {
    const bool is_of_cells = is_measure(state.coloring.by) || (is_of_solution(state.coloring.by) && document.solution);
    return is_of_surface(state.coloring.by) || (is_of_cells && step.stage == Stage::tetrahedra);
}

bool SceneContext::needs_solution() const {
    return document.solution &&
           (is_of_solution(state.coloring.by) || state.deformation.factor != 0 || state.deformation.vectors);
}

// Regions move as wholes; their parts from there, unless only regions are wanted to move.
Vec3 SceneContext::offset_of(NodeId part) const {
    const auto region_number = [&](NodeId node) {
        const TreeRow* row = document.tree.find(node);
        return row ? row->region : RegionIndex::none();
    };
    const Vec3 of_cuts =
        explosion_offset(document.tree, part, state.node, state.explosion.amount, document.box.diagonal().norm());
    const RegionIndex region = region_number(part);
    const bool has_several = !region_number(state.node).is_valid();
    if (!region.is_valid() || !has_several || region >= RegionIndex(moves_of_regions_.size())) return of_cuts;
    const Vec3 of_region = state.explosion.amount * moves_of_regions_[region];
    return state.explosion.regions ? of_region : Vec3(of_region + of_cuts);
}

Color SceneContext::color_of(NodeId part) const {
    const TreeRow* row = document.tree.find(part);
    switch (state.coloring.by) {
        case ColorBy::rank:
            return row && row->rank >= 0 ? category_color(row->rank) : colors.none;
        case ColorBy::region:
            return row && row->region.is_valid() ? category_color(row->region.value()) : colors.none;
        case ColorBy::level:
            return category_color(level_of(part));
        case ColorBy::part: {
            const auto order = part_order_.find(part);
            return category_color(order == part_order_.end() ? part.value() : order->second);
        }
        default:
            return colors.none;
    }
}

Color SceneContext::patch_color(std::size_t patch) const {
    if (!has_patch_colors()) return category_color(patch);
    const auto& [r, g, b, a] = document.patch_colours[patch];
    if (a == 0) return colors.surface;
    return {r / 255.f, g / 255.f, b / 255.f, 1};
}

std::vector<float> SceneContext::patch_values(const NodeSurface& surface) const {
    std::vector<float> values;
    if (state.coloring.by != ColorBy::patch) return values;
    for (const std::int32_t patch : surface.patch) {
        if (patch < 0)
            values.push_back(std::nanf(""));
        else
            values.push_back(patch < count_of(palette_of_patch) ? palette_of_patch[patch] : patch);
    }
    return values;
}

std::shared_ptr<const Geometry> SceneContext::feature_lines(const std::shared_ptr<const NodeSurface>& surface,
                                                            NodeId owner) const {
    return cache.get(fmt::format("features of {}", owner.value()), surface,
                     [&] { return segments(feature_edges(*surface), frame); });
}

std::string SceneContext::clip_key(double shrink) const {
    std::string key = fmt::format("shrink {}", shrink);
    if (side)
        key += fmt::format(" {} {} {} {} {}", name(state.clip.style), side->normal.x(), side->normal.y(),
                           side->normal.z(), side->offset);
    if (ring) key += fmt::format(" around {}", fmt::join(*ring, " "));
    if (has_filter()) key += fmt::format(" filter {} {}", state.coloring.filter->low, state.coloring.filter->high);
    return key;
}

std::string SceneContext::solution_key() const {
    return needs_solution() ? fmt::format(" case {} deform {}", state.deformation.load_case, state.deformation.drawn())
                            : "";
}

std::string SceneContext::value_key() const {
    const bool is_plain = !needs_values() && !is_of_solution(state.coloring.by) && state.coloring.by != ColorBy::patch;
    return (is_plain ? "plain" : name(state.coloring.by)) + solution_key();
}

}  // namespace kerf::view

// Of bodies of several regions: walls alone, regions of glass, and regions pulled apart.
#include "viewer/scene/scene_build.h"

#include <utility>

namespace kerf::view {

namespace {

constexpr float glass_front_share = 0.4f;

}  // namespace

void SceneBuild::make_glass(Layer& layer) const {
    layer.opacity = context_opacity;
    layer.front_share = glass_front_share;
    layer.edges = false;
    layer.two_sided = true;
}

// The neighbour is drawn, too, where it touches the part.
bool SceneBuild::is_met(NodeId part, NodeId neighbour) const {
    if (!lies_below(neighbour, state_.node) || !is_shown(neighbour)) return false;
    const TreeRow* row = document_.tree.find(neighbour);
    const bool is_there = step_.stage == Stage::parts || (row && row->state == NodeState::done);
    return is_there && offset_of(part, state_.node) == offset_of(neighbour, state_.node);
}

// Of two facets in one place one is drawn: the opaque one, or that of the smaller number. Cuts within glass are none.
SceneBuild::PartFacets SceneBuild::chosen_facets(NodeId part, const NodeSurface& surface) const {
    PartFacets chosen;
    const std::string* region = shows_parts() ? region_of(document_, part) : nullptr;
    chosen.all = !region || surface.neighbour.empty() || !(state_.walls || is_glass(state_, document_, part));
    if (chosen.all) return chosen;
    chosen.outer = !state_.walls;
    const auto order = [&](NodeId one) {
        return std::pair(is_glass(state_, document_, one), document_.tree.find(one)->region);
    };
    std::set<NodeId> neighbours(surface.neighbour.begin(), surface.neighbour.end());
    neighbours.erase(-1);
    for (const NodeId neighbour : neighbours) {
        const std::string* beyond = region_of(document_, neighbour);
        const bool is_wall = beyond && beyond != region;
        if (is_wall ? is_met(part, neighbour) && order(neighbour) < order(part)
                    : state_.walls || is_met(part, neighbour))
            chosen.left_out.insert(neighbour);
    }
    return chosen;
}

// Regions move as wholes; their parts from there, unless only regions are wanted to move.
Vec3 SceneBuild::offset_of(NodeId part, NodeId root) const {
    const auto region_number = [&](NodeId node) {
        const TreeRow* row = document_.tree.find(node);
        return row ? row->region : -1;
    };
    const Vec3 of_cuts = explosion_offset(document_.tree, part, root, state_.explode, document_.box.diagonal().norm());
    const std::int32_t region = region_number(part);
    const bool has_several = region_number(root) < 0;
    if (region < 0 || !has_several || region >= std::ssize(moves_of_regions_)) return of_cuts;
    const Vec3 of_region = state_.explode * moves_of_regions_[static_cast<std::size_t>(region)];
    return state_.explode_regions ? of_region : Vec3(of_region + of_cuts);
}

// Of glass, with its opacity.
Color SceneBuild::drawn_color_of(NodeId part) const {
    Color color = color_of(part);
    if (is_glass(state_, document_, part)) color.a = context_opacity;
    return color;
}

void SceneBuild::explain_regions() {
    std::map<std::int32_t, NodeId> part_of_region;
    for (const NodeId part : drawn_parts())
        if (const std::int32_t region = document_.tree.find(part)->region; region >= 0)
            part_of_region.emplace(region, part);
    for (const auto& [region, part] : part_of_region) {
        const std::string* name = region_of(document_, part);
        const std::string text = name ? *name : fmt::format("region {}", region);
        explain(state_.walls ? "walls of " + text : text, drawn_color_of(part));
    }
}

}  // namespace kerf::view

// The legend explains the layers of a finished scene, so that it names no colour that is not to be seen: a kind of
// layer is looked for and explained if it is there with a plain fill. Categories are collected from the corners of
// triangles, but patches from the numbers of layers (Layer::patch), because several patches may share a colour. The
// order of explanations is fixed in run(): the colouring first, then halves, axes, the stages of a cut, interfaces,
// features, the failures of a try, defects. Colours of glass are explained with their opacity.
#include "viewer/scene/inside/legend.h"

#include <algorithm>
#include <cmath>

#include "base/core/words.h"
#include "viewer/scene/inside/cut_layers.h"

namespace kerf::view {

// The colour of a part; of glass it has its opacity.
Color LegendMaker::drawn_color_of(NodeId part) const {
    Color color = context_.color_of(part);
    if (is_glass(context_.state, context_.document, part)) color.a = context_opacity;
    return color;
}

// The title of values; for a solution with its case and deformation.
std::string LegendMaker::title_of_values() const {
    std::string text = title(context_.state.coloring.by);
    if (!context_.needs_solution()) return text;
    const auto& cases = context_.document.solution->cases;
    const std::size_t number = context_.state.deformation.load_case;
    if (cases.size() > 1 && number < cases.size()) text += fmt::format(", case {}", cases[number].name);
    if (context_.state.deformation.factor != 0)
        text += fmt::format(", deformed {:g} x", context_.state.deformation.factor);
    return text;
}

// Whole numbers that stand for colours; NaN, where something has none, is -1.
std::set<int> LegendMaker::drawn_categories() const {
    std::set<int> drawn;
    for (const Layer& layer : scene_.layers) {
        if (layer.fill != Fill::categories) continue;
        for (const Range& range : layer.ranges)
            for (std::size_t i = 3 * std::size_t{range.first}; i < 3 * (std::size_t{range.first} + range.count);
                 i += 3) {
                const float value = layer.geometry->corners[i].value;
                drawn.insert(std::isnan(value) ? -1 : static_cast<int>(std::lround(value)));
            }
    }
    return drawn;
}

void LegendMaker::explain(const std::string& text, const Color& color, LegendEntry::Mark mark) {
    legend_.categories.push_back({text, color, mark});
}

// Explains a layer, if there is one; glass is explained as glass.
void LegendMaker::explain_layer(const Layer* layer, const std::string& text, const Color& color) {
    if (!layer || layer->fill != Fill::plain) return;
    Color drawn = color;
    drawn.a = layer->opacity;
    const Geometry& geometry = *layer->geometry;
    explain(text, drawn,
            !geometry.segments.empty() ? LegendEntry::Mark::line
            : !geometry.points.empty() ? LegendEntry::Mark::point
                                       : LegendEntry::Mark::area);
}

void LegendMaker::explain_origins() {
    bool has_core = false;
    std::set<std::string> others;
    for (const NodeId part : drawn_parts_) {
        const TreeRow* row = context_.document.tree.find(part);
        if (row->core_tets > 0)
            has_core = true;
        else
            others.insert(row->filled_by.empty() ? "mesher not known" : row->filled_by);
    }
    const auto color = [](CellOrigin origin) { return category_color(static_cast<std::size_t>(origin)); };
    if (has_core) {
        explain("core: stamped cells", color(CellOrigin::core));
        explain("shell around the core", color(CellOrigin::shell));
    }
    for (const std::string& filler : others) explain(filler, color(CellOrigin::other));
}

// Several patches may have one colour.
std::set<std::int32_t> LegendMaker::drawn_patches() const {
    std::set<std::int32_t> drawn;
    for (const Layer& layer : scene_.layers)
        if (layer.patch && layer.fill == Fill::categories)
            for (const Range& range : layer.ranges)
                for (std::size_t i = range.first; i < std::size_t{range.first} + range.count; ++i)
                    drawn.insert((*layer.patch)[i]);
    return drawn;
}

void LegendMaker::explain_patches() {
    const std::set<std::int32_t> drawn = drawn_patches();
    for (std::int32_t i = 0; i < std::ssize(context_.document.patch_names); ++i) {
        if (!drawn.contains(i)) continue;
        const std::string& name = context_.document.patch_names[i];
        explain(context_.state.look.numbers ? fmt::format("{}: {}", patch_number(i), name) : name,
                context_.patch_color(i));
    }
    if (drawn.contains(-1))
        explain(context_.step.stage == Stage::tetrahedra ? "interface or inside" : "interface", context_.colors.none);
}

void LegendMaker::explain_regions() {
    std::map<RegionIndex, NodeId> part_of_region;
    for (const NodeId part : drawn_parts_)
        if (const RegionIndex region = context_.document.tree.find(part)->region; region.is_valid())
            part_of_region.emplace(region, part);
    for (const auto& [region, part] : part_of_region) {
        const std::string* name = region_of(context_.document, part);
        const std::string text = name ? *name : fmt::format("region {}", region.value() + 1);
        explain(context_.state.visibility.walls ? "walls of " + text : text, drawn_color_of(part));
    }
}

void LegendMaker::explain_parts() {
    std::set<std::int32_t> seen;
    for (const NodeId part : drawn_parts_) {
        const TreeRow& row = *context_.document.tree.find(part);
        const std::int32_t value = context_.state.coloring.by == ColorBy::rank ? row.rank : level_of(part);
        if (context_.state.coloring.by == ColorBy::part)
            explain(fmt::format("part {}", part.value()), drawn_color_of(part));
        else if (value >= 0 && seen.insert(value).second)
            explain(fmt::format("{} {}", name(context_.state.coloring.by), value), drawn_color_of(part));
    }
}

// Explains the colours of cells and facets where they stand for few things.
void LegendMaker::explain_coloring() {
    if (context_.state.coloring.by == ColorBy::patch) return explain_patches();
    if (!context_.shows_parts() || context_.shows_values()) return;
    if (is_kind(context_.state.coloring.by) && context_.step.stage == Stage::parts) return;  // cells have it
    if (context_.state.coloring.by == ColorBy::kind) {
        const std::set<int> drawn = drawn_categories();
        if (drawn.contains(0)) explain("inner cells", category_color(0));
        if (drawn.contains(1)) explain("cells at an interface", category_color(1));
    } else if (context_.state.coloring.by == ColorBy::origin) {
        explain_origins();
    } else if (context_.state.coloring.by == ColorBy::region) {
        explain_regions();
    } else {
        explain_parts();
    }
}

void LegendMaker::explain_axes() {
    if (!scene_.find(LayerKind::axes)) return;
    constexpr std::array<const char*, 3> names = {"long axis", "middle axis", "short axis"};
    for (std::size_t k = 0; k < names.size(); ++k) explain(names[k], context_.colors.axes[k], LegendEntry::Mark::line);
    explain_kind(LayerKind::centre, "centre of gravity", context_.colors.contour);
}

// Explains interfaces in the surfaces of nodes, made by earlier cuts or by this one.
void LegendMaker::explain_interfaces() {
    const bool is_split = context_.step.stage == Stage::split;
    if (is_split && context_.state.node == root_node && context_.state.explosion.amount == 0 && !context_.side &&
        context_.state.visibility.hidden.empty())
        return;  // inside
    if (scene_.find(LayerKind::triangulation) || scene_.find(LayerKind::interface)) return;
    for (const Layer& layer : scene_.layers)
        for (const Range& range : layer.ranges)
            if (layer.fill == Fill::plain && range.color == context_.colors.interface)
                return explain_layer(&layer, is_split ? "interfaces" : "earlier interfaces", range.color);
}

void LegendMaker::run() {
    if (context_.shows_parts() || context_.state.coloring.by == ColorBy::patch || legend_.values)
        legend_.title = title_of_values();
    explain_coloring();
    for (const NodeId half : halves_of(context_.state.node))
        explain_layer(scene_.find(LayerKind::half, half), fmt::format("node {}", half.value()), half_color(half));
    explain_axes();
    for (int i = static_cast<int>(Stage::plane); i <= static_cast<int>(Stage::interface); ++i) {
        const auto stage = static_cast<Stage>(i);
        explain_kind(layer_of(stage), in_words(name(stage)), color_of(stage, context_.colors));
    }
    explain_interfaces();
    if (context_.step.stage < Stage::split) explain_kind(LayerKind::features, "features", context_.colors.feature);
    explain_kind(LayerKind::refused, "refused contour", context_.colors.refused);
    explain_kind(LayerKind::places, "where it failed", context_.colors.error);
    explain_kind(LayerKind::colliding, "interface that collides", context_.colors.colliding);
    explain_kind(LayerKind::collided, "what it collides with", context_.colors.collided);
    explain_kind(LayerKind::defect_places, "errors", context_.colors.error);
    explain_kind(LayerKind::warning_places, "warnings", context_.colors.warning);
}

}  // namespace kerf::view

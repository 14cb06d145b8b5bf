// What colours mean in a scene.
#include "viewer/scene/scene_build.h"

#include <cmath>
#include <limits>
#include <set>

#include "core/words.h"

namespace kerf::view {

namespace {

constexpr double rounding_share = 1e-9;  // of the diagonal: what deviates less is not to look as if it did

}  // namespace

Color SceneBuild::color_of(NodeId part) const {
    const TreeRow* row = document_.tree.find(part);
    switch (state_.color) {
        case ColorBy::rank:
            return row && row->rank >= 0 ? category_color(static_cast<std::size_t>(row->rank)) : colors_.none;
        case ColorBy::level:
            return category_color(static_cast<std::size_t>(level_of(part)));
        case ColorBy::part: {
            const auto order = part_order_.find(part);
            return category_color(order == part_order_.end() ? static_cast<std::size_t>(part) : order->second);
        }
        default:
            return colors_.none;
    }
}

Color SceneBuild::patch_color(std::size_t patch) const {
    if (!has_patch_colors()) return category_color(patch);
    const auto& [r, g, b, a] = document_.patch_colours[patch];
    if (a == 0) return colors_.surface;
    return {static_cast<float>(r) / 255, static_cast<float>(g) / 255, static_cast<float>(b) / 255, 1};
}

// Many patches share few colours.
void SceneBuild::set_patch_palette() {
    std::vector<Color>& palette = built_.scene.palette;
    palette.clear();
    std::map<std::array<std::uint8_t, 4>, float> places;
    for (std::size_t i = 0; i < document_.patch_colours.size(); ++i) {
        const auto [place, is_new] = places.emplace(document_.patch_colours[i], static_cast<float>(palette.size()));
        if (is_new) palette.push_back(patch_color(i));
        palette_of_patch_.push_back(place->second);
    }
}

void SceneBuild::set_colors() {
    Scene& scene = built_.scene;
    scene.background_top = colors_.background_top;
    scene.background_bottom = colors_.background_bottom;
    scene.edge = colors_.edge;
    scene.scale.none = colors_.none;
    for (std::size_t i = 0; i < category_count; ++i) scene.palette.push_back(category_color(i));
    if (has_patch_colors()) set_patch_palette();
    if (!is_measure(state_.color) && !is_of_surface(state_.color) && !is_of_solution(state_.color)) return;
    scene.scale.colors = value_colors(state_.color);
    std::optional<ValueRange> range = state_.color_range ? state_.color_range : natural_range(state_.color);
    const bool is_volume = state_.color == ColorBy::volume;
    const auto& histogram = document_.histograms[is_volume ? 5 : 7];
    // Few cells are far larger than the others: their colour is that of the upper end.
    if (!range && is_measure(state_.color) && histogram)
        range = ValueRange{histogram->min, std::min(histogram->max, (is_volume ? 4 : 2) * histogram->median)};
    if (!range) return;  // follows from what is drawn
    set_range(*range);
}

void SceneBuild::set_range(const ValueRange& range) {
    built_.scene.scale.low = static_cast<float>(range.low);
    built_.scene.scale.high = static_cast<float>(range.high);
    if (!shows_values()) return;
    built_.legend.values = range;
    built_.legend.scale = built_.scene.scale.colors;
}

// Of a run under way nobody knows the distribution of the values yet, of surfaces nobody ever does.
void SceneBuild::set_range_of_values() {
    if (!shows_values() || built_.legend.values) return;
    ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const Layer& layer : built_.scene.layers) {
        if (layer.fill != Fill::scale) continue;
        for (const Corner& corner : layer.geometry->corners) {
            if (!std::isfinite(corner.value)) continue;
            range.low = std::min(range.low, double{corner.value});
            range.high = std::max(range.high, double{corner.value});
        }
    }
    if (state_.color == ColorBy::deviation && range.high >= 0)
        range = {0, std::max(range.high, rounding_share * document_.box.diagonal().norm())};
    if (range.low == range.high) range = {0, range.high > 0 ? 2 * range.high : 1};  // the same everywhere
    if (range.low < range.high) set_range(range);
}

// Only what there is.
void SceneBuild::set_legend_of_origins() {
    bool has_core = false;
    std::set<std::string> others;
    for (const NodeId part : document_.tree.parts_below(state_.node)) {
        const TreeRow* row = document_.tree.find(part);
        if (!is_shown(part) || row->state != NodeState::done) continue;
        if (row->core_tets > 0)
            has_core = true;
        else
            others.insert(row->filled_by.empty() ? "mesher not known" : row->filled_by);
    }
    const auto explain = [&](const std::string& text, CellOrigin origin) {
        built_.legend.categories.emplace_back(text, category_color(static_cast<std::size_t>(origin)));
    };
    if (has_core) {
        explain("core: stamped cells", CellOrigin::core);
        explain("shell around the core", CellOrigin::shell);
    }
    for (const std::string& filler : others) explain(filler, CellOrigin::other);
}

// With what else there is to know of a picture of a solution.
std::string SceneBuild::legend_title() const {
    std::string text = title(state_.color);
    if (!needs_solution()) return text;
    const auto& cases = document_.solution->cases;
    const auto number = static_cast<std::size_t>(state_.load_case);
    if (cases.size() > 1 && number < cases.size()) text += fmt::format(", case {}", cases[number].name);
    if (state_.deform != 0) text += fmt::format(", deformed {:g} x", state_.deform);
    return text;
}

void SceneBuild::set_legend() {
    auto& categories = built_.legend.categories;
    if (step_.stage == Stage::tetrahedra || state_.color == ColorBy::patch || built_.legend.values)
        built_.legend.title = legend_title();
    const Scene& scene = built_.scene;
    if (state_.color == ColorBy::patch) {
        for (std::size_t i = 0; i < document_.patch_names.size(); ++i)
            categories.emplace_back(document_.patch_names[i], patch_color(i));
        if (state_.node != 1 || step_.stage >= Stage::split)
            categories.emplace_back(step_.stage == Stage::tetrahedra ? "interface or inside" : "interface",
                                    colors_.none);
        return;
    }
    if (step_.stage == Stage::tetrahedra && state_.color == ColorBy::kind) {
        categories = {{"inner cells", category_color(0)}, {"cells at an interface", category_color(1)}};
        return;
    }
    if (step_.stage == Stage::tetrahedra && state_.color == ColorBy::origin) return set_legend_of_origins();
    if (step_.stage == Stage::tetrahedra && !shows_values()) {
        std::set<std::int32_t> seen;
        for (const NodeId part : document_.tree.parts_below(state_.node)) {
            if (!is_shown(part)) continue;
            const std::int32_t rank = document_.tree.find(part)->rank;
            if (state_.color == ColorBy::rank && rank < 0) continue;
            const std::int32_t value = state_.color == ColorBy::rank ? rank : level_of(part);
            if (state_.color == ColorBy::part)
                categories.emplace_back(fmt::format("part {}", part), color_of(part));
            else if (seen.insert(value).second)
                categories.emplace_back(fmt::format("{} {}", name(state_.color), value), color_of(part));
        }
        return;
    }
    if (built_.legend.values || (is_measure(state_.color) && step_.stage == Stage::tetrahedra)) return;
    const auto explain = [&](const char* layer, const std::string& text, const Color& color) {
        if (scene.find(layer)) categories.emplace_back(text, color);
    };
    explain("axes", "long axis", colors_.axes[0]);
    explain("axes", "middle axis", colors_.axes[1]);
    explain("axes", "short axis", colors_.axes[2]);
    for (int i = 0; i < stage_count; ++i)
        explain(name(static_cast<Stage>(i)), in_words(name(static_cast<Stage>(i))), color_of(static_cast<Stage>(i)));
    explain("features", "features", colors_.feature);
    explain("refused", "refused contour", colors_.refused);
    explain("places", "where it failed", colors_.error);
    explain("defect places", "errors", colors_.error);
    explain("warning places", "warnings", colors_.warning);
    for (const NodeId half : {2 * state_.node, 2 * state_.node + 1})
        if (scene.find(fmt::format("half {}", half)))
            categories.emplace_back(fmt::format("node {}", half), half_color(half));
}

}  // namespace kerf::view

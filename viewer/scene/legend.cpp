// What colours mean in a scene.
#include "viewer/scene/scene_build.h"

#include <algorithm>
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
        case ColorBy::region:
            return row && row->region >= 0 ? category_color(static_cast<std::size_t>(row->region)) : colors_.none;
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

// Corners with values, but for those that the clip plane hides: visit(value, layer, number of the corner).
template <class Visit>
void SceneBuild::for_drawn_values(Visit visit) const {
    const auto& [a, b, c, d] = built_.scene.clip.plane;
    for (const Layer& layer : built_.scene.layers) {
        if (layer.fill != Fill::scale) continue;
        const std::vector<Corner>& corners = layer.geometry->corners;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto& [x, y, z] = corners[i].position;
            const bool is_hidden = layer.clipped && a * x + b * y + c * z + d < 0;
            if (std::isfinite(corners[i].value) && !is_hidden) visit(double{corners[i].value}, layer, i);
        }
    }
}

// Of values of whole triangles, in the middle of one.
void SceneBuild::mark_extremes() {
    if (!state_.extremes || !shows_values()) return;
    struct Found {
        double value;
        const Layer* layer = nullptr;
        std::size_t corner = 0;
    };
    Found least{std::numeric_limits<double>::infinity()}, largest{-std::numeric_limits<double>::infinity()};
    for_drawn_values([&](double value, const Layer& layer, std::size_t corner) {
        if (value < least.value) least = {value, &layer, corner};
        if (value > largest.value) largest = {value, &layer, corner};
    });
    if (!least.layer) return;
    std::vector<Vec3> places;
    for (const Found& found : {least, largest}) {
        const Corner* triangle = &found.layer->geometry->corners[found.corner / 3 * 3];
        const bool is_flat = triangle[0].value == triangle[1].value && triangle[0].value == triangle[2].value;
        Eigen::Vector3f place = Eigen::Vector3f::Zero();
        for (std::size_t k = 0; k < 3; ++k)
            if (is_flat) place += Eigen::Map<const Eigen::Vector3f>(triangle[k].position.data()) / 3;
        if (!is_flat) place = Eigen::Map<const Eigen::Vector3f>(triangle[found.corner % 3].position.data());
        place += Eigen::Map<const Eigen::Vector3f>(found.layer->ranges.front().offset.data());
        places.push_back(built_.frame.to_file(place.cast<double>()));
        built_.legend.marked.push_back({found.value, places.back()});
    }
    add_points(LayerKind::extremes, places, colors_.feature, place_pixels);
}

// Of a stress that has a sign, at both ends. All values where most of them are the same.
ValueRange SceneBuild::range_of_most_values(const ValueRange& all) {
    if (state_.percentile >= 100) return all;
    std::vector<double> values;
    for_drawn_values([&](double value, const Layer&, std::size_t) { values.push_back(value); });
    const auto quantile = [&](double share) {
        const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
        std::nth_element(values.begin(), values.begin() + at, values.end());
        return values[static_cast<std::size_t>(at)];
    };
    const double share = state_.percentile / 100;
    const ValueRange most{state_.color == ColorBy::von_mises ? all.low : quantile(1 - share), quantile(share)};
    if (!(most.low < most.high)) return all;
    built_.legend.percentile = state_.percentile;
    return most;
}

// Of a run under way nobody knows the distribution of the values yet, of surfaces nobody ever does.
void SceneBuild::set_range_of_values() {
    const bool is_solution = is_of_solution(state_.color);
    if (!shows_values() || (built_.legend.values && !is_solution)) return;
    ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for_drawn_values([&](double value, const Layer&, std::size_t) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    });
    if (is_solution && range.low <= range.high) built_.legend.extremes = range;
    if (built_.legend.values) return;
    if (is_stress(state_.color) && range.low < range.high) range = range_of_most_values(range);
    if (state_.color == ColorBy::deviation && range.high >= 0)
        range = {0, std::max(range.high, rounding_share * document_.box.diagonal().norm())};
    if (range.low == range.high) range = {0, range.high > 0 ? 2 * range.high : 1};  // the same everywhere
    if (range.low < range.high) set_range(range);
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

// Parts of the node of which something is drawn.
std::vector<NodeId> SceneBuild::drawn_parts() const {
    std::vector<NodeId> drawn;
    std::set<NodeId> owners;
    for (const Layer& layer : built_.scene.layers)
        if (layer.kind == LayerKind::part || layer.kind == LayerKind::cells || layer.kind == LayerKind::section)
            owners.insert(layer.owner);
    for (const NodeId part : document_.tree.parts_below(state_.node))
        if (owners.contains(part)) drawn.push_back(part);
    return drawn;
}

// Whole numbers that stand for colours; NaN, where something has none, is -1.
std::set<int> SceneBuild::drawn_categories() const {
    std::set<int> drawn;
    for (const Layer& layer : built_.scene.layers) {
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

void SceneBuild::explain(const std::string& text, const Color& color, LegendEntry::Mark mark) {
    built_.legend.categories.push_back({text, color, mark});
}

// Of a layer that there is; glass is explained as glass.
void SceneBuild::explain_layer(const Layer* layer, const std::string& text, const Color& color) {
    if (!layer || layer->fill != Fill::plain) return;
    Color drawn = color;
    drawn.a = layer->opacity;
    const Geometry& geometry = *layer->geometry;
    explain(text, drawn,
            !geometry.segments.empty() ? LegendEntry::Mark::line
            : !geometry.points.empty() ? LegendEntry::Mark::point
                                       : LegendEntry::Mark::area);
}

void SceneBuild::explain_origins() {
    bool has_core = false;
    std::set<std::string> others;
    for (const NodeId part : drawn_parts()) {
        const TreeRow* row = document_.tree.find(part);
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

void SceneBuild::explain_patches() {
    const std::set<int> drawn = drawn_categories();
    for (std::size_t i = 0; i < document_.patch_names.size(); ++i) {
        const float value = i < palette_of_patch_.size() ? palette_of_patch_[i] : static_cast<float>(i);
        const std::string& name = document_.patch_names[i];
        if (drawn.contains(static_cast<int>(value)))
            explain(numbers_patches() ? fmt::format("{}: {}", i, name) : name, patch_color(i));
    }
    if (drawn.contains(-1))
        explain(step_.stage == Stage::tetrahedra ? "interface or inside" : "interface", colors_.none);
}

void SceneBuild::explain_parts() {
    std::set<std::int32_t> seen;
    for (const NodeId part : drawn_parts()) {
        const TreeRow& row = *document_.tree.find(part);
        const std::int32_t value = state_.color == ColorBy::rank ? row.rank : level_of(part);
        if (state_.color == ColorBy::part)
            explain(fmt::format("part {}", part), drawn_color_of(part));
        else if (value >= 0 && seen.insert(value).second)
            explain(fmt::format("{} {}", name(state_.color), value), drawn_color_of(part));
    }
}

// What the colours of cells and facets stand for, where they stand for few things.
void SceneBuild::explain_coloring() {
    if (state_.color == ColorBy::patch) return explain_patches();
    if (!shows_parts() || shows_values()) return;
    if (is_kind(state_.color) && step_.stage == Stage::parts) return;  // cells have it
    if (state_.color == ColorBy::kind) {
        const std::set<int> drawn = drawn_categories();
        if (drawn.contains(0)) explain("inner cells", category_color(0));
        if (drawn.contains(1)) explain("cells at an interface", category_color(1));
    } else if (state_.color == ColorBy::origin) {
        explain_origins();
    } else if (state_.color == ColorBy::region) {
        explain_regions();
    } else {
        explain_parts();
    }
}

void SceneBuild::explain_axes() {
    if (!built_.scene.find(LayerKind::axes)) return;
    constexpr std::array<const char*, 3> names = {"long axis", "middle axis", "short axis"};
    for (std::size_t k = 0; k < names.size(); ++k) explain(names[k], colors_.axes[k], LegendEntry::Mark::line);
    explain_layer(LayerKind::centre, "centre of gravity", colors_.contour);
}

// What lies in the surfaces of nodes, by earlier cuts or by this one.
void SceneBuild::explain_interfaces() {
    const bool is_split = step_.stage == Stage::split;
    if (is_split && state_.node == 1 && state_.explode == 0 && !side_ && state_.hidden.empty()) return;  // inside
    if (built_.scene.find(LayerKind::triangulation) || built_.scene.find(LayerKind::interface)) return;
    for (const Layer& layer : built_.scene.layers)
        for (const Range& range : layer.ranges)
            if (layer.fill == Fill::plain && range.color == colors_.interface)
                return explain_layer(&layer, is_split ? "interfaces" : "earlier interfaces", range.color);
}

void SceneBuild::set_legend() {
    if (shows_parts() || state_.color == ColorBy::patch || built_.legend.values) built_.legend.title = legend_title();
    explain_coloring();
    for (const NodeId half : {2 * state_.node, 2 * state_.node + 1})
        explain_layer(built_.scene.find(LayerKind::half, half), fmt::format("node {}", half), half_color(half));
    explain_axes();
    for (int i = static_cast<int>(Stage::plane); i <= static_cast<int>(Stage::interface); ++i) {
        const auto stage = static_cast<Stage>(i);
        explain_layer(layer_of(stage), in_words(name(stage)), color_of(stage));
    }
    explain_interfaces();
    if (step_.stage < Stage::split) explain_layer(LayerKind::features, "features", colors_.feature);
    explain_layer(LayerKind::refused, "refused contour", colors_.refused);
    explain_layer(LayerKind::places, "where it failed", colors_.error);
    explain_layer(LayerKind::colliding, "interface that collides", colors_.colliding);
    explain_layer(LayerKind::collided, "what it collides with", colors_.collided);
    explain_layer(LayerKind::defect_places, "errors", colors_.error);
    explain_layer(LayerKind::warning_places, "warnings", colors_.warning);
}

}  // namespace kerf::view

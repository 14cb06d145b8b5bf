// The range of a scale comes from the view, else from the measure (natural_range()), else from the histogram of the
// run, which is the same for every picture of the run; only then from the values that are drawn. Lengths and volumes
// end at a multiple of the median, because few cells are far larger than the others, and stresses span a percentile of
// the drawn values, because single vertices at corners of a body have far larger ones. Values outside of the range have
// the colours of its ends, and the legend says on which side there are some. Only corners that the clip plane does not
// hide count as drawn, and layers must be complete before follow_layers() and mark_extremes() are called.
#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/scene/inside/legend.h"

namespace kerf::view {

namespace {

constexpr double rounding_share = 1e-9;  // of the diagonal: smaller deviations are rounding, and drawn as none

}  // namespace

void ScaleMaker::begin() {
    built_.scene.scale.none = context_.colors.none;
    if (!is_measure(context_.state.coloring.by) && !is_of_surface(context_.state.coloring.by) &&
        !is_of_solution(context_.state.coloring.by))
        return;
    built_.scene.scale.colors = value_colors(context_.state.coloring.by);
    std::optional<ValueRange> range =
        context_.state.coloring.range ? context_.state.coloring.range : natural_range(context_.state.coloring.by);
    const bool is_volume = context_.state.coloring.by == ColorBy::volume;
    const bool is_size = is_volume || context_.state.coloring.by == ColorBy::edge_length;
    const auto& histogram = context_.document.histograms[is_volume ? 5 : 7];
    // Few cells are far larger than the others: their colour is that of the upper end.
    if (!range && is_size && histogram)
        range = ValueRange{histogram->min, std::min(histogram->max, (is_volume ? 4 : 2) * histogram->median)};
    if (!range) return;  // the range follows from the drawn values
    set_range(*range);
}

void ScaleMaker::set_range(const ValueRange& range) {
    built_.scene.scale.low = static_cast<float>(range.low);
    built_.scene.scale.high = static_cast<float>(range.high);
    if (!context_.shows_values()) return;
    built_.legend.values = range;
    built_.legend.scale = built_.scene.scale.colors;
}

// Corners with values, but for those that the clip plane hides: visit(value, layer, number of the corner).
template <class Visit>
void ScaleMaker::for_drawn_values(Visit visit) const {
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

// The value of a whole triangle is marked in its middle, that of a corner at the corner.
void ScaleMaker::mark_extremes() {
    if (!context_.state.coloring.extremes || !context_.shows_values()) return;
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
        places.push_back(context_.frame.to_file(place.cast<double>()));
        built_.legend.marked.push_back({found.value, places.back()});
    }
    sink_.add_points(LayerKind::extremes, places, context_.colors.feature, place_pixels);
}

// Stresses that have a sign are limited at both ends. The range is that of all values where most of them are the same.
ValueRange ScaleMaker::range_of_most_values(const ValueRange& all) {
    if (context_.state.coloring.percentile >= 100) return all;
    std::vector<double> values;
    for_drawn_values([&](double value, const Layer&, std::size_t) { values.push_back(value); });
    const auto quantile = [&](double share) {
        const auto at = static_cast<std::ptrdiff_t>(share * (values.size() - 1));
        std::nth_element(values.begin(), values.begin() + at, values.end());
        return values[at];
    };
    const double share = context_.state.coloring.percentile / 100;
    const ValueRange most{context_.state.coloring.by == ColorBy::von_mises ? all.low : quantile(1 - share),
                          quantile(share)};
    if (!(most.low < most.high)) return all;
    built_.legend.percentile = context_.state.coloring.percentile;
    return most;
}

// The distribution of values is not known yet for a run under way, and never for surfaces.
void ScaleMaker::follow_layers() {
    const bool is_solution = is_of_solution(context_.state.coloring.by);
    if (!context_.shows_values()) return;
    ValueRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for_drawn_values([&](double value, const Layer&, std::size_t) {
        range.low = std::min(range.low, value);
        range.high = std::max(range.high, value);
    });
    if (is_solution && range.low <= range.high) built_.legend.extremes = range;
    const ValueRange drawn = range;
    if (!built_.legend.values) follow(range);
    built_.legend.goes_below = static_cast<float>(drawn.low) < built_.scene.scale.low;
    built_.legend.goes_above = static_cast<float>(drawn.high) > built_.scene.scale.high;
}

// Sets the range of values that nobody has limited.
void ScaleMaker::follow(ValueRange range) {
    if (is_stress(context_.state.coloring.by) && range.low < range.high) range = range_of_most_values(range);
    if (context_.state.coloring.by == ColorBy::deviation && range.high >= 0)
        range = {0, std::max(range.high, rounding_share * context_.document.box.diagonal().norm())};
    if (range.low == range.high) range = {0, range.high > 0 ? 2 * range.high : 1};  // the same everywhere
    if (range.low < range.high) set_range(range);
}

}  // namespace kerf::view

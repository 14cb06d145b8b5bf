#include "files/quality/inside/histogram_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace kerf {

namespace {

// Tells whether a width is 1, 2, 2.5 or 5 times a power of ten.
bool is_round(double width) {
    const double decades = std::log10(width), leading = std::pow(10, decades - std::floor(decades + 1e-9));
    constexpr std::array<double, 4> round = {1, 2, 2.5, 5};
    return std::any_of(round.begin(), round.end(), [&](double r) { return std::abs(leading - r) < 1e-6 * r; });
}

struct Bins {
    int first = Distribution::bin_count, end = 0;
};

Bins bins_to_show(std::span<const Distribution* const> distributions, const RowsWanted& wanted) {
    const bool is_linear = distributions.front()->scale() == Distribution::Scale::linear;
    const double tail = is_linear ? 0 : wanted.tail;
    Bins bins;
    for (const Distribution* each : distributions) {
        if (each->count() == 0) continue;
        bins.first = std::min(bins.first, each->bin_of(each->percentile(tail)));
        bins.end = std::max(bins.end, each->bin_of(each->percentile(1 - tail)) + 1);
    }
    const int missing = wanted.least_bins - (bins.end - bins.first);
    if (missing <= 0) return bins;
    bins.first = std::clamp(bins.first - missing / 2, 0, Distribution::bin_count - wanted.least_bins);
    return {bins.first, std::max(bins.end, bins.first + wanted.least_bins)};
}

}  // namespace

HistogramRows choose_rows(std::span<const Distribution* const> distributions, const RowsWanted& wanted) {
    const auto [first, end] = bins_to_show(distributions, wanted);
    if (distributions.front()->scale() == Distribution::Scale::logarithmic) {
        const int group = (end - first + wanted.most - 1) / wanted.most, groups = (end - first + group - 1) / group;
        return {std::min(first, Distribution::bin_count - group * groups), group, groups};
    }
    const std::vector<double> range = distributions.front()->histogram(1).edges;
    const double bin = (range.back() - range.front()) / Distribution::bin_count;
    int group = 1;
    while (group < Distribution::bin_count && (Distribution::bin_count % group || !is_round(bin * group) ||
                                               (end + group - 1) / group - first / group > wanted.most))
        ++group;
    return {first / group * group, group, (end + group - 1) / group - first / group};
}

}  // namespace kerf

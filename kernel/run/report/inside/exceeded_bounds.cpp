#include "run/report/inside/exceeded_bounds.h"

#include <numeric>

#include <fmt/format.h>

#include "base/core/number_text.h"

namespace kerf {

namespace {

std::int64_t count_beyond(const Distribution& values, double bound) {
    const int first = values.bin_of(bound) + 1, bins = Distribution::bin_count - first;
    if (bins == 0) return 0;
    const std::vector<std::int64_t> counts = values.histogram(first, 1, bins).counts;
    return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

}  // namespace

std::vector<ExceededBound> exceeded_bounds(const RunReport& report) {
    constexpr std::size_t radius_edge = 2, volume = 5;  // numbers of these measures in quality_measures
    std::vector<ExceededBound> exceeded;
    if (report.mesh.quality.all.measures.size() <= volume) return exceeded;  // nothing was meshed
    const auto add = [&](const char* option, double bound, const Distribution& values) {
        if (bound <= 0 || values.count() == 0) return;
        if (const std::int64_t cells = count_beyond(values, bound); cells > 0)
            exceeded.push_back({option, bound, cells, values.max()});
    };
    const SizeOptions& sizes = report.request.sizes;
    if (sizes.size.number() == 0)  // else the bound follows from a mean
        add("max-volume", sizes.max_volume, report.mesh.quality.all.measures[volume]);
    add("radius-edge", report.request.mesher.radius_edge, report.mesh.quality.all.measures[radius_edge]);
    return exceeded;
}

std::string exceeded_text(const std::vector<ExceededBound>& bounds) {
    std::string text;
    for (const ExceededBound& each : bounds)
        text += fmt::format("{}{} cell{} beyond --{} {:.6g}, up to {:.3g} times", text.empty() ? "" : "; ",
                            grouped(each.cells), each.cells == 1 ? "" : "s", each.option, each.bound,
                            each.largest / each.bound);
    return text;
}

}  // namespace kerf

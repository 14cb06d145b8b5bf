// All tables are functions of counts: percentiles and histograms of distributions that were added up over the parts.
// Rows of percentiles have a title of 48 characters and a column of 11 for each of quality_fractions, so that tables of
// cells, angles and regions stand below each other. In brief, only the tables of all cells, of forced angles if there
// are any, and of regions are written, the regions cut to the ten with the worst cells; the row "all" still tells the
// whole. A comparison shows both meshes in the same intervals, which asks for one length scale: distributions of
// lengths and volumes have different bins otherwise.
#include "files/quality/quality_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/number_text.h"
#include "files/quality/inside/histogram_rows.h"

namespace kerf {

namespace {

constexpr std::array<const char*, quality_fractions.size()> fraction_names = {"min",    "0.1 %", "1 %", "5 %",
                                                                              "median", "95 %",  "max"};

std::string title_of(const Measure& measure) {
    return *measure.unit ? fmt::format("{}, {}", measure.title, measure.unit) : measure.title;
}

std::string percent(std::int64_t count, std::int64_t of) {
    return fmt::format("{:.2f} %", of ? 100.0 * count / of : 0.0);
}

std::string percentile_head(const std::string& title) {
    std::string head = fmt::format("{:<48}", title);
    for (const char* name : fraction_names) head += fmt::format("{:>11}", name);
    return head + "\n";
}

std::string percentile_row(const std::string& title, const Percentiles& percentiles) {
    std::string row = fmt::format("  {:<46}", title);
    for (const double value : percentiles) row += fmt::format("{:>11}", four_digits(value));
    return row + "\n";
}
std::string percentile_row(const std::string& title, const Distribution& distribution) {
    return percentile_row(title, percentiles_of(distribution));
}

std::string percentile_table(const std::string& title, std::span<const Measure> measures,
                             const std::vector<Distribution>& distributions) {
    std::string text = "\n" + percentile_head(title);
    for (std::size_t i = 0; i < distributions.size(); ++i)
        text += percentile_row(title_of(measures[i]), distributions[i]);
    return text;
}

std::string cells_table(const char* which, const QualityDistributions& cells, std::int64_t of) {
    const std::int64_t count = cells.measures.front().count();
    if (count == 0) return "";
    return percentile_table(fmt::format("{}: {} ({})", which, grouped(count), percent(count, of)), quality_measures,
                            cells.measures);
}

std::string forced_table(const ForcedDistributions& angles, std::int64_t of) {
    const std::int64_t count = angles.forced.count();
    const std::string head =
        fmt::format("Forced by the surface: {} cell{} ({})", grouped(count), count == 1 ? "" : "s", percent(count, of));
    if (count == 0) return "\n" + head + "\n";
    return "\n" + percentile_head(head) + percentile_row(title_of(forced_measure), angles.forced) +
           percentile_row(title_of(unforced_measure), angles.unforced);
}

std::string region_row(const std::string& name, std::int64_t tets, double volume, const Percentiles& percentiles) {
    return percentile_row(fmt::format("{:<22}{:>12}{:>12}", name, grouped(tets), four_digits(volume)), percentiles);
}

// Returns the smallest dihedral angles of each region; in brief of the ten regions with the worst cells, the worst
// first.
std::string region_table(const MeshQuality& quality, QualityDetail detail, const std::string& of = "") {
    if (quality.regions.empty()) return "";
    constexpr std::size_t most = 10;
    std::vector<RegionQuality> regions = quality.regions;
    const bool is_cut = detail == QualityDetail::brief && regions.size() > most;
    if (is_cut) {
        const auto least = [](const RegionQuality& region) { return region.measures.front().front(); };
        std::stable_sort(regions.begin(), regions.end(),
                         [&](const RegionQuality& a, const RegionQuality& b) { return least(a) < least(b); });
        regions.resize(most);
    }
    std::string text =
        fmt::format("\n{}{} by region, {}\n", quality_measures.front().title, of, quality_measures.front().unit);
    text[1] = static_cast<char>(std::toupper(text[1]));
    text += percentile_head(fmt::format("  {:<22}{:>12}{:>12}", "", "cells", "volume"));
    double volume = 0;
    for (const RegionQuality& region : quality.regions) volume += region.volume;
    for (const RegionQuality& region : regions)
        text += region_row(region.name, region.tets, region.volume, region.measures.front());
    if (is_cut)
        text += fmt::format("  and {} more, none with worse cells: -v and --json have all\n",
                            grouped(quality.regions.size() - most));
    return text + region_row("all", quality.tets(), volume, percentiles_of(quality.cells.all.measures.front()));
}

std::string interval_text(double low, double high) {
    return fmt::format("{:>9} - {:<9}", four_digits(low), four_digits(high));
}

// Returns a histogram in two columns: the second half of the intervals stands beside the first.
std::string histogram_text(const Measure& measure, const Distribution& distribution) {
    const Distribution* all[] = {&distribution};
    const HistogramRows rows = choose_rows(all, {});
    const Distribution::Histogram histogram = distribution.histogram(rows.first, rows.group, rows.groups);
    const auto cell = [&](std::size_t i) {
        return fmt::format("{}{:>13}{:>10}", interval_text(histogram.edges[i], histogram.edges[i + 1]),
                           grouped(histogram.counts[i]), percent(histogram.counts[i], distribution.count()));
    };
    std::string text = fmt::format("\n{}\n", title_of(measure));
    const std::size_t half = (histogram.counts.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i)
        text +=
            half + i < histogram.counts.size() ? fmt::format("{}   |{}\n", cell(i), cell(half + i)) : cell(i) + "\n";
    return text;
}

std::string histogram_texts(std::span<const Measure> measures, const std::vector<Distribution>& distributions) {
    std::string text;
    for (std::size_t i = 0; i < distributions.size(); ++i)
        if (distributions[i].count() > 0) text += histogram_text(measures[i], distributions[i]);
    return text;
}

std::string head_text(const MeshQuality& quality) {
    std::string text = fmt::format("{}: {} part{}, {} tetrahedra, {} vertices, {} boundary triangles\n", quality.name,
                                   quality.parts, quality.parts == 1 ? "" : "s", grouped(quality.tets()),
                                   grouped(quality.vertices), grouped(quality.boundary.measures.front().count()));
    if (quality.turned_tets > 0)
        text += fmt::format("  note      {} tetrahedra of negative orientation were turned.\n",
                            grouped(quality.turned_tets));
    if (quality.curved)
        text += fmt::format("  curved    {} cells of order 2 have curved edges; scaled Jacobian at least {:.3f}\n",
                            grouped(quality.curved->count), quality.curved->worst_scaled_jacobian);
    for (const std::string& note : quality.notes) text += fmt::format("  note      {}\n", note);
    return text;
}

std::string side_by_side_text(const Measure& measure, const Distribution& first, const Distribution& second) {
    const Distribution* both[] = {&first, &second};
    const HistogramRows rows = choose_rows(both, {});
    const std::array<Distribution::Histogram, 2> histograms = {first.histogram(rows.first, rows.group, rows.groups),
                                                               second.histogram(rows.first, rows.group, rows.groups)};
    std::string text =
        fmt::format("\n{}\n{:<21}  |{:>12}{:>12}  |{:>12}{:>12}\n", title_of(measure), "", "A", "B", "A", "B");
    std::array<std::int64_t, 2> below = {0, 0};
    for (int row = 0; row < rows.groups; ++row) {
        for (std::size_t k = 0; k < below.size(); ++k) below[k] += histograms[k].counts[row];
        text += fmt::format(
            "{}  |{:>12}{:>12}  |{:>12}{:>12}\n", interval_text(histograms[0].edges[row], histograms[0].edges[row + 1]),
            percent(histograms[0].counts[row], first.count()), percent(histograms[1].counts[row], second.count()),
            percent(below[0], first.count()), percent(below[1], second.count()));
    }
    return text;
}

std::string compared_rows(const Measure& measure, const Distribution& first, const Distribution& second) {
    const std::string title = title_of(measure);
    return percentile_row(title + ": A", first) + percentile_row(fmt::format("{:>{}}B", "", title.size() + 2), second);
}

std::string compared_percentiles(std::span<const Measure> measures, const std::vector<Distribution>& first,
                                 const std::vector<Distribution>& second) {
    std::string text;
    for (std::size_t i = 0; i < measures.size(); ++i) text += compared_rows(measures[i], first[i], second[i]);
    return text;
}

std::string compared_histograms(std::span<const Measure> measures, const std::vector<Distribution>& first,
                                const std::vector<Distribution>& second) {
    std::string text;
    for (std::size_t i = 0; i < measures.size(); ++i) text += side_by_side_text(measures[i], first[i], second[i]);
    return text;
}

}  // namespace

std::string four_digits(double value) { return fmt::format("{:.4g}", value); }

std::string quality_text(const MeshQuality& quality, QualityDetail detail) {
    std::string text = head_text(quality);
    text += cells_table("All cells", quality.cells.all, quality.tets());
    if (quality.cells.angles.forced.count() > 0 || (detail == QualityDetail::all && quality.tets() > 0))
        text += forced_table(quality.cells.angles, quality.tets());
    text += region_table(quality, detail);
    if (detail == QualityDetail::brief) return text;
    text += cells_table("Cells with a vertex on an interface", quality.cells.interface, quality.tets());
    if (quality.cells.interface.measures.front().count() > 0)
        text += cells_table("Other cells", quality.cells.interior, quality.tets());
    if (quality.boundary.measures.front().count() > 0)
        text += percentile_table("Boundary triangles", triangle_measures, quality.boundary.measures);
    text += "\nHistograms: from, to, number and percentage of all cells, or of boundary triangles.\n";
    text += histogram_texts(quality_measures, quality.cells.all.measures);
    text += histogram_texts(triangle_measures, quality.boundary.measures);
    return text;
}

std::string comparison_text(const MeshQuality& first, const MeshQuality& second, QualityDetail detail) {
    for (std::size_t i = 0; i < quality_measures.size(); ++i)
        if (!first.cells.all.measures[i].has_range_of(second.cells.all.measures[i]))
            throw Error(ErrorCode::internal, "Meshes that were measured with different length scales are compared.");
    const bool have_boundaries =
        first.boundary.measures.front().count() > 0 && second.boundary.measures.front().count() > 0;
    std::string text = fmt::format("A {}B {}\n", head_text(first), head_text(second)) + percentile_head("All cells");
    text += compared_percentiles(quality_measures, first.cells.all.measures, second.cells.all.measures);
    const ForcedDistributions &a = first.cells.angles, &b = second.cells.angles;
    if (a.forced.count() > 0 || b.forced.count() > 0) text += compared_rows(unforced_measure, a.unforced, b.unforced);
    if (have_boundaries)
        text += compared_percentiles(triangle_measures, first.boundary.measures, second.boundary.measures);
    text += region_table(first, detail, " of A") + region_table(second, detail, " of B");
    if (detail == QualityDetail::brief) return text;
    text += "\nPercentages of cells, or of boundary triangles: in the interval, then accumulated up to its end.\n";
    text += compared_histograms(quality_measures, first.cells.all.measures, second.cells.all.measures);
    if (have_boundaries)
        text += compared_histograms(triangle_measures, first.boundary.measures, second.boundary.measures);
    return text;
}

}  // namespace kerf

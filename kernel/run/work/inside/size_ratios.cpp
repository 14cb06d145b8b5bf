// Ratios are counted in bins of a sixteenth of an octave, from three octaves below the obeyed range, which is one
// octave, to three above; counts of parts add up, and percentiles are read from them without the ratios. The field is
// asked once for each vertex. Edges inside are found from the cells bucket by bucket, by their smaller vertex
// (fill/mesh/buckets.h), so that they need half of the memory of the cells and not a list of all edges; in each bucket
// a small table keeps the different other ends. Large meshes count the edges of a sample of vertices, each with the
// weight of the sampling, which is a power of two, so that the choice depends on numbers alone.
#include "run/work/inside/size_ratios.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/core/number_text.h"
#include "base/core/quick_log2.h"
#include "fill/mesh/buckets.h"

namespace kerf {

namespace {

// Finds the different ones among some numbers, none of which is negative, by a table of the places where they may be.
class DistinctNumbers {
 public:
    /// Calls visit(number) for each, in the order of their first.
    template <class Visit>
    void visit(std::span<const std::int32_t> numbers, const Visit& visit) {
        constexpr std::uint32_t golden_ratio = 0x9E3779B9;  // times 2^32: its multiples spread evenly
        constexpr std::int32_t nobody = -1;
        const std::size_t mask = std::bit_ceil(2 * numbers.size() + 1) - 1;
        table_.assign(mask + 1, nobody);
        for (const std::int32_t number : numbers) {
            std::size_t place = (static_cast<std::uint32_t>(number) * golden_ratio) >> 16 & mask;
            while (table_[place] != nobody && table_[place] != number) place = (place + 1) & mask;
            if (table_[place] == number) continue;
            table_[place] = number;
            visit(number);
        }
    }

 private:
    std::vector<std::int32_t> table_;
};

constexpr std::size_t most_vertices = std::size_t{1} << 18;  // of which all edges are counted

// Returns the sampling: in large meshes the edges of one vertex in so many are enough.
std::int32_t sampling_of(const TetMesh& mesh) {
    return std::bit_ceil((mesh.vertices.size() + most_vertices - 1) / most_vertices);
}

// Calls visit(a, b) for every edge with an end beyond the boundary vertices, once, if its smaller end is a multiple of
// `sampling`. Beside the tetrahedra it needs half of the memory that they take.
template <class Visit>
void for_each_inner_edge(const TetMesh& mesh, std::int32_t sampling, const Visit& visit) {
    const std::int32_t left_out = sampling - 1;  // where it has bits: a power of two
    const auto for_each_side = [&](const auto& take) {
        for (const Tetrahedron& t : mesh.tets)
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t j = i + 1; j < 4; ++j) {
                    const std::int32_t a = std::min(t[i], t[j]), b = std::max(t[i], t[j]);
                    if ((a & left_out) == 0 && b >= mesh.boundary_vertex_count) take(a, b);
                }
    };
    const std::size_t most_sides = mesh.tets.size() * sizeof(Tetrahedron) / sizeof(std::int32_t) / 2;
    DistinctNumbers distinct;
    visit_buckets<std::int32_t>(mesh.vertices.size(), most_sides, for_each_side,
                                [&](std::size_t a, std::span<std::int32_t> others) {
                                    distinct.visit(others, [&](std::int32_t b) { visit(a, b); });
                                });
}

RatioCounts& counts_of_patch(SizeRatios& ratios, std::int32_t patch) {
    auto& all = ratios.by_patch;
    auto place =
        std::lower_bound(all.begin(), all.end(), patch, [](const auto& p, std::int32_t n) { return p.patch < n; });
    if (place == all.end() || place->patch != patch) place = all.insert(place, {patch, {}});
    return place->edges;
}

std::vector<std::int64_t> count_cells_in_solids(const TetMesh& mesh, const SizeField& field) {
    std::vector<std::int64_t> cells(field.solids().size(), 0);
    if (cells.empty()) return cells;
    for (const Tetrahedron& t : mesh.tets) {
        const Vec3 centroid =
            (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]] + mesh.vertices[t[3]]) / 4;
        field.for_each_solid_at(centroid, [&](std::size_t solid) { ++cells[solid]; });
    }
    return cells;
}

std::string ratios_text(const RatioCounts& r) {
    return fmt::format("{:.0f} % within {} to {}; median {:.2f}, 1 % {:.2f}, 99 % {:.2f}", 100 * r.share_obeyed(),
                       RatioCounts::low, RatioCounts::high, r.percentile(0.5), r.percentile(0.01), r.percentile(0.99));
}

}  // namespace

void RatioCounts::add(double ratio, std::int64_t times) {
    const double above_low = std::isnormal(ratio) ? quick_log2(ratio / low) : std::log2(ratio / low);
    const double octave = above_low + octaves_below;
    const double bin = std::clamp<double>(std::floor(octave * bins_per_octave), 0, bins_.size() - 1);
    bins_[static_cast<std::size_t>(bin)] += times;
}

void RatioCounts::add(const RatioCounts& other) {
    for (std::size_t i = 0; i < bins_.size(); ++i) bins_[i] += other.bins_[i];
}

std::int64_t RatioCounts::count() const { return std::accumulate(bins_.begin(), bins_.end(), std::int64_t{0}); }

double RatioCounts::share_obeyed() const {
    const auto begin = bins_.begin() + octaves_below * bins_per_octave;
    const double all = count();
    return all == 0 ? 0 : std::accumulate(begin, begin + bins_per_octave, std::int64_t{0}) / all;
}

std::int64_t RatioCounts::count_from(double bound) const {
    const double bin = std::round((std::log2(bound / low) + octaves_below) * bins_per_octave);
    return std::accumulate(
        bins_.begin() + std::clamp<std::ptrdiff_t>(std::ptrdiff_t(bin), 0, std::ptrdiff_t(bins_.size())), bins_.end(),
        std::int64_t{0});
}

double RatioCounts::mean() const {
    constexpr double middle = 0.5;
    const double all = count();
    double sum = 0;
    for (std::size_t bin = 0; bin < bins_.size(); ++bin)
        sum += bins_[bin] * low * std::exp2((bin + middle) / bins_per_octave - octaves_below);
    return all == 0 ? 0 : sum / all;
}

double RatioCounts::percentile(double fraction) const {
    const double wanted = fraction * count();
    double below = 0;
    std::size_t bin = 0;
    while (bin + 1 < bins_.size() && below + bins_[bin] < wanted) below += bins_[bin++];
    const double within = bins_[bin] == 0 ? 0 : (wanted - below) / bins_[bin];
    return low * std::exp2((bin + within) / bins_per_octave - octaves_below);
}

void SizeRatios::add(const SizeRatios& other) {
    inside.add(other.inside);
    interfaces.add(other.interfaces);
    for (const OfPatch& patch : other.by_patch) counts_of_patch(*this, patch.patch).add(patch.edges);
    cells_in_solids.resize(std::max(cells_in_solids.size(), other.cells_in_solids.size()), 0);
    for (std::size_t i = 0; i < other.cells_in_solids.size(); ++i) cells_in_solids[i] += other.cells_in_solids[i];
}

template <class Value>
double SizeRatios::sum_of_edges(const Value& value) const {
    double sum = value(inside) + value(interfaces) / 4;
    for (const OfPatch& patch : by_patch) sum += value(patch.edges) / 2;
    return sum;
}

double SizeRatios::mean() const {
    const double edges = sum_of_edges([](const RatioCounts& r) { return double(r.count()); });
    return edges == 0 ? 0 : sum_of_edges([](const RatioCounts& r) { return r.mean() * r.count(); }) / edges;
}

double SizeRatios::share_from(double bound) const {
    const double edges = sum_of_edges([](const RatioCounts& r) { return double(r.count()); });
    return edges == 0 ? 0 : sum_of_edges([&](const RatioCounts& r) { return double(r.count_from(bound)); }) / edges;
}

SizeRatios measure_sizes(const TetMesh& mesh, const SurfaceArrays& surface, const SizeField& field) {
    SizeRatios ratios;
    if (field.is_empty()) return ratios;
    std::vector<double> wanted;
    wanted.reserve(mesh.vertices.size());
    for (const Vec3& p : mesh.vertices) wanted.push_back(field.at(p));
    const auto ratio = [&](std::int32_t a, std::int32_t b) {
        return 2 * (mesh.vertices[a] - mesh.vertices[b]).norm() / (wanted[a] + wanted[b]);
    };
    const std::int32_t sampling = sampling_of(mesh);
    for_each_inner_edge(mesh, sampling,
                        [&](std::int32_t a, std::int32_t b) { ratios.inside.add(ratio(a, b), sampling); });
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
        const Triangle& t = surface.facets[f];
        RatioCounts& counts = surface.patch[f] >= 0 ? counts_of_patch(ratios, surface.patch[f]) : ratios.interfaces;
        for (std::size_t i = 0; i < 3; ++i) counts.add(ratio(t[i], t[(i + 1) % 3]));
    }
    ratios.cells_in_solids = count_cells_in_solids(mesh, field);
    return ratios;
}

std::string size_text(const SizeRatios& ratios, const std::vector<std::string>& patch_names, bool every_kind) {
    constexpr std::size_t most_patches = 5;
    std::string text = "inside " + ratios_text(ratios.inside);
    if (!every_kind) return text;
    const auto add = [&](const std::string& line) { text += fmt::format("\n{:<11} {}", "", line); };
    if (ratios.interfaces.count() > 0) add("interfaces " + ratios_text(ratios.interfaces));
    for (std::size_t i = 0; i < std::min(most_patches, ratios.by_patch.size()); ++i) {
        const SizeRatios::OfPatch& of_patch = ratios.by_patch[i];
        add(fmt::format("on {} {}", patch_names[of_patch.patch], ratios_text(of_patch.edges)));
    }
    if (ratios.by_patch.size() > most_patches)
        add(fmt::format("and {} more patches, in report.json", ratios.by_patch.size() - most_patches));
    return text;
}

}  // namespace kerf

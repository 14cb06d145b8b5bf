// Seconds and memory of the decomposition against the number of facets: the bearing cap with 14 k and 52 k facets, and
// with 207 k and 829 k by quartering every facet at the middles of its edges.
//
// Then what 5000 voids cost: the check and the cut of a foam against those of a torus with as many facets.
//
// Seconds are those of the processor on one thread, so that other programs of the machine disturb them little; medians
// of three runs. Memory is the largest resident set during the run less that before it, the input surface not counted.
#include <algorithm>
#include <array>
#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "bench/bench.h"
#include "cut/decompose/decomposition.h"
#include "run/prepare/input.h"
#include "support/shapes.h"

namespace kerf {

namespace {

struct Sample {
    double seconds = 0, peak_bytes = 0;
    std::int32_t tries = 0;  // of all cuts
};

Sample decompose_once(const Surface& surface, std::int32_t parts) {
    bench::forget_process_memory();
    const double resident = bench::memory_bytes("VmRSS");
    const std::clock_t start = std::clock();
    DecomposeOptions options;
    options.parts = parts;
    const Decomposition result = decompose(surface, options, {0, parts});
    const std::clock_t end = std::clock();
    Sample sample{static_cast<double>(end - start) / CLOCKS_PER_SEC, bench::memory_bytes("VmHWM") - resident};
    for (const TreeNode& node : result.nodes) sample.tries += node.tries;
    return sample;
}

Sample median_of_three(const Surface& surface, std::int32_t parts) {
    std::array<Sample, 3> runs;
    for (Sample& run : runs) run = decompose_once(surface, parts);
    std::sort(runs.begin(), runs.end(), [](const Sample& a, const Sample& b) { return a.seconds < b.seconds; });
    return runs[1];
}

void print_row(const Surface& surface) {
    const double facets = surface.facet_count();
    std::array<Sample, 3> samples;
    double peak_bytes = 0;
    for (int i = 0; i < 3; ++i) {
        constexpr std::array<std::int32_t, 3> parts = {2, 8, 64};
        samples[i] = median_of_three(surface, parts[i]);
        peak_bytes = std::max(peak_bytes, samples[i].peak_bytes);
    }
    fmt::print("{:>8.0f} {:>10.3f} {:>10.3f} {:>10.3f} {:>10.2f} {:>10.2f} {:>10.2f} {:>12.0f}\n", facets,
               samples[0].seconds, samples[1].seconds, samples[2].seconds, samples[0].seconds / facets * 1e6,
               samples[1].seconds / facets * 1e6, samples[2].seconds / facets * 1e6, peak_bytes / facets);
    std::fflush(stdout);
}

// A block of 25 x 20 x 10 unit cubes, each with a spherical void: 0.4 M facets of voids, 0.1 M outside.
Soup foam() {
    constexpr std::array<int, 3> cells = {25, 20, 10};
    Soup soup = test::box(Vec3::Zero(), Vec3(25, 20, 10), {6 * 25, 6 * 20, 6 * 10});
    const Soup bubble = test::inside_out(test::icosphere(1, 0.3, Vec3::Constant(0.5)));
    for (int i = 0; i < cells[0] * cells[1] * cells[2]; ++i) {
        const Vec3 place(i % cells[0], i / cells[0] % cells[1], i / (cells[0] * cells[1]));
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        for (const Vec3& p : bubble.vertices) soup.vertices.push_back(p + place);
        for (const Triangle& t : bubble.facets) soup.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    soup.patch.assign(soup.facets.size(), 0);
    return soup;
}

// Median of three, of the processor.
template <class Work>
double seconds_of(Work work) {
    std::array<double, 3> seconds;
    for (double& s : seconds) {
        const std::clock_t start = std::clock();
        work();
        s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[1];
}

struct CheckAndCut {
    double check_seconds, cut_seconds, seconds_per_try;
};

CheckAndCut check_and_cut(const char* name, const Soup& soup) {
    const double check_seconds = seconds_of([&] { check_soup(soup, {}); });
    const Surface surface = test::to_surface(soup);
    const Sample cut = median_of_three(surface, 8);
    const double seconds_per_try = cut.seconds / cut.tries;
    fmt::print("{:>8} {:>8} {:>10.3f} {:>10.3f} {:>8} {:>10.3f}\n", name, soup.facets.size(), check_seconds,
               cut.seconds, cut.tries, seconds_per_try);
    std::fflush(stdout);
    return {check_seconds, cut.seconds, seconds_per_try};
}

// How often a cut is tried depends on what the planes meet, so the seconds of a try are compared, too.
void print_foam() {
    fmt::print("\n5000 voids against none: seconds on one thread\n{:>8} {:>8} {:>10} {:>10} {:>8} {:>10}\n", "",
               "facets", "check", "8 parts", "tries", "per try");
    const Soup voids = foam();
    const auto around = static_cast<int>(voids.facets.size()) / 800;
    const CheckAndCut without = check_and_cut("torus", test::torus(3, 1, around, 400));
    const CheckAndCut with = check_and_cut("foam", voids);
    fmt::print("{:>8} {:>8} {:>10.2f} {:>10.2f} {:>8} {:>10.2f}\n", "ratio", "",
               with.check_seconds / without.check_seconds, with.cut_seconds / without.cut_seconds, "",
               with.seconds_per_try / without.seconds_per_try);
}

}  // namespace

}  // namespace kerf

int main() {
    const std::string assets = KERF_ASSETS;
    fmt::print("decomposition of the bearing cap on one thread: seconds, microseconds per facet, peak memory\n");
    fmt::print("{:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>12}\n", "facets", "2 parts", "8 parts", "64 parts",
               "us/f (2)", "us/f (8)", "us/f (64)", "bytes/facet");
    kerf::print_row(kerf::read_input(assets + "/bearing_cap_14k.stl").complex.take_only_region());
    kerf::Surface surface = kerf::read_input(assets + "/bearing_cap_52k.stl").complex.take_only_region();
    kerf::print_row(surface);
    for (int level = 0; level < 2; ++level) {
        surface = kerf::bench::quartered(surface);
        kerf::print_row(surface);
    }
    kerf::print_foam();
}

// What the benchmark of the meshers needs: surfaces that every mesher reads, a call of one of ours, and one measure for
// all results. tests/bench/meshers.py runs it.
//
//     meshers_bench prepare INPUT STEM [quartered]   writes STEM.stl, which all are given, and each shell as STEM_0.stl
//     meshers_bench fill MESHER SURFACE.stl BOUND    seconds and memory of one call; BOUND: largest volume, 0 for none
//     meshers_bench fill-and-measure MESHER SURFACE.stl BOUND
//     meshers_bench measure MESH BOUND               of a file of any program
//
// Figures are one line of JSON. Seconds are those of the processor, without the system's; memory is the largest
// resident set of the process, its surface included.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "bench/bench.h"
#include "files/io/stl_writer.h"
#include "files/io/tet_mesh_reader.h"
#include "fill/mesh/quality.h"
#include "fill/mesh/verification.h"
#include "fill/volume/meshers.h"
#include "run/prepare/input.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/orientation.h"

namespace kerf {

namespace {

constexpr double sliver_deg = 20;
constexpr double rounding = 1e-9;  // relative: no larger volume counts as one above the bound

// Points as STL holds them.
SurfaceArrays rounded(SurfaceArrays surface) {
    for (Vec3& p : surface.vertices) p = p.cast<float>().cast<double>();
    return surface;
}

void prepare(const std::string& input, const std::string& stem, bool is_quartered) {
    const Surface given = read_input(input).complex.take_only_region();
    const SurfaceArrays surface = rounded(is_quartered ? bench::quartered(given).arrays() : given.arrays());
    write_stl(stem + ".stl", surface.vertices, surface.facets);
    const ConsistentFacets shells = make_consistent(surface.facets);
    std::vector<std::vector<Triangle>> facets(static_cast<std::size_t>(shells.shell_count));
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        facets[static_cast<std::size_t>(shells.shell[f])].push_back(surface.facets[f]);
    for (std::size_t i = 0; i < facets.size(); ++i)
        write_stl(fmt::format("{}_{}.stl", stem, i), surface.vertices, facets[i]);
    const double volume = enclosed_volume(surface.vertices, surface.facets);
    const MesherForecast& forecast = find_mesher("tetgen").forecast;
    fmt::print(R"({{"facets": {}, "shells": {}, "volume": {}, "tets_without_bound": {}, "tets_times_bound": {}}})"
               "\n",
               surface.facets.size(), facets.size(), volume,
               forecast.tets_by_edge_ratio.back() * static_cast<double>(surface.facets.size()),
               forecast.tets_per_volume_bound * volume);
}

// Reorders `values`.
float percentile(std::vector<float>& values, double fraction) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

std::string quality_json(const TetMesh& mesh, double bound) {
    std::vector<float> angles;
    angles.reserve(mesh.tets.size());
    double volume = 0, volume_above = 0;
    for (const Tetrahedron& t : mesh.tets) {
        const auto p = [&](std::size_t corner) { return mesh.vertices[static_cast<std::size_t>(t[corner])]; };
        const TetQuality quality = tet_quality(p(0), p(1), p(2), p(3));
        angles.push_back(static_cast<float>(quality.min_dihedral_deg));
        volume += quality.volume;
        if (bound > 0 && quality.volume > bound * (1 + rounding)) volume_above += quality.volume;
    }
    const auto slivers = std::count_if(angles.begin(), angles.end(), [](float angle) { return angle < sliver_deg; });
    std::string json =
        fmt::format(R"("volume": {}, "share_above": {}, "below_20_per_million": {})", volume, volume_above / volume,
                    1e6 * static_cast<double>(slivers) / static_cast<double>(angles.size()));
    for (const double percent : {0.0, 0.1, 1.0, 5.0, 50.0})
        json += fmt::format(R"(, "dihedral_{:g}": {})", percent, percentile(angles, percent / 100));
    return json;
}

void fill(const std::string& mesher, const std::string& path, double bound, bool is_measured) {
    const SurfaceArrays surface = read_input(path).complex.arrays();
    MesherOptions options;
    options.name = mesher;
    options.size = SizeField(bound);
    bench::forget_process_memory();
    const double start = bench::user_seconds();
    const Filling filling = mesh_volume(surface, options);
    const double seconds = bench::user_seconds() - start, bytes = bench::memory_bytes("VmHWM");
    fmt::print(R"({{"tets": {}, "core_tets": {}, "way": "{}", "seconds": {}, "peak_bytes": {})",
               filling.mesh.tets.size(), filling.core_tets, filling.strategy, seconds, bytes);
    if (is_measured)
        fmt::print(R"(, "is_valid": {}, {})", verify_mesh(filling.mesh, surface).hold(),
                   quality_json(filling.mesh, bound));
    fmt::print("}}\n");
}

void measure(const std::string& path, double bound) {
    const TetFile file = read_tet_file(path);
    fmt::print("{{\"tets\": {}, {}}}\n", file.mesh.tets.size(), quality_json(file.mesh, bound));
}

int run(const std::vector<std::string>& words) {
    if (words.size() >= 3 && words[0] == "prepare")
        prepare(words[1], words[2], words.back() == "quartered");
    else if (words.size() == 4 && words[0].starts_with("fill"))
        fill(words[1], words[2], std::stod(words[3]), words[0] == "fill-and-measure");
    else if (words.size() == 3 && words[0] == "measure")
        measure(words[1], std::stod(words[2]));
    else
        return 2;
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

// Where the time before the volume meshes goes: the steps of the kernel one by one, on the largest asset.
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include <benchmark/benchmark.h>

#include "base/geometry/max_flow.h"
#include "cut/decompose/decomposition.h"
#include "files/io/surface_reader.h"
#include "fill/mesh/quality.h"
#include "run/prepare/input.h"
#include "surface/diagnosis/diagnosis.h"

namespace kerf {

namespace {

const std::string bearing_cap = KERF_ASSETS "/bearing_cap_52k.stl";

void read_stl(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(read_surface(bearing_cap));
}
BENCHMARK(read_stl)->Unit(benchmark::kMillisecond);

void diagnose_surface(benchmark::State& state) {
    const Soup soup = read_surface(bearing_cap);
    for (auto _ : state) benchmark::DoNotOptimize(diagnose(soup));
}
BENCHMARK(diagnose_surface)->Unit(benchmark::kMillisecond);

void decompose_surface(benchmark::State& state) {
    const Input input = read_input(bearing_cap);
    DecomposeOptions options;
    options.parts = static_cast<std::int32_t>(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(decompose(input.complex, options, {0, options.parts}));
}
BENCHMARK(decompose_surface)->ArgName("parts")->Arg(2)->Arg(8)->Unit(benchmark::kMillisecond);

void quality_of_one_tet(benchmark::State& state) {
    Vec3 apex(0.3, 0.2, 0.9);
    for (auto _ : state) {
        benchmark::DoNotOptimize(apex);
        benchmark::DoNotOptimize(tet_quality({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, apex));
    }
}
BENCHMARK(quality_of_one_tet);

// The six tetrahedra of a cube along its diagonal: the axes in the order in which an edge each follows them.
constexpr std::array<std::array<int, 3>, 6> diagonal_paths = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};

// The unit cube in n^3 cubes whose corners are moved a little.
TetMesh uneven_cube(std::int32_t n) {
    const std::int32_t row = n + 1;
    TetMesh mesh;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.2, 0.2);
    for (std::int32_t v = 0; v < row * row * row; ++v) {
        const Vec3 moved(shift(random), shift(random), shift(random));
        mesh.vertices.push_back((Vec3(v / (row * row), v / row % row, v % row) + moved) / n);
    }
    const std::array<std::int32_t, 3> along = {row * row, row, 1};
    for (std::int32_t cube = 0; cube < n * n * n; ++cube)
        for (std::size_t path = 0; path < diagonal_paths.size(); ++path) {
            Tetrahedron tet = {cube / (n * n) * along[0] + cube / n % n * along[1] + cube % n, 0, 0, 0};
            for (std::size_t i = 0; i < 3; ++i) tet[i + 1] = tet[i] + along[diagonal_paths[path][i]];
            if (path >= 3) std::swap(tet[2], tet[3]);
            mesh.tets.push_back(tet);
        }
    return mesh;
}

void quality_of_a_mesh(benchmark::State& state) {
    constexpr std::int32_t cubes_along_an_edge = 87;  // 4 million tetrahedra
    const TetMesh mesh = uneven_cube(cubes_along_an_edge);
    for (auto _ : state) benchmark::DoNotOptimize(measure_quality(mesh, {}, 2));
    state.counters["tets"] = static_cast<double>(mesh.tets.size());
}
BENCHMARK(quality_of_a_mesh)->Unit(benchmark::kMillisecond);

// A ring of facets as wide as the band around a plane: terminals on the rims, capacities that vary along the ring.
void minimum_cut_of_a_band(benchmark::State& state) {
    const auto length = static_cast<std::int32_t>(state.range(0));
    constexpr std::int32_t width = 16;
    const auto node = [=](std::int32_t along, std::int32_t across) { return along % length * width + across; };
    for (auto _ : state) {
        MaxFlow flow(length * width);
        for (std::int32_t i = 0; i < length; ++i) {
            flow.add_terminal(node(i, 0), length, 0);
            flow.add_terminal(node(i, width - 1), 0, length);
            for (std::int32_t j = 0; j < width; ++j) {
                flow.add_edge(node(i, j), node(i + 1, j), 1);
                if (j + 1 < width) flow.add_edge(node(i, j), node(i, j + 1), 1 + (7 * i + 3 * j) % 5);
            }
        }
        benchmark::DoNotOptimize(flow.solve(std::int64_t{2000} * length * width));
    }
}
BENCHMARK(minimum_cut_of_a_band)->ArgName("length")->Arg(500)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace kerf

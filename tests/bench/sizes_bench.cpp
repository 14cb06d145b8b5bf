// What the benchmark of sizes needs: the same surface for all programs, and one measure of what they make of it.
// tests/bench/sizes.py runs it.
//
//     sizes_bench prepare INPUT SURFACE.stl    of a surface, or of a CAD file with - in place of the second
//     sizes_bench measure MESH SIZE            of tetrahedra of any program
//
// Figures are one line of JSON.
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "bench/bench.h"
#include "files/io/stl_writer.h"
#include "files/io/tet_mesh_reader.h"
#include "run/prepare/input.h"

namespace kerf {

namespace {

constexpr double least_ratio = 0.7, most_ratio = 1.4;  // of an edge that obeys, over the size

using Edge = std::array<std::int32_t, 2>;

void prepare(const std::string& path, const std::string& result) {
    const Input input = read_input(path);
    const SurfaceArrays surface = input.complex.arrays();
    if (result != "-") write_stl(result, surface.vertices, surface.facets);
    fmt::print(R"({{"facets": {}, "shells": {}, "diagonal": {}, "volume": {}}})"
               "\n",
               input.facets, input.components, input.diagonal, input.volume);
}

void keep_once(std::vector<Edge>& edges) {
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
}

Edge edge(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

std::vector<Edge> edges_of(const std::vector<Tetrahedron>& tets) {
    std::vector<Edge> edges;
    edges.reserve(6 * tets.size());
    for (const Tetrahedron& t : tets)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) edges.push_back(edge(t[i], t[j]));
    keep_once(edges);
    return edges;
}

// Of the faces that have one tetrahedron alone.
std::vector<Edge> boundary_edges_of(const std::vector<Tetrahedron>& tets) {
    std::vector<std::array<std::int32_t, 3>> faces;
    faces.reserve(4 * tets.size());
    for (const Tetrahedron& t : tets)
        for (int apex = 0; apex < 4; ++apex) {
            auto& face = faces.emplace_back(std::array{t[(apex + 1) % 4], t[(apex + 2) % 4], t[(apex + 3) % 4]});
            std::sort(face.begin(), face.end());
        }
    std::sort(faces.begin(), faces.end());
    std::vector<Edge> edges;
    for (std::size_t i = 0, next = 0; i < faces.size(); i = next) {
        while (next < faces.size() && faces[next] == faces[i]) ++next;
        if (next - i > 1) continue;
        for (int corner = 0; corner < 3; ++corner) edges.push_back(edge(faces[i][corner], faces[i][(corner + 1) % 3]));
    }
    keep_once(edges);
    return edges;
}

std::string lengths_json(const TetMesh& mesh, const std::vector<Edge>& edges, double size) {
    std::vector<double> ratios;
    ratios.reserve(edges.size());
    for (const Edge& e : edges)
        ratios.push_back(
            (mesh.vertices[static_cast<std::size_t>(e[0])] - mesh.vertices[static_cast<std::size_t>(e[1])]).norm() /
            size);
    std::sort(ratios.begin(), ratios.end());
    const auto at = [&](double share) { return ratios[static_cast<std::size_t>(share * double(ratios.size() - 1))]; };
    const auto obey = std::count_if(ratios.begin(), ratios.end(),
                                    [](double ratio) { return ratio >= least_ratio && ratio <= most_ratio; });
    const double count = static_cast<double>(ratios.size());
    return fmt::format(R"({{"count": {}, "share": {}, "mean": {}, "p1": {}, "median": {}, "p99": {}, "p999": {}}})",
                       ratios.size(), static_cast<double>(obey) / count,
                       std::accumulate(ratios.begin(), ratios.end(), 0.0) / count, at(0.01), at(0.5), at(0.99),
                       at(0.999));
}

void measure(const std::string& path, double size) {
    const TetMesh mesh = read_tet_file(path).mesh;
    const std::vector<double> angles = bench::sorted_min_dihedrals(mesh);
    fmt::print(R"({{"cells": {}, "volume": {}, "dihedral_0": {}, "dihedral_1": {}, "surface": {}, "all": {}}})"
               "\n",
               mesh.tets.size(), bench::volume_of(mesh), angles.front(), angles[angles.size() / 100],
               lengths_json(mesh, boundary_edges_of(mesh.tets), size), lengths_json(mesh, edges_of(mesh.tets), size));
}

int run(const std::vector<std::string>& words) {
    if (words.size() != 3) return 2;
    if (words[0] == "prepare")
        prepare(words[1], words[2]);
    else if (words[0] == "measure")
        measure(words[1], std::stod(words[2]));
    else
        return 2;
    return 0;
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) { return kerf::bench::run_by_words(argc, argv, kerf::run); }

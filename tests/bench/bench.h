// What several benchmarks need.
#pragma once

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <exception>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "fill/mesh/quality.h"
#include "surface/complex/surface.h"

namespace kerf::bench {

/// Quarters every facet; the middle of an edge is numbered with its first half-edge.
inline Surface quartered(const Surface& surface) {
    SurfaceArrays fine;
    const std::int32_t old_count = surface.vertex_count();
    for (const Vertex v : surface.vertices()) fine.vertices.push_back(surface.point(v));
    for (const Edge e : surface.edges()) {
        const HalfEdge h = Surface::first_half_edge(e);
        fine.vertices.push_back((surface.point(surface.from_vertex(h)) + surface.point(surface.to_vertex(h))) / 2);
    }
    for (const Facet f : surface.facets()) {
        const Triangle corner = surface.triangle(f);
        const auto h = surface.half_edges(f);
        Triangle middle;
        for (int i = 0; i < 3; ++i) middle[i] = old_count + Surface::edge_of(h[i]).value();
        fine.facets.push_back(middle);
        for (int i = 0; i < 3; ++i) fine.facets.push_back({corner[i], middle[i], middle[(i + 2) % 3]});
    }
    for (std::size_t v = 0; v < fine.vertices.size(); ++v)
        fine.vertex_key.push_back(make_key(input_node, static_cast<std::int32_t>(v)));
    for (std::size_t f = 0; f < fine.facets.size(); ++f)
        fine.facet_key.push_back(make_key(input_node, static_cast<std::int32_t>(f)));
    fine.patch.assign(fine.facets.size(), 0);
    return Surface(std::move(fine));
}

/// A line of /proc/self/status in bytes: VmRSS, the resident set, or VmHWM, the largest since the last reset.
inline double memory_bytes(const std::string& label) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(label + ':')) return 1024 * std::stod(line.substr(label.size() + 1));
    return 0;
}

/// From here on, VmHWM is that of what follows.
inline void forget_process_memory() {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << 5;
}

/// Seconds of the processor that this process has taken, without the system's.
inline double user_seconds() {
    rusage usage = {};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// The smallest dihedral angle of every cell, ascending, in degrees.
inline std::vector<double> sorted_min_dihedrals(const TetMesh& mesh) {
    std::vector<double> angles(mesh.tets.size());
    measure_min_dihedrals(mesh.vertices, mesh.tets, angles);
    std::sort(angles.begin(), angles.end());
    return angles;
}

inline double volume_of(const TetMesh& mesh) {
    long double volume = 0;
    for (const Tetrahedron& t : mesh.tets) {
        const auto p = [&](std::size_t corner) -> const Vec3& {
            return mesh.vertices[static_cast<std::size_t>(t[corner])];
        };
        volume += tet_quality(p(0), p(1), p(2), p(3)).volume;
    }
    return static_cast<double>(volume);
}

/// The main function of a benchmark that is called by words: its exit code, 1 for what `run` throws.
template <class Run>
int run_by_words(int argc, char** argv, const Run& run) {
    try {
        return run(std::vector<std::string>(argv + 1, argv + argc));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}

}  // namespace kerf::bench

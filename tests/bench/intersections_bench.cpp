// Our search for intersecting facets beside CGAL's of pairs of boxes, with the same test of a pair, on the bearing cap
// whose facets are split in 4 and in 16. CPU seconds are those of all threads.
#include <algorithm>
#include <utility>
#include <vector>

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/box_intersection_d.h>
#include <benchmark/benchmark.h>

#include "base/geometry/box.h"
#include "files/io/surface_reader.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

// Each facet in four, at the middles of its edges.
Soup split_in_four(const Soup& soup) {
    Soup fine;
    fine.vertices = soup.vertices;
    std::vector<UndirectedEdge> edges;
    for (const auto& [a, b, c] : soup.facets)
        edges.insert(edges.end(), {undirected(a, b), undirected(b, c), undirected(c, a)});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [a, b] : edges) fine.vertices.push_back((soup.vertices[a] + soup.vertices[b]) / 2);
    const auto middle = [&](std::int32_t a, std::int32_t b) {
        const auto edge = std::lower_bound(edges.begin(), edges.end(), undirected(a, b));
        return static_cast<std::int32_t>(soup.vertices.size()) + static_cast<std::int32_t>(edge - edges.begin());
    };
    for (const auto& [a, b, c] : soup.facets) {
        const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.facets.insert(fine.facets.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    return fine;
}

Soup cap_split_in(std::int64_t pieces) {
    Soup soup = read_surface(KERF_ASSETS "/bearing_cap_52k.stl");
    for (; pieces > 1; pieces /= 4) soup = split_in_four(soup);
    return soup;
}

void intersections_of_kerf(benchmark::State& state) {
    const Soup soup = cap_split_in(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(find_self_intersections(soup.vertices, soup.facets));
    state.counters["facets"] = static_cast<double>(soup.facets.size());
}

using FacetBox = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Triangle*>;

IntersectingPairs found_with_boxes_of_cgal(const Soup& soup) {
    std::vector<FacetBox> boxes;
    boxes.reserve(soup.facets.size());
    for (const Triangle& t : soup.facets) {
        const Box box = box_around(soup.vertices, t);
        const Vec3 &low = box.min(), &high = box.max();
        boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), &t);
    }
    const auto corners = [&](const Triangle& t) {
        return std::array<Vec3, 3>{soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]};
    };
    const auto number = [&](const Triangle& t) { return static_cast<std::int32_t>(&t - soup.facets.data()); };
    IntersectingPairs pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const FacetBox& a, const FacetBox& b) {
        const Triangle &s = *a.handle(), &t = *b.handle();
        if (triangles_intersect(corners(s), s, corners(t), t)) pairs.push_back(std::minmax(number(s), number(t)));
    });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

void intersections_of_cgal(benchmark::State& state) {
    const Soup soup = cap_split_in(state.range(0));
    for (auto _ : state) benchmark::DoNotOptimize(found_with_boxes_of_cgal(soup));
    state.counters["facets"] = static_cast<double>(soup.facets.size());
}

void pieces_of_a_facet(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgName("pieces")->Arg(4)->Arg(16)->MeasureProcessCPUTime()->UseRealTime()->Unit(
        benchmark::kMillisecond);
}
BENCHMARK(intersections_of_kerf)->Apply(pieces_of_a_facet);
BENCHMARK(intersections_of_cgal)->Apply(pieces_of_a_facet);

}  // namespace

}  // namespace kerf

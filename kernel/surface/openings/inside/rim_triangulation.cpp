// A rim is triangulated in one of three ways. In its plane, by a constrained Delaunay triangulation, if it is planar,
// or long and nearly planar. By dynamic programming over the largest angle between neighbours if it has at most 100
// vertices (Liepa 2003, liepa2003; surface/openings/hole_triangulation.h), which takes O(n^3). A longer one is
// divided at a short chord, and its halves are triangulated likewise; each half has a vertex of the other as the apex
// beyond the chord, so that the two bend little there. Triangles name positions in the whole rim. A band between two
// rims is made by a walk along both that takes the shorter diagonal each time.
#include "surface/openings/inside/rim_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/box.h"
#include "surface/openings/hole_triangulation.h"
#include "surface/soup/facet_triangulation.h"

namespace kerf {

namespace {

// Triangulates the rim as it lies in its plane.
std::vector<Triangle> span_in_plane(const std::vector<Vec3>& rim, const RimPlane& plane) {
    const Vec3 x = plane.normal.unitOrthogonal(), y = plane.normal.cross(x);
    std::vector<Vec3> flat;
    PolygonalFacet facet{{{}}, {}};
    for (const Vec3& p : rim) {
        facet.polygons[0].push_back(std::ssize(flat));
        flat.emplace_back(x.dot(p - plane.centre), y.dot(p - plane.centre), 0);
    }
    std::vector<Triangle> triangles = triangulate_facet(flat, facet).triangles;
    if (triangles.size() + 2 != rim.size()) triangles.clear();  // vertices in one place
    return triangles;
}

// The ends of the shortest chord with at least a quarter of the rim on either side.
std::pair<std::size_t, std::size_t> shortest_chord(const std::vector<Vec3>& rim) {
    constexpr std::size_t most_tried = 2000;
    const std::size_t n = rim.size(), stride = 1 + n / most_tried;
    std::pair<std::size_t, std::size_t> best{0, n / 2};
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < n; i += stride)
        for (std::size_t j = i + n / 4; j < n && j - i <= n - n / 4; j += stride) {
            const double squared = (rim[i] - rim[j]).squaredNorm();
            if (squared >= shortest) continue;
            shortest = squared;
            best = {i, j};
        }
    return best;
}

std::vector<Triangle> span_divided(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes) {
    const std::size_t n = rim.size();
    const auto [i, j] = shortest_chord(rim);
    std::vector<Triangle> triangles;
    for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i + n)}) {
        std::vector<Vec3> half, beside;
        for (std::size_t k = from; k <= to; ++k) half.push_back(rim[k % n]);
        for (std::size_t k = from; k < to; ++k) beside.push_back(apexes[k % n]);
        beside.push_back(rim[((to + n / 8) % n)]);  // beyond the chord: a vertex of the other half
        for (Triangle t : triangulate_rim(half, beside)) {
            for (std::int32_t& v : t) v = (from + v) % n;
            triangles.push_back(t);
        }
    }
    return triangles;
}

}  // namespace

RimPlane rim_plane(const std::vector<Vec3>& rim) {
    RimPlane plane;
    for (const Vec3& p : rim) plane.centre += p / rim.size();
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < rim.size(); ++i)
        sum += (rim[i] - plane.centre).cross(rim[(i + 1) % rim.size()] - plane.centre);
    plane.area = sum.norm() / 2;
    const double width = box_around(rim).diagonal().norm();
    constexpr double nothing = 1e-12;
    if (plane.area <= nothing * width * width) return plane;
    plane.normal = sum.normalized();
    for (const Vec3& p : rim) plane.height = std::max(plane.height, std::abs(plane.normal.dot(p - plane.centre)));
    return plane;
}

bool is_planar(const RimPlane& plane, const std::vector<Vec3>& rim) {
    constexpr double rounding = 1e-6;
    return !plane.normal.isZero() && plane.height <= rounding * box_around(rim).diagonal().norm();
}

std::vector<Triangle> triangulate_rim(const std::vector<Vec3>& rim, const std::vector<Vec3>& apexes) {
    constexpr std::size_t most_spanned = 100;
    constexpr double nearly_planar = 0.1;  // of the width
    if (rim.size() < 3) return {};
    const RimPlane plane = rim_plane(rim);
    const bool is_long = rim.size() > most_spanned;
    if (rim.size() > 3 && (is_planar(plane, rim) || (is_long && !plane.normal.isZero() &&
                                                     plane.height < nearly_planar * box_around(rim).diagonal().norm())))
        if (std::vector<Triangle> triangles = span_in_plane(rim, plane); !triangles.empty()) return triangles;
    return is_long ? span_divided(rim, apexes) : triangulate_hole(rim, apexes);
}

std::vector<Triangle> triangulate_band(const std::vector<Vec3>& first, const std::vector<Vec3>& second) {
    const std::size_t n = first.size(), m = second.size();
    std::size_t from = 0, to = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < m; ++j)
            if ((first[i] - second[j]).squaredNorm() < (first[from] - second[to]).squaredNorm()) from = i, to = j;
    std::vector<Triangle> triangles;
    for (std::size_t i = 0, j = 0; i < n || j < m;) {  // goes along the second one backwards
        const std::size_t a = (from + i) % n, next_a = (a + 1) % n, b = (to + m - j % m) % m, next_b = (b + m - 1) % m;
        const double by_first = (first[next_a] - second[b]).squaredNorm();
        const double by_second = (first[a] - second[next_b]).squaredNorm();
        const bool goes_on_first = j == m || (i < n && by_first <= by_second);
        const std::int32_t at_a = a, at_b = n + b, next = goes_on_first ? next_a : n + next_b;
        triangles.push_back({at_a, next, at_b});
        (goes_on_first ? i : j) += 1;
    }
    return triangles;
}

}  // namespace kerf

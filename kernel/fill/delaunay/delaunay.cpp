// All points are inserted one after another (fill/delaunay/spatial_triangulation.h), in an order in which each lies
// near the one before. They are kept in that order meanwhile, so that memory that is needed next is in the cache; at
// the end vertices get the numbers of their points. The first cell is made of the first four points of the order that
// do not lie in one plane.
#include "fill/delaunay/delaunay.h"

#include <algorithm>
#include <numeric>

#include "base/geometry/predicates.h"
#include "fill/delaunay/inside/spatial_order.h"

namespace kerf {

namespace {

// Moves four points that do not lie in one plane to the front, as a positive tetrahedron. Returns false if there are
// none.
bool put_tetrahedron_first(std::vector<std::int32_t>& order, const std::vector<Vec3>& points) {
    const auto point = [&](std::size_t i) -> const Vec3& { return points[order[i]]; };
    std::size_t found = 0;
    const auto fits = [&](const Vec3& p) {
        if (found < 2) return found == 0 || p != point(0);
        return found == 2 ? !are_collinear(point(0), point(1), p) : orientation(point(0), point(1), point(2), p) != 0;
    };
    for (std::size_t i = 0; i < order.size() && found < 4; ++i) {
        if (!fits(points[order[i]])) continue;
        const auto start = order.begin() + found++;
        const auto here = order.begin() + i;
        std::rotate(start, here, here + 1);
    }
    if (found < 4) return false;
    if (orientation(point(0), point(1), point(2), point(3)) < 0) std::swap(order[0], order[1]);
    return true;
}

// Finds equal points by sorting, where no triangulation does.
std::vector<std::int32_t> representatives_by_sorting(const std::vector<Vec3>& points) {
    std::vector<std::int32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t v, std::int32_t w) { return lexicographically_less(points[v], points[w]); });
    std::vector<std::int32_t> representative(points.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_first = i == 0 || points[order[i]] != points[order[i - 1]];
        representative[order[i]] = is_first ? order[i] : representative[order[i - 1]];
    }
    return representative;
}

SpatialTriangulation first_cells(const std::vector<std::int32_t>& order, const std::vector<Vec3>& points) {
    return SpatialTriangulation({points[order[0]], points[order[1]], points[order[2]], points[order[3]]});
}

// Inserts all points behind the first four, and returns the vertex of each point.
std::vector<std::int32_t> insert_all(SpatialTriangulation& triangulation, const std::vector<std::int32_t>& order,
                                     const std::vector<Vec3>& points) {
    std::vector<std::int32_t> vertex(points.size());
    for (std::int32_t i = 0; i < 4; ++i) vertex[order[i]] = i;
    for (std::size_t i = 4; i < order.size(); ++i) vertex[order[i]] = triangulation.insert(points[order[i]]);
    return vertex;
}

}  // namespace

Delaunay delaunay(std::vector<Vec3> points) {
    std::vector<std::int32_t> order = insertion_order(points);
    if (!put_tetrahedron_first(order, points)) return {{}, representatives_by_sorting(points)};
    Delaunay result{first_cells(order, points), {}};
    result.triangulation.reserve(points.size());
    const std::vector<std::int32_t> vertex = insert_all(result.triangulation, order, points);
    order = {};

    std::vector<std::int32_t> number(result.triangulation.points().size(), SpatialTriangulation::none);
    result.representative.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::int32_t& first = number[vertex[i]];
        if (first == SpatialTriangulation::none) first = i;
        result.representative[i] = first;
    }
    result.triangulation.renumber(number, std::move(points));
    return result;
}

}  // namespace kerf

#include "support/point_sets.h"

#include <algorithm>
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include "fill/delaunay/spatial_triangulation.h"

namespace kerf::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class Change>
std::vector<Vec3> changed(std::vector<Vec3> points, Change change) {
    for (Vec3& p : points) p = change(p);
    return points;
}

std::vector<Vec3> joined(std::vector<Vec3> points, const std::vector<Vec3>& more) {
    points.insert(points.end(), more.begin(), more.end());
    return points;
}

std::vector<Vec3> integers_on_spheres(int radius_sq) {
    std::vector<Vec3> points;
    constexpr int most = 11;
    for (int x = -most; x <= most; ++x)
        for (int y = -most; y <= most; ++y)
            for (int z = -most; z <= most; ++z)
                if (x * x + y * y + z * z == radius_sq) points.emplace_back(x, y, z);
    return points;
}

// Every vertex of its triangulation has many neighbours, and as many cells.
std::vector<Vec3> moment_curve(int count) {
    std::vector<Vec3> points;
    for (int t = -count / 2; t < count - count / 2; ++t) points.emplace_back(t, t * t, double(t) * t * t);
    return points;
}

Kernel::Point_3 point_of(const Vec3& p) { return {p[0], p[1], p[2]}; }

}  // namespace

std::vector<Vec3> random_points(std::mt19937& random, std::size_t count) {
    constexpr double scale = 0x1p-32;
    std::vector<Vec3> points(count);
    for (Vec3& p : points)
        for (double& x : p) x = scale * random() + scale * scale * random();
    return points;
}

std::vector<Vec3> lattice(int n, double edge, bool is_centred) {
    std::vector<Vec3> points;
    for (int x = 0; x <= n; ++x)
        for (int y = 0; y <= n; ++y)
            for (int z = 0; z <= n; ++z) {
                points.emplace_back(x * edge, y * edge, z * edge);
                if (is_centred && std::max({x, y, z}) < n)
                    points.emplace_back((x + 0.5) * edge, (y + 0.5) * edge, (z + 0.5) * edge);
            }
    return points;
}

std::vector<PointSet> point_sets() {
    constexpr unsigned seed = 16;
    std::mt19937 random(seed);
    const auto uniform = [&](std::size_t count) { return random_points(random, count); };
    const auto in_plane = [](const Vec3& p) { return Vec3(p[0], p[1], 0); };
    const auto on_line = [](const Vec3& p) { return Vec3(p[0], 2 * p[0], -p[0]); };
    const auto of_any_size = [](const Vec3& p) -> Vec3 { return (40 * p.array() - 20).exp(); };
    const auto coarse = [](const Vec3& p) -> Vec3 { return (4 * p).array().floor(); };
    return {
        {"random", uniform(2000)},
        {"four", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {"four, negative", {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}}},
        {"cubes", lattice(7, 1, false)},
        {"cubes, not exact",
         changed(lattice(6, 0.37, false), [](const Vec3& p) { return Vec3(p + Vec3(0.1, 0.2, 1e3)); })},
        {"centred cubes", lattice(6, 1, true)},
        {"centred cubes, not exact", lattice(6, 0.1, true)},
        {"jittered cubes",
         joined(lattice(5, 1, true),
                changed(lattice(5, 1, true), [&](const Vec3& p) { return Vec3(p + 1e-9 * uniform(1)[0]); }))},
        {"integers on spheres", joined(integers_on_spheres(81), integers_on_spheres(49))},
        {"sphere", changed(uniform(500), [](const Vec3& p) { return Vec3((p - Vec3(0.5, 0.5, 0.5)).normalized()); })},
        {"sphere and its centre", joined(integers_on_spheres(101), {{0, 0, 0}})},
        {"moment curve", moment_curve(180)},
        {"half in a plane", joined(changed(uniform(400), in_plane), uniform(400))},
        {"grid in a plane and one point", joined(changed(lattice(7, 1, false), in_plane), {{3, 3, 1}})},
        {"half on a line", joined(changed(uniform(200), on_line), uniform(200))},
        {"almost in a plane", changed(uniform(500), [](const Vec3& p) { return Vec3(p[0], p[1], 1e-15 * p[2]); })},
        {"duplicates", changed(uniform(900), coarse)},
        {"far away", changed(uniform(500), [](const Vec3& p) { return Vec3(p + Vec3(1e9, -3e9, 1e10)); })},
        {"tiny", changed(uniform(500), [](const Vec3& p) { return Vec3(1e-60 * p); })},
        {"tiny cubes", lattice(5, 1e-60, true)},
        {"huge cubes", lattice(5, 1e60, true)},
        {"of any size", changed(uniform(500), of_any_size)},
        {"flat: nothing", {}},
        {"flat: three", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
        {"flat: one point", std::vector<Vec3>(9, Vec3(1, 2, 3))},
        {"flat: line", changed(uniform(100), on_line)},
        {"flat: plane", changed(uniform(300), [](const Vec3& p) { return Vec3(p[0], p[1], p[0]); })},
        {"flat: grid", changed(lattice(5, 1, false), in_plane)},
    };
}

CellPoints sorted_corners(const std::array<Vec3, 4>& corners) {
    CellPoints points;
    for (int i = 0; i < 4; ++i) points[i] = {corners[i][0], corners[i][1], corners[i][2]};
    std::sort(points.begin(), points.end());
    return points;
}

std::vector<CellPoints> sorted_cells(const SpatialTriangulation& triangulation) {
    std::vector<CellPoints> cells;
    for (const CellId cell : triangulation.cells()) {
        if (triangulation.is_ghost(cell)) continue;
        std::array<Vec3, 4> corners;
        for (int i = 0; i < 4; ++i) corners[i] = triangulation.points()[triangulation.vertices(cell)[i]];
        cells.push_back(sorted_corners(corners));
    }
    std::sort(cells.begin(), cells.end());
    return cells;
}

void expect_valid(const SpatialTriangulation& triangulation) {
    const auto point = [&](std::int32_t v) { return point_of(triangulation.points()[v]); };
    std::vector<bool> has_cell(triangulation.points().size());
    for (const CellId cell : triangulation.cells()) {
        const Tetrahedron& v = triangulation.vertices(cell);
        for (int i = 0; i < 4; ++i) {
            const CellFace face = cell_face(cell, i), behind = triangulation.mirror(face);
            ASSERT_EQ(triangulation.mirror(behind), face);
            ASSERT_NE(cell_of(behind), cell);
            ASSERT_EQ(triangulation.is_constrained(face), triangulation.is_constrained(behind));
            for (int k = 1; k < 4; ++k)
                ASSERT_LT(index_of(triangulation.vertices(cell_of(behind)), v[i ^ k]), 4) << "of the same face";
            ASSERT_EQ(index_of(triangulation.vertices(cell_of(behind)), v[i]), 4);
            ASSERT_EQ(v[i] == SpatialTriangulation::ghost, i == 3 && triangulation.is_ghost(cell));
            if (v[i] >= 0) has_cell[v[i]] = true;
        }
        if (triangulation.is_ghost(cell)) {
            const std::int32_t inner = triangulation.opposite_vertex(triangulation.mirror(cell_face(cell, 3)));
            ASSERT_EQ(CGAL::orientation(point(v[0]), point(v[1]), point(v[2]), point(inner)), CGAL::NEGATIVE);
        } else {
            ASSERT_EQ(CGAL::orientation(point(v[0]), point(v[1]), point(v[2]), point(v[3])), CGAL::POSITIVE);
        }
    }
    for (std::size_t v = 0; v < has_cell.size(); ++v) {
        const CellId cell = triangulation.cell_at(static_cast<std::int32_t>(v));
        ASSERT_EQ(has_cell[v], cell.is_valid());
        if (has_cell[v]) {
            ASSERT_LT(index_of(triangulation.vertices(cell), static_cast<std::int32_t>(v)), 4);
        }
    }
}

// Spheres are empty if none has the vertex behind a face inside; the hull is convex if no face has the one behind an
// edge beyond it.
void expect_delaunay(const SpatialTriangulation& triangulation) {
    const auto point = [&](std::int32_t v) { return point_of(triangulation.points()[v]); };
    for (const CellId cell : triangulation.cells())
        for (int i = 0; i < 4; ++i) {
            const std::int32_t behind = triangulation.opposite_vertex(triangulation.mirror(cell_face(cell, i)));
            const Tetrahedron& v = triangulation.vertices(cell);
            if (behind == SpatialTriangulation::ghost) continue;
            if (!triangulation.is_ghost(cell)) {
                ASSERT_NE(
                    CGAL::side_of_oriented_sphere(point(v[0]), point(v[1]), point(v[2]), point(v[3]), point(behind)),
                    CGAL::ON_POSITIVE_SIDE);
            } else {
                ASSERT_NE(CGAL::orientation(point(v[0]), point(v[1]), point(v[2]), point(behind)), CGAL::POSITIVE);
            }
        }
}

}  // namespace kerf::test

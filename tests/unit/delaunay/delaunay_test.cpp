#include "fill/delaunay/delaunay.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fill/delaunay/inside/spatial_order.h"
#include "support/point_sets.h"

namespace kerf {
namespace {

using test::CellPoints;
using test::PointSet;

// It decides ties as we do.
std::vector<CellPoints> sorted_cells_of_cgal(const std::vector<Vec3>& points) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    CGAL::Delaunay_triangulation_3<Kernel> triangulation;
    std::vector<Kernel::Point_3> copies;
    for (const Vec3& p : points) copies.emplace_back(p[0], p[1], p[2]);
    triangulation.insert(copies.begin(), copies.end());
    std::vector<CellPoints> cells;
    if (triangulation.dimension() < 3) return cells;
    for (const auto cell : triangulation.finite_cell_handles()) {
        std::array<Vec3, 4> corners;
        for (int i = 0; i < 4; ++i) {
            const Kernel::Point_3& p = cell->vertex(i)->point();
            corners[i] = {p[0], p[1], p[2]};
        }
        cells.push_back(test::sorted_corners(corners));
    }
    std::sort(cells.begin(), cells.end());
    return cells;
}

std::vector<CellPoints> sorted_cells_of(const std::vector<Vec3>& points) {
    return test::sorted_cells(delaunay(points).triangulation);
}

TEST(Delaunay, HasEmptySpheresAndAConvexHull) {
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        const SpatialTriangulation triangulation = delaunay(points).triangulation;
        EXPECT_EQ(triangulation.cell_count() == 0, name.starts_with("flat"));
        test::expect_valid(triangulation);
        test::expect_delaunay(triangulation);
    }
}

TEST(Delaunay, HasTheCellsOfCgal) {
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        const std::vector<CellPoints> cells = sorted_cells_of(points);
        EXPECT_TRUE(std::adjacent_find(cells.begin(), cells.end()) == cells.end());
        EXPECT_TRUE(cells == sorted_cells_of_cgal(points));
    }
}

TEST(Delaunay, FillsTheHull) {
    for (const bool is_centred : {false, true}) {
        const SpatialTriangulation triangulation = delaunay(test::lattice(6, 0.25, is_centred)).triangulation;
        double volume = 0;
        for (const CellId cell : triangulation.cells()) {
            if (triangulation.is_ghost(cell)) continue;
            const auto [a, b, c, d] = triangulation.vertices(cell);
            const std::vector<Vec3>& p = triangulation.points();
            volume += (p[b] - p[a]).dot((p[c] - p[a]).cross(p[d] - p[a])) / 6;
        }
        EXPECT_NEAR(volume, 1.5 * 1.5 * 1.5, 1e-12);
    }
}

TEST(Delaunay, DependsOnPointsAndNotOnTheirOrder) {
    constexpr unsigned seed = 5;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    for (auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        const std::vector<CellPoints> cells = sorted_cells_of(points);
        for (int i = 0; i < 2; ++i) {
            std::shuffle(points.begin(), points.end(), random);
            EXPECT_TRUE(sorted_cells_of(points) == cells);
        }
    }
}

TEST(Delaunay, KeepsItsCellsWhenScaledByPowersOfTwo) {
    const auto scaled = [](std::vector<Vec3> points, double by) {
        for (Vec3& p : points) p *= by;
        return points;
    };
    for (const PointSet& set : test::point_sets()) {
        SCOPED_TRACE(set.name);
        if (set.name.starts_with("huge") || set.name.starts_with("tiny")) continue;
        const Delaunay original = delaunay(set.points);
        for (const double by : {0x1p-150, 0x1p-20, 0x1p100}) {
            const Delaunay other = delaunay(scaled(set.points, by));
            ASSERT_EQ(other.triangulation.cell_count(), original.triangulation.cell_count());
            for (const CellId cell : other.triangulation.cells())
                ASSERT_EQ(other.triangulation.vertices(cell), original.triangulation.vertices(cell));
        }
    }
}

TEST(Delaunay, NumbersVerticesAsItsPoints) {
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        const auto [triangulation, representative] = delaunay(points);
        ASSERT_EQ(representative.size(), points.size());
        std::map<std::array<double, 3>, std::int32_t> first;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto number = static_cast<std::int32_t>(i);
            const auto known = first.emplace(std::array{points[i][0], points[i][1], points[i][2]}, number).first;
            ASSERT_EQ(representative[i], known->second);
            if (name.starts_with("flat")) continue;
            ASSERT_EQ(triangulation.points()[i], points[i]);
            ASSERT_EQ(triangulation.cell_at(number).is_valid(), representative[i] == number);
        }
    }
}

TEST(InsertionOrder, HasEveryPointOnce) {
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        std::vector<std::int32_t> order = insertion_order(points), all(points.size());
        std::iota(all.begin(), all.end(), 0);
        std::sort(order.begin(), order.end());
        EXPECT_EQ(order, all);
    }
}

// Most steps of a random order are half as long as the cube; those along a curve, as the points are near.
TEST(InsertionOrder, GoesFromNeighbourToNeighbour) {
    std::mt19937 random(1);
    const std::vector<Vec3> points = test::random_points(random, 8000);
    const std::vector<std::int32_t> order = insertion_order(points);
    double length = 0;
    for (std::size_t i = 4001; i < order.size(); ++i) length += (points[order[i]] - points[order[i - 1]]).norm();
    EXPECT_LT(length / 4000, 0.1);
}

TEST(HilbertCode, VisitsEveryCellOnceAndStepsToNeighbours) {
    constexpr std::uint32_t bits = 4, row = 1 << bits;
    std::vector<std::array<std::uint32_t, 3>> cells(row * row * row, {row, row, row});
    for (std::uint32_t i = 0; i < cells.size(); ++i) {
        const std::array cell = {i % row, i / row % row, i / row / row};
        const std::uint64_t code = hilbert_code(cell, bits);
        ASSERT_LT(code, cells.size());
        ASSERT_EQ(cells[code][0], row) << "visited twice";
        cells[code] = cell;
    }
    for (std::size_t i = 1; i < cells.size(); ++i) {
        std::uint32_t distance = 0;
        for (int axis = 0; axis < 3; ++axis)
            distance += std::max(cells[i][axis], cells[i - 1][axis]) - std::min(cells[i][axis], cells[i - 1][axis]);
        ASSERT_EQ(distance, 1U);
    }
}

}  // namespace
}  // namespace kerf

// Triangulations point by point, walks, stars, and faces that stay.
#include "fill/delaunay/spatial_triangulation.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/geometry/predicates.h"
#include "fill/delaunay/delaunay.h"
#include "support/point_sets.h"

namespace kerf {
namespace {

constexpr unsigned insertion_seed = 3;

using Corners = std::array<std::int32_t, 3>;

Corners sorted_corners_of(const SpatialTriangulation& triangulation, CellFace face) {
    const Tetrahedron& v = triangulation.vertices(cell_of(face));
    const int i = index_in_cell(face);
    Corners corners = {v[i ^ 1], v[i ^ 2], v[i ^ 3]};
    std::sort(corners.begin(), corners.end());
    return corners;
}

std::vector<CellFace> inner_faces(const SpatialTriangulation& triangulation) {
    std::vector<CellFace> faces;
    for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face)
        if (!triangulation.is_ghost(cell_of(face)) && face < triangulation.mirror(face)) faces.push_back(face);
    return faces;
}

std::set<Corners> constrained_faces(const SpatialTriangulation& triangulation) {
    std::set<Corners> faces;
    for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face)
        if (triangulation.is_constrained(face)) faces.insert(sorted_corners_of(triangulation, face));
    return faces;
}

// All there is to see of it.
struct Snapshot {
    std::size_t points;
    std::vector<std::int32_t> numbers;
    bool operator==(const Snapshot&) const = default;
};

Snapshot snapshot(const SpatialTriangulation& triangulation) {
    Snapshot seen{triangulation.points().size(), {}};
    for (const CellId cell : triangulation.cells())
        for (int i = 0; i < 4; ++i) {
            const CellFace face = cell_face(cell, i);
            seen.numbers.insert(seen.numbers.end(), {triangulation.vertices(cell)[i], triangulation.mirror(face),
                                                     triangulation.is_constrained(face)});
        }
    for (std::size_t v = 0; v < seen.points; ++v)
        seen.numbers.push_back(triangulation.cell_at(static_cast<std::int32_t>(v)).value());
    return seen;
}

// Whether p is in the closed cell, or strictly beyond the face of a ghost cell.
bool is_in(const SpatialTriangulation& triangulation, CellId cell, const Vec3& p) {
    const std::vector<Vec3>& points = triangulation.points();
    const Tetrahedron& v = triangulation.vertices(cell);
    if (triangulation.is_ghost(cell)) return orientation(points[v[0]], points[v[1]], points[v[2]], p) > 0;
    for (int i = 0; i < 4; ++i) {
        std::array<Vec3, 4> corners = {points[v[0]], points[v[1]], points[v[2]], points[v[3]]};
        corners[i] = p;
        if (orientation(corners[0], corners[1], corners[2], corners[3]) < 0) return false;
    }
    return true;
}

bool lies_on(const SpatialTriangulation& triangulation, CellFace face, const Vec3& p) {
    const std::vector<Vec3>& points = triangulation.points();
    const Corners v = sorted_corners_of(triangulation, face);
    return orientation(points[v[0]], points[v[1]], points[v[2]], p) == 0 && is_in(triangulation, cell_of(face), p);
}

// With constrained faces.
bool must_be_refused(const SpatialTriangulation& triangulation, const Vec3& p) {
    for (const CellId cell : triangulation.cells())
        for (int i = 0; i < 4; ++i) {
            if (triangulation.is_ghost(cell)) continue;
            const CellFace face = cell_face(cell, i);
            const bool is_fixed =
                triangulation.is_constrained(face) || triangulation.is_ghost(cell_of(triangulation.mirror(face)));
            if (is_fixed && lies_on(triangulation, face, p)) return true;
        }
    return triangulation.is_ghost(triangulation.locate(p, CellId(0)));
}

bool is_vertex(const SpatialTriangulation& triangulation, const Vec3& p) {
    const std::vector<Vec3>& points = triangulation.points();
    return std::find(points.begin(), points.end(), p) != points.end();
}

struct Case {
    std::string name;
    SpatialTriangulation triangulation;
};

// Of all point sets that have cells.
std::vector<Case> cases() {
    std::vector<Case> cases;
    for (const auto& [name, points] : test::point_sets())
        if (!name.starts_with("flat")) cases.push_back({name, delaunay(points).triangulation});
    return cases;
}

TEST(SpatialTriangulation, GrowsPointByPointToTheSameCells) {
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(name);
        const SpatialTriangulation all = delaunay(points).triangulation;
        if (all.cell_count() == 0) continue;
        CellId first;
        while (all.is_ghost(first)) ++first;
        const auto [a, b, c, d] = all.vertices(first);
        SpatialTriangulation triangulation({points[a], points[b], points[c], points[d]});
        CellId hint = CellId::none();
        for (const Vec3& p : points) {
            const std::int32_t vertex = triangulation.insert(p, hint);
            ASSERT_EQ(triangulation.points()[vertex], p);
            hint = triangulation.cell_at(vertex);
            ASSERT_EQ(triangulation.insert(p), vertex) << "a second time";
        }
        EXPECT_TRUE(test::sorted_cells(triangulation) == test::sorted_cells(all));
    }
}

TEST(SpatialTriangulation, LocatesPoints) {
    SCOPED_TRACE(testing::Message() << "seed " << insertion_seed);
    std::mt19937 random(insertion_seed);
    for (const auto& [name, triangulation] : cases()) {
        SCOPED_TRACE(name);
        const std::vector<Vec3>& points = triangulation.points();
        const auto count = static_cast<std::uint32_t>(triangulation.cell_count());
        const auto some_point = [&] { return points[random() % points.size()]; };
        for (int i = 0; i < 300; ++i) {
            const Vec3 a = some_point(), b = some_point();
            const std::array<Vec3, 5> queries = {a, (a + b) / 2, 2 * a - b, (a + b + some_point()) / 3,
                                                 Vec3(a[0], b[1], some_point()[2])};
            const Vec3& p = queries[static_cast<std::size_t>(i) % queries.size()];
            const CellId cell = triangulation.locate(p, CellId(random() % count));
            ASSERT_TRUE(is_in(triangulation, cell, p));
        }
    }
}

TEST(SpatialTriangulation, FindsTheCellsAroundVertices) {
    for (auto& [name, triangulation] : cases()) {
        SCOPED_TRACE(name);
        std::vector<std::vector<CellId>> around(triangulation.points().size());
        for (const CellId cell : triangulation.cells())
            for (const std::int32_t v : triangulation.vertices(cell))
                if (v >= 0) around[v].push_back(cell);
        for (std::size_t v = 0; v < around.size(); ++v) {
            if (around[v].empty()) continue;
            std::vector<CellId> found = triangulation.cells_around_vertex(static_cast<std::int32_t>(v));
            std::sort(found.begin(), found.end());
            ASSERT_EQ(found, around[v]);
        }
        test::expect_valid(triangulation);
    }
}

TEST(SpatialTriangulation, TurnsAroundEdges) {
    for (const auto& [name, triangulation] : cases()) {
        SCOPED_TRACE(name);
        std::map<UndirectedEdge, std::int32_t> cells_at;
        for (const CellId cell : triangulation.cells())
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j)
                    ++cells_at[undirected(triangulation.vertices(cell)[i], triangulation.vertices(cell)[j])];
        const std::vector<Vec3>& points = triangulation.points();
        for (int number = 0; number < triangulation.cell_count(); number += 7) {
            const CellId cell(number);
            const int i = number % 4, j = (i + 1 + number / 4 % 3) % 4;
            const std::int32_t from = triangulation.vertices(cell)[i], to = triangulation.vertices(cell)[j];
            EdgeRing ring;
            ASSERT_TRUE(find_ring(triangulation, cell, i, j, ring));
            const std::vector<CellId>& cells = ring.cells;
            ASSERT_EQ(cells[0], cell);
            ASSERT_EQ(static_cast<std::int32_t>(cells.size()), cells_at.at(undirected(from, to)));
            ASSERT_EQ(std::set(cells.begin(), cells.end()).size(), cells.size());
            for (std::size_t k = 0; k < cells.size(); ++k) {
                const CellId next = cells[(k + 1) % cells.size()];
                ASSERT_LT(index_of(triangulation.vertices(cells[k]), from), 4);
                ASSERT_LT(index_of(triangulation.vertices(cells[k]), to), 4);
                std::vector<std::int32_t> order;  // that of the cell which is left, then that of both
                for (const std::int32_t v : triangulation.vertices(cells[k]))
                    if (v != from && v != to) order.push_back(v);
                if (index_of(triangulation.vertices(next), order[0]) < 4) std::swap(order[0], order[1]);
                ASSERT_LT(index_of(triangulation.vertices(next), order[1]), 4);
                if (from < 0 || triangulation.is_ghost(cells[k])) continue;
                ASSERT_EQ(orientation(points[from], points[to], points[order[0]], points[order[1]]), 1);
            }
        }
    }
}

// Constrains some faces, inserts points in special position to them and elsewhere.
TEST(SpatialTriangulation, KeepsConstrainedFacesAndRefusesWithoutAChange) {
    SCOPED_TRACE(testing::Message() << "seed " << insertion_seed);
    std::mt19937 random(insertion_seed);
    int inserted = 0, refused = 0;
    for (auto& [name, triangulation] : cases()) {
        SCOPED_TRACE(name);
        const std::vector<CellFace> faces = inner_faces(triangulation);
        for (std::size_t k = 0; k < faces.size(); k += 20) triangulation.constrain(faces[k]);
        const std::set<Corners> constrained = constrained_faces(triangulation);
        ASSERT_EQ(constrained.size(), (faces.size() + 19) / 20);
        for (int i = 0; i < 40; ++i) {
            const auto corners =
                triangulation.vertices(CellId(random() % static_cast<std::uint32_t>(triangulation.cell_count())));
            const auto point = [&](int k) -> Vec3 { return triangulation.points()[std::max(corners[k], 0)]; };
            const std::array<Vec3, 4> candidates = {(point(0) + point(1) + point(2) + point(3)) / 4,
                                                    (point(0) + point(1) + 2 * point(2)) / 4, (point(2) + point(3)) / 2,
                                                    3 * point(0) - 2 * point(1)};
            const Vec3& p = candidates[static_cast<std::size_t>(i) % 4];
            const Snapshot before = snapshot(triangulation);
            const bool is_refused = !is_vertex(triangulation, p) && must_be_refused(triangulation, p);
            const std::int32_t vertex = triangulation.insert(p);
            ASSERT_EQ(vertex == SpatialTriangulation::none, is_refused);
            vertex == SpatialTriangulation::none ? ++refused : ++inserted;
            if (vertex == SpatialTriangulation::none || vertex < static_cast<std::int32_t>(before.points)) {
                ASSERT_TRUE(snapshot(triangulation) == before);
            } else {
                ASSERT_EQ(triangulation.points()[vertex], p);
                ASSERT_TRUE(triangulation.cell_at(vertex).is_valid());
            }
        }
        ASSERT_TRUE(constrained_faces(triangulation) == constrained);
        test::expect_valid(triangulation);
    }
    EXPECT_GT(inserted, 200);
    EXPECT_GT(refused, 200);
}

// A square in a plane, constrained, in the middle of a grid.
TEST(SpatialTriangulation, RefusesPointsOnConstrainedFacesAndOnTheHull) {
    SpatialTriangulation triangulation = delaunay(test::lattice(4, 1, false)).triangulation;
    for (const CellFace face : inner_faces(triangulation)) {
        const Corners corners = sorted_corners_of(triangulation, face);
        const auto is_in_square = [&](std::int32_t v) { return triangulation.points()[v][2] == 2; };
        if (std::all_of(corners.begin(), corners.end(), is_in_square)) triangulation.constrain(face);
    }
    const std::set<Corners> square = constrained_faces(triangulation);
    EXPECT_EQ(square.size(), 32U);
    for (const Vec3& p : {Vec3(1.25, 1.5, 2), Vec3(1.5, 1.5, 2), Vec3(1.5, 3, 2), Vec3(1.25, 1.5, 0), Vec3(5, 5, 5)})
        EXPECT_EQ(triangulation.insert(p), SpatialTriangulation::none);
    for (const Vec3& p : {Vec3(1.25, 1.5, 1.75), Vec3(1.25, 1.5, 2.25), Vec3(1.25, 1.5, 1.5), Vec3(2.5, 2, 1)})
        EXPECT_GE(triangulation.insert(p), 125);
    EXPECT_EQ(triangulation.insert({2, 2, 2}), triangulation.insert({2, 2, 2}, CellId(0)));
    EXPECT_TRUE(constrained_faces(triangulation) == square);
    test::expect_valid(triangulation);
}

// The limit is that of the numbers of faces; here it is lower.
TEST(SpatialTriangulation, RefusesMoreCellsThanNumbersWithoutAChange) {
    const std::array<Vec3, 4> corners = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const Vec3 inside(0.2, 0.2, 0.2);
    const auto code_of = [](const auto& grow) {
        try {
            grow();
        } catch (const Error& error) {
            return static_cast<int>(error.code());
        }
        return 0;
    };
    for (const std::int32_t most : {7, 9}) {
        const bool is_refused = most == 7;  // of 5 cells one is replaced by four; an insertion asks for all four
        SpatialTriangulation inserted(corners, most), replaced(corners, most);
        EXPECT_EQ(code_of([&] { inserted.insert(inside); }), is_refused ? 5 : 0);
        const std::int32_t v = replaced.add_vertex(inside);
        const std::array<Tetrahedron, 4> by = {{{v, 1, 2, 3}, {0, v, 2, 3}, {0, 1, v, 3}, {0, 1, 2, v}}};
        EXPECT_EQ(code_of([&] { replaced.replace(std::array{CellId(0)}, by); }), is_refused ? 5 : 0);
        for (const SpatialTriangulation* grown : {&inserted, &replaced})
            EXPECT_EQ(grown->cell_count(), is_refused ? 5 : 8);
        if (is_refused) {
            EXPECT_EQ(inserted.points().size(), 4U);
            EXPECT_EQ(replaced.vertices(CellId(0)), (Tetrahedron{0, 1, 2, 3}));
            EXPECT_FALSE(replaced.cell_at(v).is_valid());
        }
    }
}

// As long as nothing was constrained they may be outside.
TEST(SpatialTriangulation, GrowsTheHull) {
    SCOPED_TRACE(testing::Message() << "seed " << insertion_seed);
    std::mt19937 random(insertion_seed);
    SpatialTriangulation triangulation({Vec3(0, 0, 0), Vec3(1e-3, 0, 0), Vec3(0, 1e-3, 0), Vec3(0, 0, 1e-3)});
    for (const Vec3& p : test::random_points(random, 200)) {
        const std::size_t count = triangulation.points().size();
        ASSERT_EQ(triangulation.insert(p), static_cast<std::int32_t>(count));
        test::expect_valid(triangulation);
        test::expect_delaunay(triangulation);
    }
}

}  // namespace
}  // namespace kerf

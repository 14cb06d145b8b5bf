#include "fill/delaunay/enclosing_faces.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/geometry/predicates.h"
#include "fill/delaunay/delaunay.h"
#include "support/point_sets.h"

namespace kerf {
namespace {

constexpr unsigned faces_seed = 8;

Triangle reversed(const Triangle& t) { return {t[0], t[2], t[1]}; }

// As find_faces() wants it, told by signs alone: seen from the cell's fourth vertex it turns clockwise.
Triangle triangle_of(const SpatialTriangulation& triangulation, CellFace face) {
    const Tetrahedron& v = triangulation.vertices(cell_of(face));
    const int i = index_in_cell(face);
    const std::vector<Vec3>& p = triangulation.points();
    const Triangle corners = {v[i ^ 1], v[i ^ 2], v[i ^ 3]};
    return orientation(p[corners[0]], p[corners[1]], p[corners[2]], p[v[i]]) < 0 ? corners : reversed(corners);
}

TEST(Faces, AreFoundFromBothSides) {
    std::mt19937 random(faces_seed);
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(testing::Message() << name << ", seed " << faces_seed);
        const SpatialTriangulation triangulation = delaunay(points).triangulation;
        std::vector<Triangle> triangles;
        std::vector<CellFace> expected;
        for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face) {
            if (triangulation.is_ghost(cell_of(face)) || random() % 5 != 0) continue;
            Triangle triangle = triangle_of(triangulation, face);
            std::rotate(triangle.begin(), triangle.begin() + random() % 3, triangle.end());
            triangles.insert(triangles.end(), {triangle, reversed(triangle)});
            expected.insert(expected.end(), {face, triangulation.mirror(face)});
        }
        EXPECT_EQ(find_faces(triangulation, triangles), expected);
    }
}

TEST(Faces, AreNotFoundWhereThereAreNone) {
    std::mt19937 random(faces_seed);
    const SpatialTriangulation triangulation = delaunay(test::random_points(random, 60)).triangulation;
    std::set<std::set<std::int32_t>> all;
    for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face) {
        if (triangulation.is_ghost(cell_of(face))) continue;
        const Triangle triangle = triangle_of(triangulation, face);
        all.insert(std::set(triangle.begin(), triangle.end()));
    }
    int missing = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto vertex = [&] { return static_cast<std::int32_t>(random() % 60); };
        const Triangle triangle = {vertex(), vertex(), vertex()};
        const bool is_face = all.contains(std::set(triangle.begin(), triangle.end()));
        ASSERT_EQ(find_faces(triangulation, {triangle})[0] != SpatialTriangulation::none, is_face)
            << "seed " << faces_seed;
        missing += !is_face;
    }
    EXPECT_GT(missing, 500);
    EXPECT_LT(missing, 2990);
}

// Any set of cells is what lies behind its boundary; without one of its faces it leaks.
TEST(Faces, EncloseCells) {
    std::mt19937 random(faces_seed);
    for (const auto& [name, points] : test::point_sets()) {
        SCOPED_TRACE(testing::Message() << name << ", seed " << faces_seed);
        SpatialTriangulation triangulation = delaunay(points).triangulation;
        if (triangulation.cell_count() == 0) continue;
        std::vector<bool> is_inside(static_cast<std::size_t>(triangulation.cell_count()));
        const std::uint32_t one_in = 2 + random() % 4;
        for (const CellId cell : triangulation.cells())
            is_inside[cell.value()] = !triangulation.is_ghost(cell) && (cell < CellId(10) || random() % one_in == 0);
        std::vector<CellFace> boundary;
        for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face)
            if (is_inside[cell_of(face).value()] && !is_inside[cell_of(triangulation.mirror(face)).value()])
                boundary.push_back(face);
        std::shuffle(boundary.begin(), boundary.end(), random);
        const CellFace last = boundary.back();
        boundary.pop_back();
        for (const CellFace face : boundary) triangulation.constrain(face);
        EXPECT_FALSE(cells_behind(triangulation, boundary)) << "it leaks";
        triangulation.constrain(last);
        EXPECT_EQ(cells_behind(triangulation, boundary), is_inside);
    }
}

}  // namespace
}  // namespace kerf

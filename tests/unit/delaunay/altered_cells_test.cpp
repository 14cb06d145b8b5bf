// Points in triangulations that are not Delaunay, and have faces that stay.
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/geometry/predicates.h"
#include "fill/delaunay/delaunay.h"
#include "fill/delaunay/spatial_triangulation.h"
#include "support/point_sets.h"

namespace kerf {
namespace {

constexpr unsigned altering_seed = 32;

// Replaces the two cells of a face by three, if they are positive, whatever is Delaunay.
bool flip_face(SpatialTriangulation& triangulation, CellFace face) {
    const CellFace behind = triangulation.mirror(face);
    if (triangulation.is_ghost(cell_of(face)) || triangulation.is_ghost(cell_of(behind))) return false;
    const std::vector<Vec3>& p = triangulation.points();
    const std::int32_t d = triangulation.opposite_vertex(face), e = triangulation.opposite_vertex(behind);
    const auto [a, b, c] = triangulation.face_vertices(face);
    const std::array<Tetrahedron, 3> three = {Tetrahedron{d, a, b, e}, {d, b, c, e}, {d, c, a, e}};
    for (const Tetrahedron& t : three)
        if (orientation(p[t[0]], p[t[1]], p[t[2]], p[t[3]]) <= 0) return false;
    triangulation.replace(std::array{cell_of(face), cell_of(behind)}, three);
    return true;
}

// Cells of random points after random flips, some of their faces constrained.
SpatialTriangulation altered(std::mt19937& random) {
    SpatialTriangulation triangulation = delaunay(test::point_sets().front().points).triangulation;
    for (int flip = 0; flip < 300; ++flip)
        flip_face(triangulation,
                  static_cast<CellFace>(random() % (4 * static_cast<std::uint32_t>(triangulation.cell_count()))));
    for (CellFace face = 0; face < 4 * triangulation.cell_count(); ++face)
        if (!triangulation.is_ghost(cell_of(face)) && random() % 50 == 0) triangulation.constrain(face);
    return triangulation;
}

// The cells that p may remove, by the slowest way: all whose spheres contain it are reached from the one where it is,
// those with a face that it does not see are refused, and so on from the beginning.
std::set<CellId> removed_by(const SpatialTriangulation& triangulation, const Vec3& p) {
    const std::vector<Vec3>& points = triangulation.points();
    const CellId start = triangulation.locate(p, CellId(0));
    for (std::set<CellId> refused;;) {
        std::vector<CellId> reached = {start};
        std::set<CellId> removed = {start};
        for (std::size_t k = 0; k < reached.size(); ++k)
            for (int i = 0; i < 4; ++i) {
                const CellFace face = cell_face(reached[k], i);
                const CellId next = cell_of(triangulation.mirror(face));
                const Tetrahedron& v = triangulation.vertices(next);
                if (!triangulation.is_constrained(face) && !triangulation.is_ghost(next) && !refused.contains(next) &&
                    in_sphere(points[v[0]], points[v[1]], points[v[2]], points[v[3]], p) && removed.insert(next).second)
                    reached.push_back(next);
            }
        std::set<CellId> unseen;
        for (const CellId cell : removed)
            for (int i = 0; i < 4; ++i) {
                const CellFace face = cell_face(cell, i);
                const auto [a, b, c] = triangulation.face_vertices(face);
                const bool is_inside =
                    !triangulation.is_constrained(face) && removed.contains(cell_of(triangulation.mirror(face)));
                if (!is_inside && orientation(p, points[a], points[b], points[c]) <= 0) unseen.insert(cell);
            }
        if (unseen.empty()) return removed;
        if (unseen.contains(start)) return {};
        refused.merge(unseen);
    }
}

TEST(SpatialTriangulation, RemovesAllCellsOfWhichAPointSeesTheFaces) {
    std::mt19937 random(altering_seed);
    int inserted = 0, left = 0, kept_off = 0;
    for (int round = 0; round < 5; ++round) {
        SpatialTriangulation triangulation = altered(random);
        for (int i = 0; i < 100; ++i) {
            const auto corners =
                triangulation.vertices(CellId(random() % static_cast<std::uint32_t>(triangulation.cell_count())));
            if (std::any_of(corners.begin(), corners.end(), [](std::int32_t v) { return v < 0; })) continue;
            Vec3 p = Vec3::Zero();
            for (const std::int32_t v : corners) p += triangulation.points()[v] / 4;
            const std::set<CellId> expected = removed_by(triangulation, p);
            std::set<Triangle> asked;
            bool is_star_known = false;
            const auto is_kept_off_by = [&](const Triangle& face) {
                asked.insert(face);
                return asked.size() == 3;
            };
            const auto accepts = [&](const Star& star) {
                is_star_known = true;
                EXPECT_EQ(std::set(star.removed.begin(), star.removed.end()), expected);
                for (const Star::Face& face : star.faces)
                    EXPECT_TRUE(!face.is_constrained || asked.contains(face.vertices));
                return true;
            };
            const std::int32_t vertex = triangulation.insert_if(p, CellId(0), {accepts, is_kept_off_by});
            ASSERT_EQ(vertex != SpatialTriangulation::none, is_star_known);
            ASSERT_EQ(is_star_known, asked.size() < 3 && !expected.empty());
            inserted += is_star_known;
            left += is_star_known && triangulation.has_left_cells();
            kept_off += asked.size() == 3;
        }
        test::expect_valid(triangulation);
    }
    EXPECT_GT(inserted, 200);
    EXPECT_GT(left, 50);
    EXPECT_GT(kept_off, 20);
}

}  // namespace
}  // namespace kerf

// Cells in place of others, the numbers that they get, and what their neighbours are told.
#include "fill/mesh/editable_tets.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "fill/mesh/adjacency.h"
#include "fill/mesh/verification.h"

namespace kerf {
namespace {

// The regular tetrahedron, and vertex 4 inside of it.
TetMesh four_cells() {
    TetMesh mesh;
    mesh.vertices = {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1), Vec3::Zero()};
    mesh.boundary_vertex_count = 4;
    mesh.tets = {{4, 1, 2, 3}, {0, 4, 2, 3}, {0, 1, 4, 3}, {0, 1, 2, 4}};
    return mesh;
}

std::vector<CellId> cells(const std::vector<std::int32_t>& numbers) { return {numbers.begin(), numbers.end()}; }

TetMesh all_of(EditableTets tets) { return tets.take_mesh(true); }

void expect_links_agree(const EditableTets& tets) {
    for (const CellId cell : tets.cells()) {
        if (tets.vertices(cell)[0] < 0) continue;
        for (int i = 0; i < 4; ++i) {
            const CellFace face = cell_face(cell, i), behind = tets.mirror(face);
            if (behind < 0) {
                EXPECT_TRUE(tets.is_constrained(face));
                continue;
            }
            EXPECT_EQ(tets.mirror(behind), face);
            EXPECT_EQ(tets.is_constrained(behind), tets.is_constrained(face));
            const Triangle here = tets.face_vertices(face), there = tets.face_vertices(behind);
            EXPECT_EQ(std::set(here.begin(), here.end()), std::set(there.begin(), there.end()));
            EXPECT_EQ(index_of(tets.vertices(cell_of(behind)), tets.opposite_vertex(face)), 4);
        }
        for (const std::int32_t v : tets.vertices(cell)) EXPECT_LT(index_of(tets.vertices(tets.cell_at(v)), v), 4);
    }
}

TEST(EditableTets, GivesTheMeshBackThatItWasMadeOf) {
    for (const bool has_neighbours : {false, true}) {
        TetMesh mesh = four_cells();
        const TetNeighbours neighbours = find_neighbours(mesh);
        if (has_neighbours) mesh.neighbours = neighbours;
        const EditableTets tets(mesh, EditableTets::most_cells);
        expect_links_agree(tets);
        const TetMesh again = all_of(tets);
        EXPECT_EQ(again.tets, mesh.tets);
        EXPECT_EQ(again.vertices, mesh.vertices);
        EXPECT_EQ(again.neighbours, neighbours);
    }
}

TEST(EditableTets, RefusesMoreCellsThanItMayHave) {
    EXPECT_THROW(EditableTets(four_cells(), 3), Error);
    EditableTets tets(four_cells(), 4);
    const std::int32_t v = tets.add_vertex((tets.points()[1] + tets.points()[2] + tets.points()[3]) / 4);
    const std::array<Tetrahedron, 4> by = {{{v, 1, 2, 3}, {4, v, 2, 3}, {4, 1, v, 3}, {4, 1, 2, v}}};
    EXPECT_THROW(tets.replace(std::array{CellId(0)}, by), Error);
    tets.remove_unused_vertices(5);
    EXPECT_EQ(all_of(tets).tets, four_cells().tets);
}

TEST(EditableTets, FindsRingsAndStarsInsideOnly) {
    EditableTets tets(four_cells(), EditableTets::most_cells);
    EdgeRing ring;
    ASSERT_TRUE(find_ring(tets, CellId(2), 0, 2, ring));  // from vertex 0 to vertex 4
    EXPECT_EQ(ring.a, 0);
    EXPECT_EQ(ring.b, 4);
    ASSERT_EQ(ring.size(), 3u);
    EXPECT_EQ(ring.cells[0], CellId(2));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t p = ring.ring[k], q = ring.ring[(k + 1) % 3];
        const auto point = [&](std::int32_t v) { return tets.points()[v]; };
        EXPECT_GT((point(ring.b) - point(ring.a)).cross(point(p) - point(ring.a)).dot(point(q) - point(ring.a)), 0);
        for (const std::int32_t v : {ring.a, ring.b, p, q}) EXPECT_LT(index_of(tets.vertices(ring.cells[k]), v), 4);
        EXPECT_EQ(ring.place_of(p), k);
    }
    EXPECT_EQ(ring.place_of(4), ring.size());
    EXPECT_FALSE(find_ring(tets, CellId(2), 0, 2, ring, 2)) << "more cells than asked for";
    EXPECT_FALSE(find_ring(tets, CellId(2), 0, 1, ring)) << "on the boundary";
    std::vector<CellId> star;
    tets.find_star(CellId(3), 4, star);
    EXPECT_EQ(star[0], CellId(3));
    std::sort(star.begin(), star.end());
    EXPECT_EQ(star, cells({0, 1, 2, 3}));
}

// Three cells around an edge, one with another cell behind a face, become two, and one number is free; it is taken
// before a new one.
TEST(EditableTets, FillsGapsBeforeItGrows) {
    TetMesh mesh;
    mesh.vertices = {Vec3(0, 0, -1),      Vec3(1, 0, 0), Vec3(-0.5, 0.8, 0),
                     Vec3(-0.5, -0.8, 0), Vec3(0, 0, 1), Vec3(2, 3, -2)};
    mesh.tets = {{0, 4, 1, 2}, {0, 4, 2, 3}, {0, 4, 3, 1}, {0, 2, 1, 5}};
    EditableTets tets(mesh, EditableTets::most_cells);
    tets.constrain(cell_face(CellId(0), 1));
    EdgeRing ring;
    ASSERT_TRUE(find_ring(tets, CellId(1), 0, 1, ring));
    EXPECT_EQ(ring.cells, cells({1, 2, 0}));
    const std::array<Tetrahedron, 2> two = {{{0, 1, 2, 3}, {1, 2, 3, 4}}};
    const auto made = tets.replace(ring.cells, two);
    EXPECT_EQ(std::vector(made.begin(), made.end()), cells({1, 2}));
    EXPECT_LT(tets.vertices(CellId(0))[0], 0);
    EXPECT_EQ(tets.cell_count(), 4);
    EXPECT_EQ(tets.neighbour(CellId(3), 3), CellId(1));
    EXPECT_TRUE(tets.is_constrained(cell_face(CellId(3), 3)));
    expect_links_agree(tets);

    const std::int32_t v = tets.add_vertex(Vec3(0, 0, -0.1));
    const std::array<Tetrahedron, 4> four = {{{v, 1, 2, 3}, {0, v, 2, 3}, {0, 1, v, 3}, {0, 1, 2, v}}};
    const auto filled = tets.replace(std::array{CellId(1)}, four);
    EXPECT_EQ(std::vector(filled.begin(), filled.end()), cells({1, 0, 4, 5}));
    expect_links_agree(tets);

    const Tetrahedron outside = tets.vertices(CellId(3));
    std::vector<bool> is_kept(6, true);
    is_kept[3] = false;
    tets.keep_cells(is_kept);
    EXPECT_EQ(tets.cell_count(), 5);
    EXPECT_EQ(tets.cell_at(5), CellId::none());
    expect_links_agree(tets);
    tets.add_cells(std::span(&outside, 1));
    EXPECT_EQ(tets.neighbour(CellId(5), 3), CellId(4));
    expect_links_agree(tets);
    const TetMesh inside = tets.take_mesh(true);
    EXPECT_EQ(inside.tets.size(), 6u);
    EXPECT_EQ(inside.neighbours, find_neighbours(inside));
    EXPECT_EQ(tets.cell_count(), 0);
}

}  // namespace
}  // namespace kerf

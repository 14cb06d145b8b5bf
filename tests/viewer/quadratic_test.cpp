// Triangles and cells of second order as they are drawn.
#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "fill/mesh/edge_table.h"
#include "viewer/model/inside/part_edges.h"
#include "viewer/scene/inside/cell_shapes.h"
#include "viewer/scene/inside/quadratic_triangle.h"
#include "viewer/scene/inside/shapes.h"

namespace kerf::test {
namespace {

using namespace view;

class RandomPlaces {
 public:
    explicit RandomPlaces(unsigned seed) : random_(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    Vec3 place() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }

 private:
    std::mt19937 random_;
};

Vec3 corner(const Geometry& geometry, std::size_t i) {
    const auto& p = geometry.corners[i].position;
    return {p[0], p[1], p[2]};
}

// Zero where triangles bound a body without a gap.
Vec3 sum_of_area_vectors(const Geometry& geometry) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < geometry.corners.size(); i += 3)
        sum += (corner(geometry, i + 1) - corner(geometry, i)).cross(corner(geometry, i + 2) - corner(geometry, i)) / 2;
    return sum;
}

double volume_inside(const Geometry& geometry) {
    double volume = 0;
    for (std::size_t i = 0; i < geometry.corners.size(); i += 3)
        volume += corner(geometry, i).dot(corner(geometry, i + 1).cross(corner(geometry, i + 2))) / 6;
    return volume;
}

TEST(QuadraticTriangles, GoThroughTheirNodesAndKeepQuadraticValues) {
    RandomPlaces random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const Vec3 linear = random.place(), square = random.place();
        const auto f = [&](const Vec3& p) { return linear.dot(p) + square.dot(p) * square.dot(p); };
        QuadraticTriangle t;
        for (std::size_t k = 0; k < 3; ++k) t.place[k] = random.place();
        for (std::size_t e = 0; e < 3; ++e)
            t.place[3 + e] = (t.place[ends_of_edges[e][0]] + t.place[ends_of_edges[e][1]]) / 2;
        t.rest = t.place;
        for (std::size_t n = 0; n < 6; ++n) t.value[n] = static_cast<float>(f(t.place[n]));
        EXPECT_TRUE(t.is_straight());
        Geometry geometry;
        const int pieces = 1 + trial % 5;
        add_quadratic(geometry, Frame(), t, pieces, 7, true);
        ASSERT_EQ(geometry.triangle_count(), static_cast<std::size_t>(pieces * pieces));
        EXPECT_FALSE(geometry.has_normals);
        const auto [least, largest] = std::minmax_element(t.value.begin(), t.value.end());
        int drawn = 0;
        for (std::size_t i = 0; i < geometry.corners.size(); ++i) {
            const float value = geometry.corners[i].value;
            EXPECT_TRUE(*least <= value && value <= *largest) << "the extremes are those of the nodes";
            EXPECT_NEAR(value, std::clamp(static_cast<float>(f(corner(geometry, i))), *least, *largest), 1e-5);
            EXPECT_EQ(geometry.rest[i], geometry.corners[i].position);
            EXPECT_EQ(geometry.element[i / 3], 7);
            drawn += i % 3 == 0 ? std::popcount(geometry.corners[i].edges) : 0;
        }
        EXPECT_EQ(drawn, 3 * pieces) << "the edges of the whole, not those inside";
    }
}

TEST(QuadraticTriangles, AreOneWhereNothingIsCurved) {
    QuadraticTriangle t;
    t.place = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0, 0), Vec3(0.5, 0.5, 0), Vec3(0, 0.5, 0)};
    t.value = {0, 1, 2, 0.5f, 1.5f, 1};
    EXPECT_EQ(pieces_of(t, 10), 1);
    t.value[4] = 1.7f;
    EXPECT_EQ(pieces_of(t, 10), 2) << "values change otherwise";
    t.place[4] += Vec3(0.02, 0.02, 0);
    EXPECT_EQ(pieces_of(t, 10), 4);
    EXPECT_GE(pieces_of(t, 10'000'000), 2);
}

// The facets of an octahedron, whose edges have their nodes on the unit sphere.
NodeSurface ball() {
    NodeSurface surface;
    for (const double sign : {1.0, -1.0})
        for (int axis = 0; axis < 3; ++axis) surface.vertices.emplace_back(sign * Vec3::Unit(axis));
    for (int octant = 0; octant < 8; ++octant) {
        Triangle t = {octant & 1 ? 3 : 0, octant & 2 ? 4 : 1, octant & 4 ? 5 : 2};
        if (std::popcount(static_cast<unsigned>(octant)) % 2 == 1) std::swap(t[1], t[2]);
        surface.facets.push_back(t);
    }
    std::map<UndirectedEdge, std::int32_t> numbers;
    for (const Triangle& t : surface.facets) {
        std::array<std::int32_t, 3>& edges = surface.edges_of_facet.emplace_back();
        for (std::size_t e = 0; e < 3; ++e) {
            const auto ends = undirected(t[ends_of_edges[e][0]], t[ends_of_edges[e][1]]);
            const auto [place, is_new] = numbers.emplace(ends, static_cast<std::int32_t>(numbers.size()));
            edges[e] = place->second;
            if (!is_new) continue;
            const Vec3 sum = surface.vertices[static_cast<std::size_t>(ends[0])] +
                             surface.vertices[static_cast<std::size_t>(ends[1])];
            surface.edges.places.push_back(sum.normalized());
            surface.edges.ends.push_back({ends[0], ends[1]});
            surface.edges.node.push_back(static_cast<std::int32_t>(6 + surface.edges.node.size()));
        }
    }
    return surface;
}

TEST(CurvedFacets, BoundABallWithoutAGap) {
    const NodeSurface surface = ball();
    FacetChoice choice;
    const auto flat = facet_triangles(surface, Frame(), choice);
    EXPECT_EQ(flat->triangle_count(), 8u);
    EXPECT_FALSE(flat->has_normals);
    choice.edges = {surface.edges.places, surface.edges.places, {}};
    const auto curved = facet_triangles(surface, Frame(), choice);
    EXPECT_EQ(curved->triangle_count(), 8u * 16);
    EXPECT_LT(sum_of_area_vectors(*curved).norm(), 1e-6);
    const double ball_volume = 4 * M_PI / 3;
    EXPECT_LT(std::abs(volume_inside(*curved) - ball_volume), 0.3 * std::abs(volume_inside(*flat) - ball_volume));
    EXPECT_TRUE(curved->has_normals);
    for (std::size_t i = 0; i < curved->corners.size(); ++i) {
        const auto& n = curved->corners[i].normal;
        EXPECT_GT(Vec3(n[0], n[1], n[2]).dot(corner(*curved, i)), 0.9 * 32767 * corner(*curved, i).norm());
        EXPECT_EQ(curved->element[i / 3], static_cast<std::int32_t>(i / 3 / 16)) << "picks name the facet";
    }
}

// One cell, and two with a face in common, whose edges are bent anyhow.
TEST(CurvedCells, BoundABodyWithoutAGap) {
    RandomPlaces random(5);
    for (int trial = 0; trial < 40; ++trial) {
        PartCells cells;
        cells.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)};
        cells.tets = {{0, 1, 2, 3}};
        const CellId none = CellId::none();
        cells.neighbours = {{none, none, none, none}};
        if (trial % 2 == 1) {
            cells.tets.push_back({1, 2, 3, 4});
            cells.neighbours = {{CellId(1), none, none, none}, {none, none, none, CellId(0)}};
        }
        const EdgeTable table(cells.tets, cells.vertices.size());
        table.for_all([&](std::int64_t e, const UndirectedEdge& edge) {
            const Vec3 middle = (cells.vertices[static_cast<std::size_t>(edge[0])] +
                                 cells.vertices[static_cast<std::size_t>(edge[1])]) /
                                2;
            cells.edges.places.emplace_back(middle + 0.1 * random.place());
            cells.edges.ends.push_back({edge[0], edge[1]});
            cells.edges.node.push_back(static_cast<std::int32_t>(5 + e));
        });
        for (const Tetrahedron& tet : cells.tets) {
            auto& edges = cells.edges_of_tet.emplace_back();
            for (std::size_t k = 0; k < 6; ++k)
                edges[k] = table.find(undirected(tet[static_cast<std::size_t>(tet_edges[k][0])],
                                                 tet[static_cast<std::size_t>(tet_edges[k][1])]));
        }
        CellChoice choice;
        choice.edges = {cells.edges.places, cells.edges.places, {}};
        const auto geometry = cell_faces(cells, Frame(), choice);
        EXPECT_EQ(geometry->triangle_count(), (trial % 2 == 0 ? 4u : 6u) * 16);
        EXPECT_LT(sum_of_area_vectors(*geometry).norm(), 1e-6);
        choice.shrink = 0.3;
        const auto shrunken = cell_faces(cells, Frame(), choice);
        EXPECT_EQ(shrunken->triangle_count(), cells.tets.size() * 4 * 16);
        EXPECT_LT(sum_of_area_vectors(*shrunken).norm(), 1e-6);
        EXPECT_NEAR(volume_inside(*shrunken), std::pow(0.7, 3) * volume_inside(*geometry), 1e-5);
    }
}

// Two cells of a part, and three of their faces.
TEST(EdgesOfAPart, AreThoseOfItsNodes) {
    RandomPlaces random(9);
    Part part;
    for (int v = 0; v < 5; ++v) part.mesh.vertices.push_back(random.place());
    part.global_id = {0, 1, 2, 3, 4};
    part.mesh.tets = {{0, 1, 2, 3}, {1, 4, 2, 3}};
    part.facets = {{0, 2, 1}, {1, 2, 4}, {0, 1, 3}};
    PartCells none;
    add_edges(part, none);
    EXPECT_TRUE(none.edges.empty()) << "of first order";
    part.edge_nodes.edges = EdgeTable(part.mesh.tets, 5);
    for (std::size_t e = 0; e < part.edge_nodes.edges.size(); ++e) {
        part.edge_nodes.points.push_back(random.place());
        part.edge_nodes.global_id.push_back(static_cast<std::int64_t>(5 + e));
    }
    PartCells cells;
    add_edges(part, cells);
    NodeSurface surface;
    add_edges(part, surface);
    EXPECT_EQ(cells.edges.places.size(), 9u);
    EXPECT_EQ(surface.edges.places.size(), 7u) << "those of the facets alone";
    const auto check = [&](const EdgePoints& edges, std::int32_t edge, std::int32_t a, std::int32_t b) {
        const auto e = static_cast<std::size_t>(edge);
        EXPECT_EQ(edges.places[e], part.node_point(edges.node[e]));
        EXPECT_EQ(undirected(edges.ends[e][0], edges.ends[e][1]), undirected(a, b));
        EXPECT_EQ(edges.node[e], 5 + part.edge_nodes.edges.find(undirected(a, b)));
    };
    for (std::size_t t = 0; t < 2; ++t)
        for (std::size_t k = 0; k < 6; ++k)
            check(cells.edges, cells.edges_of_tet[t][k], part.mesh.tets[t][static_cast<std::size_t>(tet_edges[k][0])],
                  part.mesh.tets[t][static_cast<std::size_t>(tet_edges[k][1])]);
    for (std::size_t f = 0; f < part.facets.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            check(surface.edges, surface.edges_of_facet[f][k], part.facets[f][ends_of_edges[k][0]],
                  part.facets[f][ends_of_edges[k][1]]);
}

}  // namespace
}  // namespace kerf::test

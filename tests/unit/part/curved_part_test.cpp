#include "files/part/curved_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "fill/mesh/curved_tet.h"

namespace kerf {
namespace {

// A cube of n^3 cubes, six tetrahedra each, around the same diagonal.
struct CubeMesh {
    TetMesh mesh;
    EdgeTable edges;
    std::vector<char> inside;

    explicit CubeMesh(int n) {
        const auto number = [&](int i, int j, int k) { return (i * (n + 1) + j) * (n + 1) + k; };
        for (int i = 0; i <= n; ++i)
            for (int j = 0; j <= n; ++j)
                for (int k = 0; k <= n; ++k) mesh.vertices.emplace_back(i, j, k);
        std::array<int, 3> axes = {0, 1, 2};
        do {
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j)
                    for (int k = 0; k < n; ++k) {
                        std::array<int, 3> at = {i, j, k};
                        Tetrahedron tet;
                        tet[0] = number(i, j, k);
                        for (std::size_t step = 0; step < 3; ++step) {
                            ++at[static_cast<std::size_t>(axes[step])];
                            tet[step + 1] = number(at[0], at[1], at[2]);
                        }
                        const std::vector<Vec3>& p = mesh.vertices;
                        if ((p[tet[1]] - p[tet[0]]).cross(p[tet[2]] - p[tet[0]]).dot(p[tet[3]] - p[tet[0]]) < 0)
                            std::swap(tet[2], tet[3]);
                        mesh.tets.push_back(tet);
                    }
        } while (std::next_permutation(axes.begin(), axes.end()));
        edges = EdgeTable(mesh.tets, mesh.vertices.size());
        inside.resize(edges.size(), 1);
        edges.for_all([&](std::int64_t e, const UndirectedEdge& ends) {
            const Vec3 &a = mesh.vertices[ends[0]], &b = mesh.vertices[ends[1]];
            for (int axis = 0; axis < 3; ++axis)
                if (a[axis] == b[axis] && (a[axis] == 0 || a[axis] == n)) inside[e] = 0;
        });
    }

    // All edges of the boundary, with nodes so far from their middles.
    std::vector<CurvedEdge> wanted(double off, unsigned seed) const {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> some(-off, off);
        std::vector<CurvedEdge> all;
        edges.for_all([&](std::int64_t e, const UndirectedEdge& ends) {
            if (inside[e] == 0)
                all.push_back({static_cast<std::int32_t>(e), (mesh.vertices[ends[0]] + mesh.vertices[ends[1]]) / 2 +
                                                                 Vec3(some(random), some(random), some(random))});
        });
        return all;
    }

    TetNodes nodes_of(const Tetrahedron& tet, const std::map<std::int32_t, Vec3>& curved) const {
        TetNodes nodes = straight_nodes(
            {mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]], mesh.vertices[tet[3]]});
        for (std::size_t e = 0; e < 6; ++e) {
            const auto found = curved.find(edges.find(undirected(tet[tet_edges[e][0]], tet[tet_edges[e][1]])));
            if (found != curved.end()) nodes[4 + e] = found->second;
        }
        return nodes;
    }
};

TEST(CurvedPart, EveryCellIsValidHoweverFarNodesShouldGo) {
    const CubeMesh cube(3);
    std::int64_t last = 0;
    for (const double off : {0.05, 0.2, 0.4, 0.8}) {
        const std::vector<CurvedEdge> wanted = cube.wanted(off, 3);
        const CurvedPart part = curve_part(cube.mesh, cube.edges, cube.inside, wanted);
        std::map<std::int32_t, Vec3> curved;
        std::size_t inside = 0;
        for (const auto& [edge, node] : part.curved) {
            curved.emplace(edge, node);
            inside += cube.inside[edge];
        }
        std::int64_t cells = 0;
        double worst = 1, gain = 0;
        for (const Tetrahedron& tet : cube.mesh.tets) {
            const CurvedTetJacobian jacobian(cube.nodes_of(tet, curved));
            EXPECT_EQ(jacobian.validity(), CellValidity::valid);
            worst = std::min(worst, scaled_jacobian(jacobian));
            gain += jacobian.volume() - jacobian.straight() / 6;
            for (std::size_t e = 0; e < 6; ++e)
                if (curved.contains(cube.edges.find(undirected(tet[tet_edges[e][0]], tet[tet_edges[e][1]])))) {
                    ++cells;
                    break;
                }
        }
        EXPECT_EQ(part.cells, cells);
        EXPECT_NEAR(part.worst_scaled_jacobian, worst, 1e-12);
        EXPECT_NEAR(part.volume_gain, gain, 1e-12);
        EXPECT_GT(worst, 0);
        EXPECT_EQ(part.curved.size() - inside + part.straightened.size(), wanted.size());
        EXPECT_EQ(part.moved, static_cast<std::int64_t>(inside));
        for (const CurvedEdge& edge : wanted) {
            const bool is_straight = std::binary_search(part.straightened.begin(), part.straightened.end(), edge.edge);
            EXPECT_NE(is_straight, curved.contains(edge.edge));
            if (!is_straight) {
                EXPECT_EQ(curved.at(edge.edge), edge.node);
            }
        }
        EXPECT_GE(std::ssize(part.straightened), last);
        last = std::ssize(part.straightened);
        if (off == 0.05) {
            EXPECT_TRUE(part.straightened.empty());
            EXPECT_EQ(part.moved, 0);
        }
    }
    EXPECT_GT(last, 20);
}

// An edge that is bent into its cell so far that this is not valid with straight edges inside.
TEST(CurvedPart, NodesInsideMakeRoom) {
    const CubeMesh cube(2);
    std::int64_t moved = 0, straightened = 0;
    for (const double off : {0.1, 0.2, 0.25, 0.3, 0.35}) {
        std::vector<CurvedEdge> wanted = cube.wanted(0, 1);
        for (CurvedEdge& edge : wanted)
            if (edge.node.z() == 0 && edge.node.x() > 0 && edge.node.x() < 2 && edge.node.y() > 0 && edge.node.y() < 2)
                edge.node.z() += off;
        std::erase_if(wanted, [](const CurvedEdge& e) { return e.node.z() <= 0 || e.node.z() > 0.4; });
        const CurvedPart part = curve_part(cube.mesh, cube.edges, cube.inside, wanted);
        moved += part.moved;
        straightened += std::ssize(part.straightened);
        if (off <= 0.2) {
            EXPECT_TRUE(part.straightened.empty());
        }
    }
    EXPECT_GT(moved, 0) << straightened;
}

TEST(CurvedPart, WithoutCurvedEdgesThereIsNothingToDo) {
    const CubeMesh cube(1);
    const CurvedPart part = curve_part(cube.mesh, cube.edges, cube.inside, {});
    EXPECT_TRUE(part.curved.empty() && part.straightened.empty());
    EXPECT_EQ(part.cells, 0);
    EXPECT_EQ(part.worst_scaled_jacobian, 1);
}

}  // namespace
}  // namespace kerf

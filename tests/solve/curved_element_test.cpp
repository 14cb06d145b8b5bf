// Laws of elements with curved edges, over random ones, and of the rules that integrate them.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "solve/equations/inside/mass_matrix.h"
#include "solve/space/inside/facet_element.h"
#include "solve/space/tet_element.h"

namespace kerf {
namespace {

// Corners of the sides, seen from outside.
constexpr std::array<std::array<int, 3>, 4> cell_sides = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

int node_between(int a, int b) {
    for (int e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[static_cast<std::size_t>(e)];
        if ((i == a && j == b) || (i == b && j == a)) return 4 + e;
    }
    return -1;
}

std::array<int, 6> nodes_of_side(const std::array<int, 3>& corners) {
    std::array<int, 6> nodes{corners[0], corners[1], corners[2]};
    for (std::size_t e = 0; e < 3; ++e)
        nodes[3 + e] = node_between(corners[static_cast<std::size_t>(triangle_edges[e][0])],
                                    corners[static_cast<std::size_t>(triangle_edges[e][1])]);
    return nodes;
}

struct RandomCell {
    TetElement::Nodes nodes;
    TetElement element{nodes};
    FacetElement side(std::size_t s) const {
        FacetElement::Nodes of_side;
        const auto numbers = nodes_of_side(cell_sides[s]);
        for (std::size_t i = 0; i < 6; ++i) of_side[i] = nodes[static_cast<std::size_t>(numbers[i])];
        return FacetElement(of_side);
    }
};

// 100 that are not folded, with edges bent by up to `bend` of the cell; the same in every run.
std::vector<RandomCell> random_cells(double bend) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto any = [&]() -> Vec3 { return {coordinate(random), coordinate(random), coordinate(random)}; };
    std::vector<RandomCell> cells;
    while (cells.size() < 100) {
        TetElement::Nodes nodes;
        for (std::size_t i = 0; i < 4; ++i) nodes[i] = any();
        for (std::size_t e = 0; e < 6; ++e) {
            const auto [i, j] = tet_edges[e];
            nodes[4 + e] = 0.5 * (nodes[static_cast<std::size_t>(i)] + nodes[static_cast<std::size_t>(j)]);
            if (bend > 0) nodes[4 + e] += bend * any();
        }
        const RandomCell cell{nodes};
        double least = TetElement({nodes[0], nodes[1], nodes[2], nodes[3]}, 2).volume();
        for (const TetPoint& at : quadrature::fourteen_points)
            least = std::min(least, cell.element.stretch_at(at.place) - 0.1);
        if (least > 0.01) cells.push_back(cell);
    }
    return cells;
}

double factorial(int n) { return std::tgamma(n + 1); }

TEST(Quadrature, IsExactToItsDegree) {
    const auto check = [](std::span<const TetPoint> rule, int degree) {
        for (int i = 0; i <= degree; ++i)
            for (int j = 0; i + j <= degree; ++j)
                for (int k = 0; i + j + k <= degree; ++k) {
                    double mean = 0;
                    for (const auto& [place, weight] : rule)
                        mean += weight * std::pow(place[0], i) * std::pow(place[1], j) * std::pow(place[2], k);
                    EXPECT_NEAR(mean, 6 * factorial(i) * factorial(j) * factorial(k) / factorial(3 + i + j + k), 1e-15)
                        << i << " " << j << " " << k;
                }
    };
    check(quadrature::four_points, 2);
    check(quadrature::fourteen_points, 5);
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; i + j <= 4; ++j) {
            double mean = 0;
            for (const auto& [place, weight] : quadrature::six_points)
                mean += weight * std::pow(place[0], i) * std::pow(place[1], j);
            EXPECT_NEAR(mean, 2 * factorial(i) * factorial(j) / factorial(2 + i + j), 1e-15) << i << " " << j;
        }
}

TEST(CurvedElement, IsTheStraightOneWhereItsNodesAreMidpoints) {
    const Material steel{"steel", 210, 0.3, 1};
    for (const RandomCell& cell : random_cells(0)) {
        const TetElement straight({cell.nodes[0], cell.nodes[1], cell.nodes[2], cell.nodes[3]}, 2);
        EXPECT_FALSE(cell.element.is_curved());
        TetElement::Stiffness a, b;
        straight.stiffness(steel, a);
        cell.element.stiffness(steel, b);
        EXPECT_EQ(a, b);
        EXPECT_EQ(straight.node_volumes(), cell.element.node_volumes());
    }
}

TEST(CurvedElement, NodesAreWhereTheyWerePut) {
    for (const RandomCell& cell : random_cells(0.1)) {
        EXPECT_TRUE(cell.element.is_curved());
        for (int n = 0; n < most_element_nodes; ++n)
            EXPECT_LT((cell.element.position_of(TetElement::place_of_node(n)) - cell.nodes[static_cast<std::size_t>(n)])
                          .norm(),
                      1e-15);
    }
}

// Gauss: the area vectors of the sides close, and bound the volume.
TEST(CurvedElement, VolumeIsThatBetweenItsSides) {
    for (const RandomCell& cell : random_cells(0.1)) {
        Vec3 sum = Vec3::Zero();
        double volume = 0;
        for (std::size_t s = 0; s < 4; ++s) {
            const auto numbers = nodes_of_side(cell_sides[s]);
            const FacetElement::Forces forces = cell.side(s).forces_of_pressure(-1);
            for (std::size_t i = 0; i < 6; ++i) {
                sum += forces[i];
                volume += forces[i].dot(cell.nodes[static_cast<std::size_t>(numbers[i])]) / 3;
            }
        }
        EXPECT_LT(sum.norm(), 1e-14);
        EXPECT_NEAR(cell.element.volume(), volume, 1e-14);
        double of_nodes = 0;
        for (const double share : cell.element.node_volumes()) of_nodes += share;
        EXPECT_NEAR(of_nodes, volume, 1e-14);
    }
}

// Shape functions add up to 1: rows of the mass are what a density of 1 puts on each node.
TEST(CurvedElement, MassOfEachNodeIsExact) {
    for (const double bend : {0.0, 0.1})
        for (const RandomCell& cell : random_cells(bend)) {
            const MassShares shares = mass_shares(cell.element);
            const TetElement::Shapes volumes = cell.element.node_volumes();
            for (std::size_t a = 0; a < shares.size(); ++a) {
                double sum = 0;
                for (std::size_t b = 0; b < shares.size(); ++b) {
                    sum += shares[a][b];
                    EXPECT_NEAR(shares[a][b], shares[b][a], 1e-16);
                }
                EXPECT_NEAR(sum, volumes[a], 1e-14);
                EXPECT_GT(shares[a][a], 0);
            }
        }
}

TEST(CurvedElement, TractionsOfItsSidesAddUp) {
    for (const RandomCell& cell : random_cells(0.1)) {
        const FacetElement side = cell.side(0);
        Vec3 sum = Vec3::Zero();
        for (const Vec3& force : side.forces_of_traction({1, 2, -3})) sum += force;
        EXPECT_LT((sum - side.area() * Vec3(1, 2, -3)).norm(), 1e-14);
    }
}

// A piece of the unit sphere: what nodes on it leave of its area falls with h^4.
TEST(CurvedElement, AreaConverges) {
    const auto error = [](double h) {
        const auto on_sphere = [](const Vec3& p) -> Vec3 { return p.normalized(); };
        const Vec3 a = on_sphere({1, 0, 0}), b = on_sphere({1, h, 0}), c = on_sphere({1, 0, h});
        const double area = 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));  // Eriksson
        const FacetElement side({a, b, c, on_sphere(a + b), on_sphere(b + c), on_sphere(a + c)});
        return std::abs(side.area() / area - 1);
    };
    EXPECT_LT(error(0.4), 1e-3);
    EXPECT_LT(error(0.2), error(0.4) / 12);
}

// The stress is the same everywhere, and balances what it does on the sides: exactly, whatever the edges are.
TEST(CurvedElement, LinearFieldsHaveUniformStress) {
    const Material steel{"steel", 210, 0.3, 1};
    const Eigen::Matrix3d slope = (Eigen::Matrix3d() << 1, 2, -3, 0.5, -1, 4, 2, 0.25, 3).finished();
    const SymmetricTensor s = stress_of(steel, strain_of(slope));
    const Eigen::Matrix3d stress =
        (Eigen::Matrix3d() << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]).finished();
    for (const RandomCell& cell : random_cells(0.1)) {
        TetElement::Nodes values;
        for (std::size_t n = 0; n < 10; ++n) values[n] = slope * cell.nodes[n] + Vec3(1, -2, 0.5);
        for (const TetPoint& at : quadrature::fourteen_points)
            EXPECT_LT((cell.element.gradient_of(values, at.place) - slope).norm(), 1e-10);
        TetElement::Stiffness blocks;
        cell.element.stiffness(steel, blocks);
        TetElement::Nodes forces;
        forces.fill(Vec3::Zero());
        for (std::size_t a = 0; a < 10; ++a)
            for (std::size_t b = 0; b < 10; ++b) forces[a] += blocks[a][b] * values[b];
        for (std::size_t side = 0; side < 4; ++side) {
            const auto numbers = nodes_of_side(cell_sides[side]);
            const FacetElement::Forces areas = cell.side(side).forces_of_pressure(-1);
            for (std::size_t i = 0; i < 6; ++i) forces[static_cast<std::size_t>(numbers[i])] -= stress * areas[i];
        }
        for (const Vec3& force : forces) EXPECT_LT(force.norm(), 1e-9);
    }
}

}  // namespace
}  // namespace kerf

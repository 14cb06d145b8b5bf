#include "fill/mesh/curved_tet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include <Eigen/Dense>

#include "fill/mesh/edge_table.h"

namespace kerf {
namespace {

class RandomCells {
 public:
    explicit RandomCells(unsigned seed) : engine_(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Vec3 point() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
    // Positively oriented, with nodes that far off the midpoints.
    TetNodes next(double off) {
        std::array<Vec3, 4> corners = {point(), point(), point(), point()};
        if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).dot(corners[3] - corners[0]) < 0)
            std::swap(corners[0], corners[1]);
        TetNodes nodes = straight_nodes(corners);
        for (std::size_t e = 4; e < nodes.size(); ++e) nodes[e] += off * point();
        return nodes;
    }

 private:
    std::mt19937 engine_;
};

// By the shape functions, at barycentric coordinates.
double determinant_at(const TetNodes& nodes, const Eigen::Vector4d& l) {
    std::array<Vec3, 4> slope;  // by each barycentric coordinate
    for (std::size_t i = 0; i < 4; ++i) slope[i] = (4 * l[static_cast<int>(i)] - 1) * nodes[i];
    for (std::size_t e = 0; e < tet_edges.size(); ++e) {
        const auto [i, j] = tet_edges[e];
        slope[static_cast<std::size_t>(i)] += 4 * l[j] * nodes[4 + e];
        slope[static_cast<std::size_t>(j)] += 4 * l[i] * nodes[4 + e];
    }
    Eigen::Matrix3d jacobian;
    for (int k = 0; k < 3; ++k) jacobian.col(k) = slope[static_cast<std::size_t>(k) + 1] - slope[0];
    return jacobian.determinant();
}

double least_sampled(const TetNodes& nodes, int n) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i)
        for (int j = 0; i + j <= n; ++j)
            for (int k = 0; i + j + k <= n; ++k)
                least = std::min(least, determinant_at(nodes, Eigen::Vector4d(i, j, k, n - i - j - k) / n));
    return least;
}

TEST(CurvedTet, BoundsHoldTheLeastOfManySamples) {
    RandomCells random(36);
    for (int i = 0; i < 300; ++i) {
        const TetNodes nodes = random.next(random.number(0, 0.5));
        const CurvedTetJacobian jacobian(nodes);
        const double least = least_sampled(nodes, 24);
        const auto [low, high] = jacobian.bounds();
        double size = 0;
        for (const double c : jacobian.coefficients()) size = std::max(size, std::abs(c));
        EXPECT_LE(low, least);
        EXPECT_LE(jacobian.coarse_low(), low);
        EXPECT_LE(high - low, 1.1e-3 * size);
        EXPECT_LE(high, least + 0.02 * size);  // samples are apart
    }
}

TEST(CurvedTet, WhatIsCalledValidHasNoSampleBelowZeroAndWhatIsCalledInvalidHasOne) {
    RandomCells random(1);
    std::array<int, 3> counts = {};
    for (int i = 0; i < 3000; ++i) {
        const TetNodes nodes = random.next(random.number(0, 0.3));
        const CellValidity validity = CurvedTetJacobian(nodes).validity();
        ++counts[static_cast<std::size_t>(validity)];
        if (validity == CellValidity::valid) {
            EXPECT_GT(least_sampled(nodes, 8), 0);
        }
        if (validity == CellValidity::invalid) {
            EXPECT_LE(CurvedTetJacobian(nodes).bounds().low, 0);
        }
    }
    EXPECT_GT(counts[0], 300);
    EXPECT_GT(counts[1], 300);
    EXPECT_LE(counts[2], 3);
}

TEST(CurvedTet, VolumeIsTheIntegralOfTheDeterminant) {
    RandomCells random(4);
    for (int i = 0; i < 20; ++i) {
        const TetNodes nodes = random.next(0.3);
        constexpr int n = 20;
        double sum = 0, weight = 0;
        for (int a = 0; a < n; ++a)
            for (int b = 0; a + b < n; ++b)
                for (int c = 0; a + b + c < n; ++c) {
                    const int d = n - 1 - a - b - c;
                    sum += determinant_at(nodes, Eigen::Vector4d(a + 0.25, b + 0.25, c + 0.25, d + 0.25) / n);
                    ++weight;
                }
        EXPECT_NEAR(CurvedTetJacobian(nodes).volume(), sum / weight / 6, 0.02);
    }
}

TEST(CurvedTet, StraightCellsHaveOneDeterminant) {
    RandomCells random(2);
    for (int i = 0; i < 100; ++i) {
        const CurvedTetJacobian jacobian(random.next(0));
        for (const double c : jacobian.coefficients()) EXPECT_NEAR(c, jacobian.straight(), 1e-13);
        EXPECT_NEAR(scaled_jacobian(jacobian), 1, 1e-9 / jacobian.straight());
        if (jacobian.straight() > 1e-6) {
            EXPECT_EQ(jacobian.validity(), CellValidity::valid);
        }
    }
}

TEST(CurvedTet, AffineMapsLeaveTheScaledJacobian) {
    RandomCells random(3);
    for (int i = 0; i < 100; ++i) {
        const TetNodes nodes = random.next(0.1);
        Eigen::Matrix3d map;
        for (int c = 0; c < 3; ++c) map.col(c) = random.point();
        if (map.determinant() < 0) map.col(0) *= -1;
        const Vec3 shift = 3 * random.point();
        TetNodes mapped;
        for (std::size_t n = 0; n < nodes.size(); ++n) mapped[n] = map * nodes[n] + shift;
        const CurvedTetJacobian one(nodes), other(mapped);
        if (one.straight() < 0.01 || map.determinant() < 0.01) continue;
        for (std::size_t c = 0; c < 20; ++c)
            EXPECT_NEAR(other.coefficients()[c], map.determinant() * one.coefficients()[c], 1e-12);
        EXPECT_NEAR(scaled_jacobian(one), scaled_jacobian(other), 1e-9);
    }
}

TEST(CurvedTet, ANodeAtAQuarterOfItsEdgeHasAZeroAtTheCorner) {
    TetNodes nodes = straight_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
    nodes[4] = Vec3(0.25, 0, 0);
    EXPECT_NE(CurvedTetJacobian(nodes).validity(), CellValidity::valid);
    EXPECT_NEAR(scaled_jacobian(CurvedTetJacobian(nodes)), 0, 2e-3);
    nodes[4] = Vec3(0.26, 0, 0);
    EXPECT_EQ(CurvedTetJacobian(nodes).validity(), CellValidity::valid);
    nodes[4] = Vec3(0.24, 0, 0);
    EXPECT_EQ(CurvedTetJacobian(nodes).validity(), CellValidity::invalid);
}

TEST(CurvedTet, ACellWithoutVolumeIsNotValid) {
    const TetNodes flat = straight_nodes({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.3, 0.3, 0)});
    EXPECT_NE(CurvedTetJacobian(flat).validity(), CellValidity::valid);
}

}  // namespace
}  // namespace kerf

// Notation: l are the barycentric coordinates of a point of the triangle. Corner k has the share l_k (2 l_k - 1), and
// the node on the edge from a to b has 4 l_a l_b; these are the shape functions of a triangle of second order, for
// places, places at rest and values alike. The normal of the curved face is the cross product of the derivatives by l_1
// and l_2, with l_0 = 1 - l_1 - l_2. A triangle is drawn on a regular grid of pieces * pieces triangles; the number of
// pieces of a curved one depends on the size of the geometry alone, not on its curvature, so that two curved neighbours
// have the same points on their common edge and no gap opens. Interpolated values are clamped to those of the nodes,
// since a quadratic function overshoots: a length would fall below zero, and a picture show values that the solution
// does not have.
#include "viewer/scene/inside/quadratic_triangle.h"

#include <algorithm>
#include <cmath>

#include "viewer/scene/inside/drawn_triangles.h"

namespace kerf::view {

namespace {

constexpr double straight_share = 1e-5;  // of the edge: largest distance of a straight edge's node from the middle
constexpr float linear_share = 1e-3f;    // of the values: a difference that no colour shows
constexpr std::size_t many = 100000, most = 400000;

using Shares = std::array<double, 3>;

Vec3 mixed_place(const std::array<Vec3, 6>& nodes, const std::array<double, 6>& shares) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < nodes.size(); ++i) sum += shares[i] * nodes[i];
    return sum;
}

// A value between those of the nodes, so that the least and the largest value of a picture are those that reports have,
// and a length is not below zero.
float mixed_value(const std::array<float, 6>& nodes, const std::array<double, 6>& shares) {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (shares[i] != 0) sum += shares[i] * nodes[i];
    const auto [least, largest] = std::minmax_element(nodes.begin(), nodes.end());
    return std::clamp(static_cast<float>(sum), *least, *largest);
}

// The outward normal of the curved face, of any length.
Vec3 normal_at(const QuadraticTriangle& t, const Shares& l) {
    std::array<Vec3, 3> slope;
    for (std::size_t k = 0; k < 3; ++k) slope[k] = (4 * l[k] - 1) * t.place[k];
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [a, b] = ends_of_edges[e];
        slope[a] += 4 * l[b] * t.place[3 + e];
        slope[b] += 4 * l[a] * t.place[3 + e];
    }
    return (slope[1] - slope[0]).cross(slope[2] - slope[0]);
}

}  // namespace

QuadraticTriangle quadratic_triangle(const DrawnVertices& vertices, const DrawnEdges& edges, const Triangle& corners,
                                     const std::array<std::int32_t, 3>& on_edges, float value) {
    QuadraticTriangle t;
    t.value.fill(value);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int32_t v = corners[k], e = on_edges[k];
        t.place[k] = vertices.places[v];
        t.place[3 + k] = edges.places[e];
        t.rest[k] = vertices.rest[v];
        t.rest[3 + k] = edges.rest[e];
        if (vertices.value.empty()) continue;
        t.value[k] = vertices.value[v];
        t.value[3 + k] = edges.value[e];
    }
    return t;
}

std::array<double, 6> quadratic_shares(const std::array<double, 3>& l) {
    std::array<double, 6> shares = {};
    for (std::size_t k = 0; k < 3; ++k) shares[k] = l[k] * (2 * l[k] - 1);
    for (std::size_t e = 0; e < 3; ++e) shares[3 + e] = 4 * l[ends_of_edges[e][0]] * l[ends_of_edges[e][1]];
    return shares;
}

bool QuadraticTriangle::is_straight() const {
    for (std::size_t e = 0; e < 3; ++e) {
        const Vec3 &a = place[ends_of_edges[e][0]], &b = place[ends_of_edges[e][1]];
        if ((place[3 + e] - (a + b) / 2).norm() > straight_share * (b - a).norm()) return false;
    }
    return true;
}

bool QuadraticTriangle::is_linear() const {
    float largest = 0;
    for (const float v : value) largest = std::max(largest, std::abs(v));
    for (std::size_t e = 0; e < 3; ++e) {
        const float a = value[ends_of_edges[e][0]], b = value[ends_of_edges[e][1]];
        if (std::abs(value[3 + e] - (a + b) / 2) > linear_share * largest) return false;
    }
    return true;
}

int pieces_of(const QuadraticTriangle& triangle, std::size_t count) {
    if (!triangle.is_straight()) return count > most ? 2 : count > many ? 3 : 4;
    return triangle.is_linear() || count > most ? 1 : 2;
}

void add_quadratic(Geometry& geometry, const Frame& frame, const QuadraticTriangle& triangle, int pieces,
                   std::int32_t element, bool is_moved) {
    const bool is_curved = pieces > 1 && !triangle.is_straight();
    const bool has_normals = is_curved || triangle.normals;
    geometry.has_normals |= is_curved;
    const auto normal = [&](const Shares& l) -> Vec3 {
        if (is_curved) return normal_at(triangle, l);
        return l[0] * (*triangle.normals)[0] + l[1] * (*triangle.normals)[1] + l[2] * (*triangle.normals)[2];
    };
    const auto shares_at = [&](int i, int j) -> Shares {  // i steps towards corner 1, j towards corner 2
        const double n = pieces;
        return {(pieces - i - j) / n, i / n, j / n};
    };
    const auto add = [&](const std::array<std::array<int, 2>, 3>& steps, std::uint16_t edges) {
        Corners corners, rest;
        std::array<float, 3> values = {};
        std::array<Vec3, 3> normals;
        for (std::size_t k = 0; k < 3; ++k) {
            const Shares l = shares_at(steps[k][0], steps[k][1]);
            const std::array<double, 6> shares = quadratic_shares(l);
            corners[k] = mixed_place(triangle.place, shares);
            rest[k] = mixed_place(triangle.rest, shares);
            values[k] = mixed_value(triangle.value, shares);
            if (has_normals) normals[k] = normal(l);
        }
        add_triangle(geometry, frame, corners, 0, edges, element);
        set_corner_values(geometry, values);
        if (is_moved) add_rest(geometry, frame, rest);
        for (std::size_t k = 0; has_normals && k < 3; ++k)
            (geometry.corners.end() - 3 + k)->normal = packed_normal(normals[k]);
    };
    for (int j = 0; j < pieces; ++j)
        for (int i = 0; i + j < pieces; ++i) {
            // Edge k goes from corner k to the next one.
            std::uint16_t edges = 0;
            if (j == 0) edges |= 1;
            if (i + j + 1 == pieces) edges |= 2;
            if (i == 0) edges |= 4;
            add({{{i, j}, {i + 1, j}, {i, j + 1}}}, edges);
            if (i + j + 1 < pieces) add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}}, 0);
        }
}

}  // namespace kerf::view

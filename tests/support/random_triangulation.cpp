#include "support/random_triangulation.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/geometry/predicates.h"

namespace kerf::test {

namespace {

// 1 if a, b, c are counter-clockwise. Exact.
int turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    const auto flat = [](const Vec2& p) { return Vec3(p[0], p[1], 0); };
    return orientation(flat(a), flat(b), flat(c), Vec3(a[0], a[1], 1));
}

// Over the longest edge.
double height(const Vec2& a, const Vec2& b, const Vec2& c) {
    const Vec2 u = b - a, v = c - a;
    return std::abs(u[0] * v[1] - u[1] * v[0]) / std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
}

bool is_in_triangle(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    return turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
}

}  // namespace

RandomTriangulation::RandomTriangulation(std::vector<Vec2> corners, double least_height, SeededNumbers& random)
    : points_(std::move(corners)), least_height_(least_height) {
    std::vector<std::int32_t> polygon(points_.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) polygon[i] = static_cast<std::int32_t>(i);
    while (polygon.size() >= 3) {
        const std::size_t n = polygon.size(), first = random.bits() % n;
        std::size_t ear = n;
        for (const double lowest : {least_height_, 0.0})
            for (std::size_t i = 0; i < n && ear == n; ++i)
                if (is_ear(polygon, (first + i) % n, lowest)) ear = (first + i) % n;
        if (ear == n) {
            triangles_.clear();
            return;
        }
        triangles_.push_back({polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n]});
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(ear));
    }
}

bool RandomTriangulation::is_high(std::int32_t a, std::int32_t b, std::int32_t c) const {
    return turn(points_[a], points_[b], points_[c]) > 0 && height(points_[a], points_[b], points_[c]) >= least_height_;
}

bool RandomTriangulation::is_ear(const std::vector<std::int32_t>& polygon, std::size_t i, double least_height) const {
    const std::size_t n = polygon.size();
    const Vec2 &a = points_[polygon[(i + n - 1) % n]], &b = points_[polygon[i]], &c = points_[polygon[(i + 1) % n]];
    if (turn(a, b, c) <= 0 || height(a, b, c) < least_height) return false;
    for (std::size_t k = 2; k + 1 < n; ++k)
        if (is_in_triangle(points_[polygon[(i + k) % n]], a, b, c)) return false;
    return true;
}

std::optional<std::size_t> RandomTriangulation::triangle_at(std::int32_t from, std::int32_t to) const {
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            if (triangles_[t][i] == from && triangles_[t][(i + 1) % 3] == to) return t;
    return std::nullopt;
}

bool RandomTriangulation::insert(const Vec2& p) {
    const auto contains = [&](const Triangle& t) {
        return is_in_triangle(p, points_[t[0]], points_[t[1]], points_[t[2]]);
    };
    const auto found = std::find_if(triangles_.begin(), triangles_.end(), contains);
    if (found == triangles_.end()) return false;
    const auto inserted = static_cast<std::int32_t>(points_.size());
    std::vector<std::size_t> old = {static_cast<std::size_t>(found - triangles_.begin())};
    std::vector<UndirectedEdge> edges;  // from the first end to the second, counter-clockwise around p
    const Triangle t = *found;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t a = t[i], b = t[(i + 1) % 3];
        if (turn(points_[a], points_[b], p) > 0) {
            edges.push_back({a, b});
        } else {
            const auto across = triangle_at(b, a);
            if (!across || old.size() > 1) return false;
            old.push_back(*across);
            Triangle other = triangles_[*across];
            std::rotate(other.begin(), std::find(other.begin(), other.end(), b), other.end());
            edges.push_back({other[1], other[2]});
            edges.push_back({other[2], other[0]});
        }
    }
    points_.push_back(p);
    if (!std::all_of(edges.begin(), edges.end(), [&](const auto& e) { return is_high(e[0], e[1], inserted); })) {
        points_.pop_back();
        return false;
    }
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const Triangle made = {edges[k][0], edges[k][1], inserted};
        if (k < old.size())
            triangles_[old[k]] = made;
        else
            triangles_.push_back(made);
    }
    return true;
}

bool RandomTriangulation::flip_edge(std::size_t triangle, int i) {
    const Triangle& t = triangles_[triangle];
    const std::int32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
    const auto across = triangle_at(b, a);
    if (!across) return false;
    const Triangle& other = triangles_[*across];
    const std::int32_t d = *std::find_if(other.begin(), other.end(), [&](auto v) { return v != a && v != b; });
    if (!is_high(a, d, c) || !is_high(d, b, c)) return false;
    triangles_[triangle] = {a, d, c};
    triangles_[*across] = {d, b, c};
    return true;
}

void RandomTriangulation::flip(int tries, SeededNumbers& random) {
    for (int k = 0; k < tries && !triangles_.empty(); ++k) {
        const std::size_t triangle = random.bits() % triangles_.size();
        flip_edge(triangle, random.integer(0, 2));
    }
}

void RandomTriangulation::grow_star(std::int32_t point) {
    bool is_changed = true;
    for (int round = 0; round < 50 && is_changed; ++round) {
        is_changed = false;
        for (std::size_t k = 0; k < triangles_.size(); ++k)
            for (int i = 0; i < 3; ++i)
                if (triangles_[k][(i + 2) % 3] == point) is_changed |= flip_edge(k, i);
    }
}

}  // namespace kerf::test

#include "support/faceted_prism.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>

#include "support/random_triangulation.h"

namespace kerf::test {

namespace {

using Loop = std::vector<std::int32_t>;
using Lift = std::function<Vec3(const Vec2&)>;

// Points of a pattern, wherever they lie.
class PointSource {
 public:
    PointSource(const std::vector<Vec2>& around, const FaceStyle& style, SeededNumbers& random)
        : style_(style), random_(random) {
        for (const Vec2& p : around) box_.extend(p);
        columns_ = std::max(1, static_cast<int>(std::sqrt(style.points)));
        centre_ = anywhere();
        radius_ = random.between(0.1, 0.5) * box_.sizes().minCoeff();
    }

    Vec2 point(int k, const RandomTriangulation& triangulation) {
        switch (style_.pattern) {
            case Pattern::random:
                return anywhere();
            case Pattern::grid:
                return in_box((k / columns_ + 1.0) / (columns_ + 1), (k % columns_ + 1.0) / (columns_ + 1));
            case Pattern::circle: {
                const double angle = 2 * std::numbers::pi * k / style_.points;
                return centre_ + radius_ * Vec2(std::cos(angle), std::sin(angle));
            }
            case Pattern::cluster: {
                const Vec2 away = anywhere() - centre_;
                return centre_ + random_.magnitude(1e-5, 1) * away;
            }
            case Pattern::near_edges:
                return near_edge(triangulation);
        }
        return anywhere();
    }

 private:
    Vec2 in_box(double x, double y) const { return box_.min() + Vec2(x, y).cwiseProduct(box_.sizes()); }
    Vec2 anywhere() {
        const double x = random_.share();
        return in_box(x, random_.share());
    }
    Vec2 near_edge(const RandomTriangulation& triangulation) {
        const Triangle& t = triangulation.triangles()[random_.bits() % triangulation.triangles().size()];
        const auto p = [&](int i) -> const Vec2& { return triangulation.points()[t[i]]; };
        const double far = 2 * style_.least_height * random_.magnitude(1, 100), along = random_.between(0.2, 0.8);
        return far * p(0) + (1 - far) * (along * p(1) + (1 - along) * p(2));
    }

    const FaceStyle& style_;
    SeededNumbers& random_;
    Eigen::AlignedBox2d box_;
    int columns_;
    Vec2 centre_;
    double radius_;
};

class PrismBuilder {
 public:
    PrismBuilder(const std::vector<Vec2>& polygon, double height, const PrismStyle& style, SeededNumbers& random)
        : polygon_(polygon), height_(height), style_(style), random_(random) {}

    Soup build() {
        const std::size_t n = polygon_.size();
        std::vector<Loop> below(n), above(n), upright(n);  // with both ends
        std::vector<std::int32_t> low(n), high(n);
        for (std::size_t i = 0; i < n; ++i) {
            low[i] = add(lower(polygon_[i]));
            high[i] = add(upper(polygon_[i]));
        }
        for (std::size_t i = 0; i < n; ++i) {
            below[i] = divided(low[i], low[(i + 1) % n], style_.edge_parts);
            above[i] = divided(high[i], high[(i + 1) % n], style_.edge_parts);
            upright[i] = divided(low[i], high[i], style_.height_parts);
        }
        add_caps(below, above);
        for (std::size_t i = 0; i < n; ++i) add_wall(below[i], above[i], upright[i], upright[(i + 1) % n]);
        soup_.patch.assign(soup_.facets.size(), 0);
        soup_.patch_names = {"prism"};
        return std::move(soup_);
    }

 private:
    std::int32_t add(const Vec3& p) {
        soup_.vertices.push_back(p);
        return static_cast<std::int32_t>(soup_.vertices.size()) - 1;
    }
    Vec3 lower(const Vec2& p) const { return {p[0], p[1], 0}; }
    Vec3 upper(const Vec2& p) const {
        const Vec2 turned = style_.twist == 0 ? p : Vec2(Eigen::Rotation2Dd(style_.twist) * p);
        return {turned[0], turned[1], height_};
    }

    Loop divided(std::int32_t from, std::int32_t to, int most_parts) {
        std::vector<double> shares;
        for (int k = random_.integer(1, most_parts); k > 1; --k) shares.push_back(random_.between(0.05, 0.95));
        std::sort(shares.begin(), shares.end());
        Loop loop = {from};
        const Vec3 a = soup_.vertices[from], b = soup_.vertices[to];
        for (const double share : shares) loop.push_back(add(a + share * (b - a)));
        loop.push_back(to);
        return loop;
    }

    static void append(Loop& loop, const Loop& piece) { loop.insert(loop.end(), piece.begin(), piece.end() - 1); }
    static Loop reversed(const Loop& loop) { return {loop.rbegin(), loop.rend()}; }

    void add_caps(const std::vector<Loop>& below, const std::vector<Loop>& above) {
        Loop under, over;
        for (const Loop& piece : below) append(under, piece);
        for (const Loop& piece : above) append(over, piece);
        const auto corners = [&](const Loop& loop) {
            std::vector<Vec2> all;
            for (const std::int32_t v : loop) all.emplace_back(soup_.vertices[v].head<2>());
            return all;
        };
        add_face(over, corners(over), style_.cap, false,
                 [&](const Vec2& p) { return Vec3(p[0], p[1], height_ - indent()); });
        add_face(under, corners(under), style_.cap, true, [&](const Vec2& p) { return Vec3(p[0], p[1], indent()); });
    }
    double indent() {
        if (style_.roughness == 0) return 0;
        const double most = std::min(style_.roughness * random_.share(), 1 - style_.least_gap);
        const bool is_deep = style_.least_gap < 1e-3 && random_.with_chance(0.3);
        return height_ / 2 * (is_deep ? 1 - random_.magnitude(style_.least_gap, 1) : most);
    }

    void add_wall(const Loop& below, const Loop& above, const Loop& left, const Loop& right) {
        Loop loop;
        append(loop, below);
        append(loop, right);
        append(loop, reversed(above));
        append(loop, reversed(left));
        const Vec3 a = soup_.vertices[below.front()], b = soup_.vertices[below.back()],
                   c = soup_.vertices[above.front()], d = soup_.vertices[above.back()];
        const double length = (b - a).norm();
        std::vector<Vec2> corners;
        const auto place = [&](const Loop& piece, const Vec3& start, const Vec3& end, const Vec2& from,
                               const Vec2& to) {
            for (std::size_t k = 0; k + 1 < piece.size(); ++k) {
                const double share = (soup_.vertices[piece[k]] - start).norm() / (end - start).norm();
                corners.emplace_back(from + share * (to - from));
            }
        };
        place(below, a, b, {0, 0}, {length, 0});
        place(right, b, d, {length, 0}, {length, height_});
        place(reversed(above), d, c, {length, height_}, {0, height_});
        place(reversed(left), c, a, {0, height_}, {0, 0});
        add_face(loop, corners, style_.wall, false, [&](const Vec2& p) {
            const double x = p[0] / length, z = p[1] / height_;
            return Vec3((1 - z) * (a + x * (b - a)) + z * (c + x * (d - c)));
        });
    }

    // `corners`: of the loop, counter-clockwise.
    void add_face(const Loop& loop, const std::vector<Vec2>& corners, const FaceStyle& style, bool is_turned,
                  const Lift& lift) {
        RandomTriangulation triangulation(corners, style.least_height, random_);
        if (triangulation.triangles().empty()) return;  // open: no valid surface
        PointSource source(corners, style, random_);
        const int points = style_.twist == 0 ? style.points : 0;
        for (int k = 0; k < points; ++k) triangulation.insert(source.point(k, triangulation));
        triangulation.flip(static_cast<int>(style.flips * static_cast<double>(triangulation.triangles().size())),
                           random_);
        const std::size_t count = triangulation.points().size();
        if (style.has_star) triangulation.grow_star(static_cast<std::int32_t>(random_.bits() % count));
        Loop number = loop;
        for (std::size_t v = loop.size(); v < count; ++v) number.push_back(add(lift(triangulation.points()[v])));
        for (const auto& [a, b, c] : triangulation.triangles())
            soup_.facets.push_back(is_turned ? Triangle{number[a], number[c], number[b]}
                                             : Triangle{number[a], number[b], number[c]});
    }

    const std::vector<Vec2>& polygon_;
    double height_;
    const PrismStyle& style_;
    SeededNumbers& random_;
    Soup soup_;
};

}  // namespace

Soup faceted_prism(const std::vector<Vec2>& polygon, double height, const PrismStyle& style, SeededNumbers& random) {
    return PrismBuilder(polygon, height, style, random).build();
}

Soup faceted_box(const Vec3& low, const Vec3& high, const PrismStyle& style, SeededNumbers& random) {
    const Vec2 size = (high - low).head<2>();
    Soup soup = faceted_prism({{0, 0}, {size[0], 0}, size, {0, size[1]}}, high[2] - low[2], style, random);
    for (Vec3& p : soup.vertices) p += low;
    return soup;
}

}  // namespace kerf::test

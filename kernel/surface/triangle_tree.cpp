#include "surface/triangle_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "core/check.h"
#include "core/elements.h"
#include "surface/closest_point.h"

namespace kerf {

namespace {

constexpr std::int32_t triangles_of_leaf = 4;
constexpr double needle = 1e-12;  // squared height over squared longest edge, below which the plane is not trusted

}  // namespace

Vec3 closest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a;
    const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
    if (ab.cross(ac).squaredNorm() > needle * longest * longest) {
        const Vec3 t = closest_barycentric(p, a, b, c);
        return t[0] * a + t[1] * b + t[2] * c;
    }
    Vec3 best = closest_on_segment(p, a, b);
    for (const Vec3& other : {closest_on_segment(p, b, c), closest_on_segment(p, c, a)})
        if ((p - other).squaredNorm() < (p - best).squaredNorm()) best = other;
    return best;
}

TriangleTree::TriangleTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
    : order_(facets.size()), place_(facets.size()) {
    KERF_CHECK(are_in_range(facets, vertices.size()));
    std::iota(order_.begin(), order_.end(), 0);
    std::vector<Vec3> centres;
    centres.reserve(facets.size());
    corners_.reserve(facets.size());
    for (const Triangle& t : facets) {
        corners_.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
        centres.push_back((corners_.back()[0] + corners_.back()[1] + corners_.back()[2]) / 3);
    }
    nodes_.push_back({{}, 0, static_cast<std::int32_t>(facets.size())});
    for (std::size_t node = 0; node < nodes_.size(); ++node) split(node, centres);
    std::vector<std::array<Vec3, 3>> ordered;
    ordered.reserve(facets.size());
    for (std::size_t i = 0; i < order_.size(); ++i) {
        ordered.push_back(corners_[order_[i]]);
        place_[order_[i]] = static_cast<std::int32_t>(i);
    }
    corners_ = std::move(ordered);
}

void TriangleTree::split(std::size_t node, const std::vector<Vec3>& centres) {
    const auto [first, count] = std::pair(nodes_[node].first, nodes_[node].count);
    const auto begin = order_.begin() + first, end = begin + count;
    Eigen::AlignedBox3d of_centres;
    for (auto i = begin; i != end; ++i) {
        for (const Vec3& corner : corners_[*i]) nodes_[node].box.extend(corner);
        of_centres.extend(centres[*i]);
    }
    if (count <= triangles_of_leaf) return;
    Eigen::Index axis = 0;
    of_centres.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
        return std::pair(centres[a][axis], a) < std::pair(centres[b][axis], b);
    });
    nodes_[node].left = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, count - half});
}

double TriangleTree::squared_distance(const Vec3& p, std::int32_t place) const {
    const auto& [a, b, c] = corners_[place];
    return (p - closest_point(p, a, b, c)).squaredNorm();
}

TriangleTree::Closest TriangleTree::closest(const Vec3& p, double squared_limit) const {
    Closest best;
    best.squared_distance = squared_limit;
    struct Open {
        std::int32_t node;
        double squared;
    };
    std::array<Open, 64> open;
    int count = 0;
    open[count++] = {0, nodes_[0].box.squaredExteriorDistance(p)};
    while (count > 0) {
        const Open next = open[--count];
        if (next.squared >= best.squared_distance) continue;
        const Node& node = nodes_[next.node];
        if (node.left > 0) {
            Open near = {node.left, nodes_[node.left].box.squaredExteriorDistance(p)};
            Open far = {node.left + 1, nodes_[node.left + 1].box.squaredExteriorDistance(p)};
            if (far.squared < near.squared) std::swap(near, far);
            open[count++] = far;
            open[count++] = near;
            continue;
        }
        for (std::int32_t i = node.first; i < node.first + node.count; ++i) {
            const auto& [a, b, c] = corners_[i];
            const Vec3 point = closest_point(p, a, b, c);
            const double squared = (p - point).squaredNorm();
            if (squared < best.squared_distance) best = {order_[i], squared, point};
        }
    }
    return best;
}

// Möller and Trumbore 1997.
double TriangleTree::ray_distance(std::int32_t place, const Vec3& origin, const Vec3& direction) const {
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto& [a, b, c] = corners_[place];
    const Vec3 ab = b - a, ac = c - a, normal = direction.cross(ac);
    const double determinant = ab.dot(normal);
    if (determinant == 0) return none;
    const Vec3 from_a = origin - a;
    const double u = from_a.dot(normal) / determinant;
    if (!(u >= 0 && u <= 1)) return none;
    const Vec3 q = from_a.cross(ab);
    const double v = direction.dot(q) / determinant;
    return v >= 0 && u + v <= 1 ? ac.dot(q) / determinant : none;
}

bool TriangleTree::ray_meets(const Eigen::AlignedBox3d& box, const Vec3& origin, const Vec3& direction, double from,
                             double to) {
    for (int i = 0; i < 3; ++i) {
        if (direction[i] == 0) {
            if (origin[i] < box.min()[i] || origin[i] > box.max()[i]) return false;
            continue;
        }
        const double s = (box.min()[i] - origin[i]) / direction[i], t = (box.max()[i] - origin[i]) / direction[i];
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    return from <= to;
}

}  // namespace kerf

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

constexpr std::int32_t pieces_of_leaf = 4;
constexpr double needle = 1e-12;  // squared height over squared longest edge, below which the plane is not trusted
constexpr double fat = 8;         // a box over its triangle, by area: beyond that it is the box of something else
constexpr int most_halvings = 3;

double area_of(const Eigen::AlignedBox3d& box) {
    const Vec3 sides = box.sizes();
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

// The boxes of triangles: several for one that its box does not describe, as those of needles across the axes.
struct Pieces {
    std::vector<Eigen::AlignedBox3d> boxes;
    std::vector<std::int32_t> facets;
    std::int32_t facet = 0;  // whose pieces are added

    void add(const std::array<Vec3, 3>& t, int halvings) {
        Eigen::AlignedBox3d box(t[0]);
        box.extend(t[1]).extend(t[2]);
        const double area = (t[1] - t[0]).cross(t[2] - t[0]).norm() / 2;
        if (halvings > 0 && area > 0 && area_of(box) > fat * area) {
            int longest = 0;
            for (int i = 1; i < 3; ++i)
                if ((t[(i + 1) % 3] - t[i]).squaredNorm() > (t[(longest + 1) % 3] - t[longest]).squaredNorm())
                    longest = i;
            const Vec3 &a = t[longest], &b = t[(longest + 1) % 3], &c = t[(longest + 2) % 3];
            const Vec3 middle = (a + b) / 2;
            add({a, middle, c}, halvings - 1);
            add({middle, b, c}, halvings - 1);
            return;
        }
        boxes.push_back(box);
        facets.push_back(facet);
    }
};

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
    : place_(facets.size()) {
    KERF_CHECK(are_in_range(facets, vertices.size()));
    Pieces pieces;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Triangle& t = facets[f];
        pieces.facet = static_cast<std::int32_t>(f);
        pieces.add({vertices[t[0]], vertices[t[1]], vertices[t[2]]}, most_halvings);
    }
    order_.resize(pieces.facets.size());
    std::iota(order_.begin(), order_.end(), 0);
    nodes_.push_back({{}, 0, static_cast<std::int32_t>(order_.size())});
    for (std::size_t node = 0; node < nodes_.size(); ++node) split(node, pieces.boxes);
    nodes_.shrink_to_fit();
    corners_.reserve(order_.size());
    for (std::int32_t& of : order_) {
        of = pieces.facets[of];
        place_[of] = static_cast<std::int32_t>(corners_.size());
        corners_.push_back({vertices[facets[of][0]], vertices[facets[of][1]], vertices[facets[of][2]]});
    }
}

void TriangleTree::split(std::size_t node, const std::vector<Eigen::AlignedBox3d>& boxes) {
    const auto [first, count] = std::pair(nodes_[node].first, nodes_[node].count);
    const auto begin = order_.begin() + first, end = begin + count;
    Eigen::AlignedBox3d of_centres;
    for (auto i = begin; i != end; ++i) {
        nodes_[node].box.extend(boxes[*i]);
        of_centres.extend(boxes[*i].center());
    }
    if (count <= pieces_of_leaf) return;
    Eigen::Index axis = 0;
    of_centres.sizes().maxCoeff(&axis);
    const std::int32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::int32_t a, std::int32_t b) {
        return std::pair(boxes[a].center()[axis], a) < std::pair(boxes[b].center()[axis], b);
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

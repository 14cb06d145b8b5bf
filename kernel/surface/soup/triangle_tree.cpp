// A BoxHierarchy over triangles. A triangle whose box is much larger than itself, such as a needle across the axes, is
// halved at its longest edge, up to three times, and each piece has a leaf with a box of its own: otherwise every query
// in the nearly empty box would have to look at the triangle. So a triangle may be met several times; distances are
// always those of the whole triangle. Corners are stored in the order of the leaves, so that a query reads memory in a
// row: order_[leaf] is the facet, place_[facet] one of its leaves.
#include "surface/soup/triangle_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

constexpr double needle = 1e-12;  // squared height over squared longest edge, below which the plane is not trusted
constexpr double fat = 8;         // a box over its triangle, by area: beyond that it is the box of something else
constexpr int most_halvings = 3;

double area_of(const Box& box) {
    const Vec3 sides = box.sizes();
    return sides[0] * sides[1] + sides[1] * sides[2] + sides[2] * sides[0];
}

// The boxes of triangles, or of their pieces where the box of the triangle would be mostly empty.
struct Pieces {
    std::vector<Box> boxes;
    std::vector<std::int32_t> facets;
    std::int32_t facet = 0;  // whose pieces are added

    void add(const std::array<Vec3, 3>& t, int halvings) {
        const Box box = box_around(t);
        const double area = triangle_area(t);
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
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        const Triangle& t = facets[f];
        pieces.facet = f;
        pieces.add({vertices[t[0]], vertices[t[1]], vertices[t[2]]}, most_halvings);
    }
    order_.resize(pieces.facets.size());
    std::iota(order_.begin(), order_.end(), 0);
    hierarchy_ = make_hierarchy(pieces.boxes, order_);
    for (std::int32_t i = 0; i < count_of(order_); ++i) {
        order_[i] = pieces.facets[order_[i]];
        place_[order_[i]] = i;
    }
    pieces = {};
    corners_.resize(order_.size());
    constexpr std::size_t grain = 1 << 14;
    for_ranges_on_threads(order_.size(), grain, [&](const IndexRange& range) {
        for (std::size_t i = range.first; i < range.last; ++i) {
            const Triangle& t = facets[order_[i]];
            corners_[i] = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
        }
    });
}

double TriangleTree::squared_distance(const Vec3& p, std::int32_t place) const {
    const auto& [a, b, c] = corners_[place];
    return (p - closest_point(p, a, b, c)).squaredNorm();
}

TriangleTree::Closest TriangleTree::closest(const Vec3& p, double squared_limit) const {
    Closest best;
    best.squared_distance = squared_limit;
    const auto of_box = [&](const BoxNode& node) { return node.box.squaredExteriorDistance(p); };
    hierarchy_.least(squared_limit, of_box, [&](std::int32_t i) {
        const auto& [a, b, c] = corners_[i];
        const Vec3 point = closest_point(p, a, b, c);
        const double squared = (p - point).squaredNorm();
        if (squared < best.squared_distance) best = {order_[i], squared, point};
        return squared;
    });
    return best;
}

}  // namespace kerf

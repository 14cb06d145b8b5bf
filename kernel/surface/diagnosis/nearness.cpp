// The proof of Nearness::holds(): a stack of convex polygons, beginning with the triangle in question. A polygon is
// done when all its corners are within the limit of one facet, as the distance to a convex set is convex. Otherwise it
// is cut along the three planes that stand on the sides of the facet below its centre; the pieces outside begin with
// the neighbours as their facets `near`. A polygon much longer than the facet below it, or one that this does not
// divide, is halved across its longest extent. Pieces thinner than `thinnest` of the limit are none, which is what
// stops the division at common edges. The proof gives up on a polygon with a corner that is near no facet, and on
// pieces too small to be divided.
// A frame has the directions of a facet: its normal, and for each edge the unit vector in its plane that points out of
// it. Those of needles are noise, so the distance to a needle is computed by its edges.
#include "surface/diagnosis/nearness.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

constexpr double much_longer = 4;        // times as long as the facet below it: beyond that it is rather halved
constexpr double flattest = 1e-6;        // height over length of a facet, below which its directions are noise
constexpr double thinnest = 1e-6;        // of the limit: pieces as thin as that are none
constexpr int longest_walk = 40;         // from facet to facet: needles are crossed by the dozen
constexpr double shortest_piece = 1e-3;  // length of a polygon over the limit, below which it is not divided

template <class Corners>
Vec3 extent(const Corners& corners, int count) {
    return box_around(std::span(corners.data(), count)).sizes();
}

// Returns the vector from one corner of a polygon to another between which the distance is largest, or nearly so.
template <class Corners>
Vec3 longest_way(const Corners& corners, int count) {
    Vec3 longest = Vec3::Zero();
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < i; ++j)
            if (const Vec3 way = corners[i] - corners[j]; way.squaredNorm() > longest.squaredNorm()) longest = way;
    return longest;
}

}  // namespace

Nearness::Nearness(const TriangleTree& surface, const std::vector<Triangle>& facets) : surface_(surface) {
    constexpr std::size_t grain = 1 << 14;
    const auto made = std::make_shared<Facets>(Facets{edge_partners(facets), std::vector<Frame>(facets.size())});
    for_ranges_on_threads(facets.size(), grain, [&](const IndexRange& range) {
        for (std::size_t f = range.first; f < range.last; ++f) {
            const std::array<Vec3, 3>& t = surface.corners(f);
            const Vec3 normal = doubled_area_vector(t);
            Frame& frame = made->frames[f];
            frame = {t, {}, normal.normalized(), false};
            double longest = 0;
            for (int i = 0; i < 3; ++i) {
                const Vec3 along = t[(i + 1) % 3] - t[i];
                frame.outwards[i] = along.cross(normal).normalized();
                longest = std::max(longest, along.squaredNorm());
            }
            frame.is_needle = !(normal.norm() > flattest * longest);
        }
    });
    facets_ = made;
}

Vec3 Nearness::Polygon::centre() const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < count; ++i) sum += corners[i];
    return sum / count;
}

bool Nearness::Polygon::add(const Vec3& corner) {
    if (count == most_corners) return false;
    corners[count++] = corner;
    return true;
}

std::int32_t Nearness::facet_below(const Vec3& p, std::int32_t start) const {
    std::int32_t facet = start, came_from = -1;
    for (int step = 0; facet >= 0 && step < longest_walk; ++step) {
        const Frame& frame = facets_->frames[facet];
        std::int32_t across = -1;
        for (int i = 0; i < 3 && across < 0; ++i)
            if (3 * facet + i != came_from && frame.outwards[i].dot(p - frame.corners[i]) > 0) across = 3 * facet + i;
        if (across < 0) return facet;
        came_from = facets_->partner[across];
        facet = came_from < 0 ? -1 : came_from / 3;
    }
    return -1;
}

bool Nearness::is_within(const Polygon& p, std::int32_t facet, double limit) {
    if (limit < 0) return false;
    double largest = 0;
    for (int i = 0; i < p.count; ++i) {
        largest = std::max(largest, squared_distance(p.corners[i], facet));
        if (largest > limit * limit) return false;
    }
    squared_distance_ = std::max(squared_distance_, largest);
    return true;
}

bool Nearness::cut(const Polygon& p, const Vec3& origin, const Vec3& normal, Polygon& below, Polygon& above) {
    below.count = above.count = 0;
    bool is_below = false, is_above = false, has_room = true;
    for (int i = 0; i < p.count && has_room; ++i) {
        const Vec3 &a = p.corners[i], &b = p.corners[(i + 1) % p.count];
        const double height_a = normal.dot(a - origin), height_b = normal.dot(b - origin);
        is_below |= height_a < -1;
        is_above |= height_a > 1;
        if (height_a <= 1) has_room &= below.add(a);
        if (height_a >= -1) has_room &= above.add(a);
        if (std::min(height_a, height_b) < -1 && std::max(height_a, height_b) > 1) {
            const Vec3 middle = a + height_a / (height_a - height_b) * (b - a);
            has_room &= below.add(middle) && above.add(middle);
        }
    }
    if (!is_below) below.count = 0;
    if (!is_above) above.count = 0;
    return has_room;
}

bool Nearness::halve(const Polygon& p, double limit) {
    const Vec3 way = longest_way(p.corners, p.count), centre = p.centre();
    if (way.norm() <= shortest_piece * limit) return false;
    Polygon below, above;
    if (!cut(p, centre, way.normalized() / (thinnest * limit), below, above)) return false;
    above.near = below.near = p.near;
    open_.push_back(above);
    open_.push_back(below);
    return true;
}

bool Nearness::divide(const Polygon& p, std::int32_t facet, double limit) {
    const Frame& frame = facets_->frames[facet];
    const std::array<Vec3, 3>& t = frame.corners;
    if (extent(p.corners, p.count).squaredNorm() > much_longer * much_longer * extent(t, 3).squaredNorm()) return false;
    Polygon inside = p, below, above;
    const std::size_t before = open_.size();
    for (int i = 0; i < 3; ++i) {
        if (!cut(inside, t[i], frame.outwards[i] / (thinnest * limit), below, above) || below.count == 0) {
            open_.resize(before);
            return false;
        }
        if (above.count > 0) {
            const std::int32_t beyond = facets_->partner[3 * facet + i];
            above.near = beyond < 0 ? -1 : beyond / 3;
            open_.push_back(above);
        }
        inside = below;
    }
    if (open_.size() == before) return false;
    inside.near = facet;
    open_.push_back(inside);
    return true;
}

}  // namespace kerf

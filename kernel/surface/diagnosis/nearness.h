// A proof, instead of a sampling, that all of a triangle is near a surface.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "surface/soup/edge_corners.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

/// Proves that triangles are near a surface. The distance to a convex set is a convex function, so a polygon is as near
/// to a triangle as its corners are. A polygon that is not near one triangle of the surface as a whole is divided along
/// the sides of the triangle below it. Right up to the rounding of these divisions, some 1e-15 of the coordinates; so
/// is directed_distance().
///
/// Holds scratch memory: each thread needs a copy of its own, which is cheap.
class Nearness {
 public:
    /// Keeps the reference. `facets` are the facets of the tree. O(#F), on threads.
    Nearness(const TriangleTree& surface, const std::vector<Triangle>& facets);

    /// Whether every point of triangle `t` is within limit(f) of some facet f of the surface. limit(f) is negative for
    /// facets that do not count, and `largest_limit` at least as large as any limit. Also false if the proof takes more
    /// than `steps` divisions, or if the triangle is nearly too far, within a thousandth of the limit. `hint` is a
    /// facet to begin with, -1 for none, and becomes the facet met last. O(log #F) if `t` is about as large as the
    /// facets below it.
    template <class Limit>
    bool holds(const std::array<Vec3, 3>& t, double largest_limit, Limit limit, int steps, std::int32_t& hint) {
        open_.clear();
        open_.push_back({{t[0], t[1], t[2]}, 3, hint});
        for (; !open_.empty(); --steps) {
            if (steps == 0) return false;
            const Polygon p = open_.back();
            open_.pop_back();
            if (p.near >= 0 && is_within(p, p.near, limit(p.near))) {
                hint = p.near;
                continue;
            }
            const Vec3 centre = p.centre();
            if (const std::int32_t below = facet_below(centre, p.near);
                below >= 0 && squared_distance(centre, below) <= std::pow(std::max(limit(below), 0.0), 2)) {
                hint = below;
                if (is_within(p, below, limit(below)) || divide(p, below, largest_limit)) continue;
            }
            const TriangleTree::Closest closest = surface_.closest(centre, largest_limit * largest_limit);
            if (closest.facet >= 0 && is_within(p, closest.facet, limit(closest.facet))) {
                hint = closest.facet;
                continue;
            }
            find_beside(centre, std::sqrt(closest.squared_distance), largest_limit, limit);
            if (beside_.empty()) return false;
            hint = beside_.front();
            const auto is_near = [&](std::int32_t f) { return is_within(p, f, limit(f)); };
            const auto divides = [&](std::int32_t f) { return divide(p, f, largest_limit); };
            if (std::any_of(beside_.begin(), beside_.end(), is_near) ||
                std::any_of(beside_.begin(), beside_.end(), divides))
                continue;
            if (has_far_corner(p, hint, largest_limit, limit) || !halve(p, largest_limit)) return false;
        }
        return true;
    }

    /// Returns the facet that p lies over, found by walking from neighbour to neighbour, or -1 if there is none or the
    /// walk does not find it.
    std::int32_t facet_below(const Vec3& p, std::int32_t start) const;

    /// Returns the squared distance of p from a facet, by the facet's frame where p lies over it.
    double squared_distance(const Vec3& p, std::int32_t facet) const {
        const Frame& frame = facets_->frames[facet];
        if (frame.is_needle || !frame.has_below(p)) return surface_.squared_distance_to(p, facet);
        const double height = frame.normal.dot(p - frame.corners[0]);
        return height * height;
    }

    /// An upper bound on the distance from the surface of all that holds() has found near so far. It is attained: some
    /// corner of a division is as far from the facet that it was compared with.
    double directed_distance() const { return std::sqrt(squared_distance_); }

 private:
    struct Polygon {  // convex
        static constexpr int most_corners = 12;
        std::array<Vec3, most_corners> corners;
        int count = 0;
        std::int32_t near = -1;  // a facet that may be near, or -1

        Vec3 centre() const;
        /// Returns false if there is no room for the corner.
        bool add(const Vec3& corner);
    };

    /// Finds the facets that count and are closest to a point, `distance` away; there are several beside an edge or a
    /// vertex.
    template <class Limit>
    void find_beside(const Vec3& p, double distance, double largest_limit, Limit limit) {
        constexpr double as_close = 1 + 1e-6, next_to_nothing = 1e-6;  // of the distance, of the limit
        beside_.clear();
        if (distance >= largest_limit) return;
        surface_.any_within(p, as_close * distance + next_to_nothing * largest_limit, [&](std::int32_t f, double) {
            if (limit(f) >= 0) beside_.push_back(f);
            return false;
        });
        if (beside_.empty())  // the closest one does not count
            surface_.any_within(p, largest_limit, [&](std::int32_t f, double) {
                if (limit(f) >= 0) beside_.push_back(f);
                return !beside_.empty();
            });
    }
    /// Whether some corner is near no facet, so that dividing the polygon is not worth while. `facet` is tried first.
    template <class Limit>
    bool has_far_corner(const Polygon& p, std::int32_t facet, double largest_limit, Limit limit) const {
        const auto is_near = [&](std::int32_t f, double squared) {
            const double most = limit(f);
            return most >= 0 && squared <= most * most;
        };
        return std::any_of(p.corners.begin(), p.corners.begin() + p.count, [&](const Vec3& corner) {
            return !is_near(facet, squared_distance(corner, facet)) &&
                   !surface_.any_within(corner, largest_limit, is_near);
        });
    }
    bool is_within(const Polygon& p, std::int32_t facet, double limit);
    /// Replaces p by its pieces over the facet and beside it; false if there is only one.
    bool divide(const Polygon& p, std::int32_t facet, double limit);
    /// Halves p across its longest extent; false if it is too small.
    bool halve(const Polygon& p, double limit);
    /// Cuts p into its pieces below and above a plane, of which one may be empty; false if there is no room. `normal`
    /// has the inverse of a length that counts as zero as its own length.
    static bool cut(const Polygon& p, const Vec3& origin, const Vec3& normal, Polygon& below, Polygon& above);

    struct Frame {                              // the directions of a facet
        std::array<Vec3, 3> corners, outwards;  // across the edges from the corners, unit length
        Vec3 normal;                            // unit length
        bool is_needle;                         // so flat that its directions are noise

        bool has_below(const Vec3& p) const {
            return outwards[0].dot(p - corners[0]) <= 0 && outwards[1].dot(p - corners[1]) <= 0 &&
                   outwards[2].dot(p - corners[2]) <= 0;
        }
    };

    struct Facets {                         // of the surface; copies share them
        std::vector<std::int32_t> partner;  // 3 #F: the corner on the other side
        std::vector<Frame> frames;          // #F
    };

    const TriangleTree& surface_;
    std::shared_ptr<const Facets> facets_;
    std::vector<Polygon> open_;
    std::vector<std::int32_t> beside_;
    double squared_distance_ = 0;
};

}  // namespace kerf

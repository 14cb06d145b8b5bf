// A search for pairs of facets that may meet, in O(n log n) also where many facets share one vertex.
//
// Boxes tell which facets may meet, but the boxes of all facets at one vertex meet there. Two facets at a vertex meet
// beyond it if and only if both lie in some common direction from it. So the facets at a vertex of many, a fan, are in
// a tree of their own, by their directions from that vertex, and each other facet is compared with those that lie in
// the directions in which it is seen from there. All facets of no fan are in one OverlapTree.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "base/core/threads.h"
#include "base/core/types.h"
#include "base/geometry/box.h"
#include "base/geometry/box_hierarchy.h"
#include "base/geometry/overlap_tree.h"

namespace kerf {

/// Half-spaces through an apex that hold all directions from it to a facet; for a facet with a corner there, all
/// directions of its sector.
class ViewCone {
 public:
    ViewCone(const std::vector<Vec3>& vertices, const Triangle& facet, std::int32_t apex);

    /// Whether certainly no direction to the facet is in this box of unit vectors.
    bool misses(const Box& directions) const;

 private:
    void add(const Vec3& inward) { inward_[count_++] = inward; }

    std::array<Vec3, 4> inward_;  // no longer than 1
    std::size_t count_ = 0;
};

/// A tree of the facets at one vertex, by boxes and directions. Keeps references.
class FanTree {
 public:
    /// `fan`: facets with the corner `apex`.
    FanTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::int32_t apex,
            std::vector<std::int32_t> fan);

    Box box() const { return tree_.nodes().front().box; }

    /// Calls visit(f) for the facets of the fan that may meet facet g beyond the apex, or at the apex if g lies on it
    /// without having it as a corner, until visit returns true. Returns whether it did.
    template <class Visit>
    bool any_near(std::int32_t g, const Visit& visit) const {
        const ViewCone cone(vertices_, facets_[g], apex_);
        const Box box_of_g = box_around(vertices_, facets_[g]);
        return tree_.any(
            [&](const Node& node) { return node.box.intersects(box_of_g) && !cone.misses(node.directions); },
            [&](std::int32_t i) {
                return box_around(vertices_, facets_[fan_[i]]).intersects(box_of_g) && visit(fan_[i]);
            });
    }

 private:
    struct Node : BoxNode {
        Box directions;  // unit vectors from the apex
        void add(const Node& other) {
            BoxNode::add(other);
            directions.extend(other.directions);
        }
    };

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::int32_t apex_;
    std::vector<std::int32_t> fan_;  // in the order of the tree
    BoxHierarchy<Node> tree_;
};

/// A tree of facets. Keeps references. Built in O(n log n) on threads, with the same result for any number of them.
class FacetTree {
 public:
    static constexpr std::int32_t least_of_fan = 256;  ///< facets at a vertex; fewer are found faster by their boxes

    /// A tree of all facets.
    FacetTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);
    /// A tree of the `chosen` facets, ascending.
    FacetTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
              const std::vector<std::int32_t>& chosen);

    /// The number of units of work, for any_pair().
    std::size_t unit_count() const { return tree_.leaf_count() + (fans_.empty() ? 0 : facets_.size()); }

    /// Calls visit(f, g) for the pairs of these units that may meet, until it returns true. Returns whether it did. All
    /// units together give each pair once, in an order that depends on the facets alone. Only for a tree of all facets.
    template <class Visit>
    bool any_pair(const IndexRange& units, const Visit& visit) const {
        const std::size_t leaves = tree_.leaf_count();
        if (units.first < leaves && tree_.any_pair({units.first, std::min(units.last, leaves)},
                                                   [&](auto i, auto j) { return visit(plain(i), plain(j)); }))
            return true;
        for (std::size_t unit = std::max(units.first, leaves); unit < units.last; ++unit) {
            const std::int32_t g = unit - leaves;
            const std::int32_t own = fan_of_[g];
            const bool was_visited = any_fan_near(g, [&](std::int32_t fan) {
                return (own < 0 || fan <= own) &&
                       fans_[fan].any_near(g, [&](std::int32_t f) { return (fan != own || f < g) && visit(f, g); });
            });
            if (was_visited) return true;
        }
        return false;
    }

    /// Calls visit(f) for the facets of the tree that may meet facet g, g itself included, until it returns true.
    /// Returns whether it did. The order is the same every time.
    template <class Visit>
    bool any_near(std::int32_t g, const Visit& visit) const {
        return tree_.any_meeting(box_around(vertices_, facets_[g]), [&](auto i) { return visit(plain(i)); }) ||
               any_fan_near(g, [&](std::int32_t fan) { return fans_[fan].any_near(g, visit); });
    }

 private:
    std::int32_t plain(std::int32_t item) const { return plain_.empty() ? item : plain_[item]; }
    template <class Visit>
    bool any_fan_near(std::int32_t g, const Visit& visit) const {
        return !fans_.empty() && fan_tree_.any_meeting(box_around(vertices_, facets_[g]), visit);
    }
    // Moves the facets at vertices of many from `chosen` into fans.
    void make_fans(std::vector<std::int32_t>& chosen);

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::vector<std::int32_t> plain_;   // facets of no fan, by items of the tree; empty: all facets in their order
    std::vector<std::int32_t> fan_of_;  // per facet, -1: none; empty if there is no fan
    std::vector<FanTree> fans_;
    OverlapTree tree_, fan_tree_;  // of the facets of no fan; of the fans
};

}  // namespace kerf

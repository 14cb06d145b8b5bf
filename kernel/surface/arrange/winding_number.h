// The winding number of facets around a point, closed or not.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/core/types.h"
#include "base/geometry/box_hierarchy.h"

namespace kerf {

/// The generalised winding number of a triangle soup (Jacobson et al. 2013, jacobson2013): the solid angle that the
/// facets fill as seen from a point, over 4 pi, positive where their backs are seen. Inside of closed facets with
/// normals that point out it is 1, outside 0; each hole lets it fall off gently, to 1/2 in the middle of the hole.
///
/// Facets far from the point are taken together (Barill et al. 2018, barill2018), a node of a tree by its dipole,
/// quadrupole and octupole; near ones have their exact solid angle (van Oosterom and Strackee 1983, vanoosterom1983).
/// The error is below 0.01, where facets close below 0.002. Built in O(n log n), 0.4 s for a million facets; a question
/// takes O(log n), some microseconds. About 300 bytes a facet. Deterministic; several threads may ask at once.
class WindingNumber {
 public:
    /// `times`: how often each facet counts, negative for turned ones; empty: once each. Facets without area count
    /// nothing.
    WindingNumber(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                  const std::vector<std::int32_t>& times = {});

    /// Returns the winding number at a point, which should not lie on a facet.
    double at(const Vec3& point) const { return sum(point, -1); }
    /// Returns the winding number at the centroid of a facet, without that facet: a facet that counts t times adds t /
    /// 2 behind and takes it away in front.
    double beside(std::int32_t facet) const;

 private:
    using QuadraticForm = std::array<double, 6>;  // xx, yy, zz, xy, yz, zx
    using CubicForm = std::array<double, 10>;     // xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz
    struct Node : BoxNode {
        double area = 0;             // total area of the facets below the node
        Vec3 centre = Vec3::Zero();  // their centroid
        Vec3 dipole = Vec3::Zero();  // the sum of the area vectors
        QuadraticForm quadrupole = {};
        CubicForm octupole = {};

        void add(const Node& other);
        void add_moments(const Node& other, const Vec3& away);
        bool is_far(const Vec3& point) const;
        double solid_angle(const Vec3& point) const;
    };
    struct Item {
        std::array<Vec3, 3> corners;
        std::int32_t facet;
        std::int32_t times;
    };

    static Node node_of(const Item& item);
    double sum(const Vec3& point, std::int32_t without) const;

    std::vector<Item> items_;  // in the order of the leaves
    std::vector<std::int32_t> item_of_;
    BoxHierarchy<Node> hierarchy_;
};

}  // namespace kerf

// Triangles near which sizes are wanted.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "base/core/bytes.h"
#include "base/core/padding.h"
#include "base/geometry/box_hierarchy.h"

namespace kerf {

/// A triangle with the sizes wanted at its corners, linear between them, up to the distance `reach` from it. Three
/// equal corners make a point.
struct SizedTriangle {
    std::array<double, 9> coordinates{};
    std::array<double, 3> size{};
    double reach = 0;

    SizedTriangle() = default;
    SizedTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<double, 3>& sizes, double plateau = 0)
        : coordinates{a.x(), a.y(), a.z(), b.x(), b.y(), b.z(), c.x(), c.y(), c.z()}, size(sizes), reach(plateau) {}
    Vec3 corner(int i) const { return {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]}; }
    double smallest() const { return std::min({size[0], size[1], size[2]}); }
    double largest() const { return std::max({size[0], size[1], size[2]}); }
    bool is_uniform() const { return size[0] == size[1] && size[0] == size[2]; }
    double distance(const Vec3& p) const;
    /// Returns the barycentric coordinates of the point of the triangle closest to p.
    Vec3 closest(const Vec3& p) const;
    /// Returns the size at the point of the triangle closest to p, plus growth times the distance beyond the reach.
    double size_at(const Vec3& p, double growth) const;
    /// Returns the distance along the ray from `origin` in the unit direction to the triangle, which it may hit from
    /// either side; infinity if it misses.
    double hit(const Vec3& origin, const Vec3& direction) const;
};
static_assert(std::is_trivially_copyable_v<SizedTriangle>);
template <>
struct HasNoPadding<SizedTriangle> : std::bool_constant<sizeof(SizedTriangle) == 13 * sizeof(double)> {};

/// Many sized triangles in a tree of boxes, those of one reach below one node or a few. Built in O(n log n).
class SizedTriangles {
 public:
    SizedTriangles() = default;
    explicit SizedTriangles(std::vector<SizedTriangle> triangles);

    bool empty() const { return triangles_.empty(); }
    std::span<const SizedTriangle> all() const { return triangles_; }  ///< in the order of the tree
    double smallest() const { return empty() ? infinity : tree_.nodes().front().size; }

    /// Returns the least SizedTriangle::size_at(), or `bound` if none is less. O(log n) if few triangles are close, and
    /// also if many reach as far as p: the search ends with the first that has the least size that any of them can
    /// have. `asked`, if given, is raised by the number of triangles that were looked at.
    double size_at(const Vec3& p, double growth, double bound, std::int64_t* asked = nullptr) const;
    /// Returns the triangles that may matter in the box, at least one. `bound(cell)` must be an upper bound, in a given
    /// box `cell`, of all that is wanted besides; size_at() of both sets is the same wherever it is not more than that.
    /// Looks at the box in cells of an eighth of its longest side, and keeps one triangle for a cell that lies in its
    /// reach and has no smaller size. Deterministic. O(n) at most, and O(log n) for each cell.
    SizedTriangles within(const Box& box, double growth, const std::function<double(const Box&)>& bound) const;
    /// Returns the distance to the nearest triangle that the ray hits and for which is_wanted(triangle) holds, else
    /// infinity.
    template <class IsWanted>
    double first_hit(const Vec3& origin, const Vec3& direction, const IsWanted& is_wanted) const {
        return least(
            infinity, [&](const Node& node) { return entry(node.box, origin, direction); },
            [&](const SizedTriangle& t) { return is_wanted(t) ? t.hit(origin, direction) : infinity; });
    }

    template <class Archive>
    void archive(Archive& a) {
        a(triangles_);
        if constexpr (std::is_same_v<Archive, ByteReader>) build_tree(Order::as_they_are);
    }

 private:
    struct Node : BoxNode {
        double size = infinity, reach = 0;  // the least size and the largest reach below
        double floor = infinity;            // a lower bound of the computed size_at() of all triangles below

        Node() = default;
        explicit Node(const SizedTriangle& triangle);
        void add(const Node& other);
    };
    // An upper bound, in a cell, of the size from all triangles together.
    struct Ceiling {
        double size = infinity;
        std::int32_t triangle = none;  // the triangle that has exactly this size in all of the cell; none: no single
                                       // one
    };
    std::int32_t middle(std::int32_t first, std::int32_t last) const;
    static double entry(const Box& box, const Vec3& origin, const Vec3& direction);
    Ceiling largest_in(const Box& cell, double growth, double bound) const;
    bool mark(std::int32_t node, const Box& cell, double growth, const Ceiling& ceiling,
              std::vector<char>& node_is_kept, std::vector<char>& is_kept) const;
    enum class Order { as_they_are, to_be_made };
    void build_tree(Order order);

    // Returns the least of `bound` and all of_triangle(). of_node() must be a lower bound of it for all triangles below
    // a node.
    template <class OfNode, class OfTriangle>
    double least(double bound, const OfNode& of_node, const OfTriangle& of_triangle) const {
        return tree_.least<FirstOfEqual::right>(bound, of_node,
                                                [&](std::int32_t i) { return of_triangle(triangles_[i]); });
    }

    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::int32_t none = -1;

    std::vector<SizedTriangle> triangles_;
    BoxHierarchy<Node> tree_;
};

}  // namespace kerf

// The triangles that are to fill a hole, while they are refined.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Triangles within rims that stay: edges of a rim are never split or flipped, its vertices never move. A disk, or a
/// band between two rims.
class PatchMesh {
 public:
    /// `points`: of the rims alone; `triangles`: in the direction in which the rims go; `rim_sizes`: of each rim how
    /// many points it has, in their order; `taken`: edges between points of rims that the patch must not have, because
    /// the surface has them, ascending.
    PatchMesh(std::vector<Vec3> points, std::vector<Triangle> triangles, const std::vector<std::int32_t>& rim_sizes,
              std::vector<UndirectedEdge> taken = {});

    /// Whether the triangles have each edge of the rims once, in its direction, and each other edge twice, in both
    /// directions. What the others ask for.
    bool is_within_rims() const;

    /// That, and no edge is taken.
    bool spans_rims() const;

    /// Divides edges until they are about as long as those of the rims (their sizes are handed on to new points, and
    /// grow by `growth` of the distance), with flips in between, then moves new points to the middle of their
    /// neighbours. Points of triangles in a plane parallel to the axes stay in it exactly. O(n log n) in practice.
    void refine(double growth);

    /// Flips edges until the angles opposite to each sum up to at most 180 degrees, where that turns nothing over.
    void relax();

    const std::vector<Vec3>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    std::int32_t rim_count() const { return rim_count_; }  ///< of points: the first ones
    std::int32_t count() const { return static_cast<std::int32_t>(points_.size()); }
    void move(std::int32_t point, const Vec3& to) { points_[point] = to; }

    /// Edges of triangles between two points of rims that are not of a rim.
    std::vector<UndirectedEdge> chords() const;

 private:
    std::int32_t start(std::int32_t corner) const { return triangles_[corner / 3][corner % 3]; }
    std::int32_t successor(std::int32_t point) const;
    void link(std::int32_t a, std::int32_t b);
    void find_partners();
    void find_sizes(const std::vector<std::int32_t>& rim_sizes);
    bool split_long(double growth);
    void split(std::int32_t corner, const Vec3& at, double size);
    bool should_flip(std::int32_t corner) const;
    bool has_edge(std::int32_t corner, std::int32_t to) const;
    void flip(std::int32_t corner);
    void smooth();
    bool keeps_sides(std::int32_t point, const Vec3& to, std::span<const std::int32_t> around) const;

    std::vector<Vec3> points_;
    std::vector<Triangle> triangles_;
    std::vector<std::int32_t> partner_;  // 3 #T: the corner on the other side of the edge; -1: a rim
    std::vector<std::int32_t> next_;     // of points of rims
    std::vector<double> size_;           // of each point
    std::vector<UndirectedEdge> taken_;
    std::int32_t rim_count_ = 0;
};

}  // namespace kerf

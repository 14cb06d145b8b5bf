// The triangles that are to fill a hole, while they are refined.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

/// Triangles within rims that stay as they are: edges of a rim are never split or flipped, its vertices never move. The
/// triangles are a disk, or a band between two rims.
class PatchMesh {
 public:
    /// `points`: those of the rims; `triangles`: turned like the rims; `rim_sizes`: the number of points of each rim,
    /// in their order; `taken`: edges between points of rims that the patch must not have, because the surface has
    /// them, ascending.
    PatchMesh(std::vector<Vec3> points, std::vector<Triangle> triangles, const std::vector<std::int32_t>& rim_sizes,
              std::vector<UndirectedEdge> taken = {});

    /// Whether the triangles have each edge of the rims once, in its direction, and each other edge twice, in both
    /// directions. All other functions require that.
    bool is_within_rims() const;

    /// Whether the patch is within its rims, and has none of the edges that are taken.
    bool spans_rims() const;

    /// Divides edges until they are about as long as those of the rims (sizes of rim points are handed on to new
    /// points, and grow by `growth` of the distance), with flips in between, then moves new points to the middle of
    /// their neighbours. Points of triangles in a plane that is perpendicular to a coordinate axis stay in it exactly.
    /// O(n log n) in practice.
    void refine(double growth);

    /// Flips edges until the two angles opposite to each sum up to at most 180 degrees, unless that turns a triangle
    /// over.
    void relax();

    const std::vector<Vec3>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }
    std::int32_t rim_count() const { return rim_count_; }  ///< the number of points of rims, which come first
    std::int32_t count() const { return count_of(points_); }
    void move(std::int32_t point, const Vec3& to) { points_[point] = to; }

    /// Returns the edges of triangles between two points of rims that are not edges of a rim.
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
    std::vector<std::int32_t> partner_;  // 3 #T: the corner on the other side of the edge; -1: an edge of a rim
    std::vector<std::int32_t> next_;     // per point of a rim: the next one on it
    std::vector<double> size_;           // per point: the length wanted of its edges
    std::vector<UndirectedEdge> taken_;
    std::int32_t rim_count_ = 0;
};

}  // namespace kerf

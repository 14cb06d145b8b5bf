// Triangulations of polygons that nobody would choose: any diagonals, any points.
#pragma once

#include <optional>
#include <vector>

#include "base/core/types.h"
#include "support/seeded_numbers.h"

namespace kerf::test {

/// A simple polygon cut into triangles, which are counter-clockwise. Exact predicates; every operation is O(n).
class RandomTriangulation {
 public:
    /// Triangles lower than `least_height` times their longest edge are not made, but where there is no other way.
    /// `corners`: counter-clockwise, some may lie on the line between their neighbours. Which ears are cut off first is
    /// random. Without triangles if the polygon is not simple. O(n^3) at worst.
    RandomTriangulation(std::vector<Vec2> corners, double least_height, SeededNumbers& random);

    const std::vector<Vec2>& points() const { return points_; }
    const std::vector<Triangle>& triangles() const { return triangles_; }

    /// Adds a point inside of a triangle or of an edge between two. False, and nothing done, where there is none, or a
    /// triangle would be too low.
    bool insert(const Vec2& p);
    /// Tries to flip so many edges at random.
    void flip(int tries, SeededNumbers& random);
    /// Flips edges opposite to the point as long as that is possible: it sees most others then.
    void grow_star(std::int32_t point);

 private:
    bool is_high(std::int32_t a, std::int32_t b, std::int32_t c) const;
    /// Flips the edge from corner i of the triangle to the next one.
    bool flip_edge(std::size_t triangle, int i);
    std::optional<std::size_t> triangle_at(std::int32_t from, std::int32_t to) const;
    bool is_ear(const std::vector<std::int32_t>& polygon, std::size_t i, double least_height) const;

    std::vector<Vec2> points_;
    std::vector<Triangle> triangles_;
    double least_height_;
};

}  // namespace kerf::test

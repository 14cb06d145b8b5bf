// The triangulation of a polygon whose worst triangle is best.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace kerf {

/// Finds a triangulation by dynamic programming over the diagonals (Klincsek 1980, klincsek1980). The polygon is known
/// by the numbers of its corners alone, of which there are at most `most`.
template <std::size_t most>
class PolygonTriangulation {
 public:
    /// Finds a triangulation of a polygon of n >= 2 corners, all of whose triangles have less badness than `limit`;
    /// false if there is none. badness_of(i, j, k, best) is the badness of a triangle, or any number that is not below
    /// `best`. O(n^3).
    template <class Badness>
    bool find(std::size_t n, double limit, const Badness& badness_of) {
        n_ = n;
        for (std::size_t i = 0; i + 1 < n; ++i) best_[i][i + 1] = -infinity;
        for (std::size_t width = 2; width < n; ++width)
            for (std::size_t i = 0, k = width; k < n; ++i, ++k) {
                double best = limit;
                for (std::size_t j = i + 1; j < k; ++j) {
                    const double parts = std::max(best_[i][j], best_[j][k]);
                    if (parts >= best) continue;
                    const double all = std::max(parts, badness_of(i, j, k, best));
                    if (all >= best) continue;
                    best = all;
                    middle_[i][k] = j;
                }
                best_[i][k] = best < limit ? best : infinity;
            }
        return badness() < infinity;
    }
    /// Returns the largest badness of its triangles; infinity if there is no triangulation.
    double badness() const { return best_[0][n_ - 1]; }
    /// Calls visit(i, j, k) with the corners of every triangle, i < j < k.
    template <class Visit>
    void for_each_triangle(const Visit& visit) const {
        visit_between(0, n_ - 1, visit);
    }

 private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    template <class Visit>
    void visit_between(std::size_t i, std::size_t k, const Visit& visit) const {
        if (k - i < 2) return;
        const std::size_t j = middle_[i][k];
        visit(i, j, k);
        visit_between(i, j, visit);
        visit_between(j, k, visit);
    }

    std::size_t n_ = 0;
    // The least badness of the part of the polygon from one corner to another, and the third corner of its last
    // triangle.
    std::array<std::array<double, most>, most> best_;
    std::array<std::array<std::uint8_t, most>, most> middle_;
};

}  // namespace kerf

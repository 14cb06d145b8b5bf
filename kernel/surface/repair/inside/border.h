// The rims of a surface, for steps that join them.
#pragma once

#include <span>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The open edges of a surface, which belong to one facet alone, their vertices, and all facets at these. Keeps
/// references to the arrays that it is made of.
class Border {
 public:
    /// Takes facets with numbers in range; facets with `is_left_out` (#F, or empty: none) count as absent.
    Border(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
           const std::vector<char>& is_left_out = {});

    const std::vector<std::int32_t>& corners() const { return corners_; }    ///< corners of the open edges, ascending
    const std::vector<std::int32_t>& vertices() const { return vertices_; }  ///< ends of the open edges, ascending
    bool has(std::int32_t vertex) const { return place_[vertex] >= 0; }
    /// Facets at a vertex of the border, ascending.
    std::span<const std::int32_t> facets_at(std::int32_t vertex) const {
        return row(facets_at_, first_facet_, place_[vertex]);
    }
    /// Returns the length of the border between two of its vertices if it is below `limit`, else infinity. Gives up
    /// after 64 vertices, as where many borders meet; then the length is that of the ways found so far.
    double length_between(std::int32_t from, std::int32_t to, double limit) const;

 private:
    static std::span<const std::int32_t> row(const std::vector<std::int32_t>& items,
                                             const std::vector<std::int32_t>& first, std::int32_t place) {
        return std::span(items).subspan(first[place], first[place + 1] - first[place]);
    }
    void collect_facets(const std::vector<char>& is_left_out);
    void collect_neighbours();

    const std::vector<Vec3>& points_;
    const std::vector<Triangle>& facets_;
    std::vector<std::int32_t> corners_, vertices_;
    std::vector<std::int32_t> place_;                         // #V; place in vertices_, -1: not of the border
    std::vector<std::int32_t> facets_at_, first_facet_;       // per place: the facets at the vertex
    std::vector<std::int32_t> neighbours_, first_neighbour_;  // per place: other ends of open edges
};

}  // namespace kerf

// The rims at which a surface is open.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "surface/soup/soup.h"

namespace kerf {

/// The reason why a rim cannot be spanned, if it cannot.
enum class RimObstacle {
    none,
    no_loop,    ///< the rim ends at an edge of more than two facets
    one_sided,  ///< the surface has only one side
    infinite,   ///< a vertex has no finite coordinates
};

/// Open edges, of one facet each, that follow each other.
struct Rim {
    std::vector<std::int32_t> vertices;  ///< numbers in the soup, in the direction of facets that would fill the rim
    std::vector<std::int32_t> facets;    ///< of the soup: facets[i] has the edge from vertices[i] to its successor
    std::vector<Vec3> apexes;            ///< the third corners of these facets
    RimObstacle obstacle = RimObstacle::none;
    double length = 0;

    std::vector<Vec3> points(const Soup& soup) const;
    Vec3 centre(const Soup& soup) const;
};

/// All rims of a soup, and the facets at them. Facets with a repeated vertex are passed over. Facets may be turned
/// against each other: rims have the direction that they would have if each facet were turned like most of its shell.
class OpenRims {
 public:
    /// Keeps the reference. O(#F log #F).
    explicit OpenRims(const Soup& soup);

    const std::vector<Rim>& all() const { return rims_; }
    /// Returns the facets at a vertex of a rim, ascending; empty at other vertices.
    std::span<const std::int32_t> facets_at(std::int32_t vertex) const;
    /// Whether only one rim passes a vertex, and once.
    bool is_passed_once(std::int32_t vertex) const { return passes_[vertex] == 1; }
    const Soup& soup() const { return soup_; }

 private:
    void find_facets();

    const Soup& soup_;
    std::vector<Rim> rims_;
    std::vector<std::int32_t> passes_;          // #V
    std::vector<std::int32_t> first_, facets_;  // vertex v has facets_ from first_[v] up to first_[v + 1]
};

}  // namespace kerf

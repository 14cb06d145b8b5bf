// A vertex of a flat facet lies on its longest edge; the facet on the other side of that is divided there. In rows of
// flat facets the vertex may be that of another one: hence all that hang together are looked at as one line.
#include "surface/repair/inside/flat_facets.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "base/core/ids.h"
#include "base/geometry/predicates.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

class FlatLines {
 public:
    FlatLines(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
        : vertices_(vertices), facets_(facets), place_(facets.size(), -1) {
        for (std::int32_t f = 0; f < count_of(facets); ++f) {
            const auto [a, b, c] = facets[f];
            if (!are_collinear(vertices[a], vertices[b], vertices[c])) continue;
            place_[f] = count_of(found_.facets);
            found_.facets.push_back(f);
        }
    }

    FlatFacets find() {
        if (found_.facets.empty()) return {};
        const EdgeCorners edges(facets_);
        UnionFind sets(found_.facets.size());
        edges.for_each_edge([&](std::int32_t, Corners corners) {
            std::int32_t last = -1;
            for (const EdgeCorners::Corner& c : corners) {
                const std::int32_t own = place_[c.corner / 3];
                if (own >= 0 && last >= 0) sets.join(last, own);
                if (own >= 0) last = own;
            }
        });
        collect(sets.take());
        edges.for_each_edge([&](std::int32_t, Corners corners) { divide_beside(corners); });
        return std::move(found_);
    }

 private:
    using Corners = std::span<const EdgeCorners::Corner>;

    // The vertices of each line, each once.
    void collect(const Components& lines) {
        line_of_ = lines.of;
        on_line_.resize(lines.count);
        for (std::size_t i = 0; i < found_.facets.size(); ++i)
            for (const std::int32_t v : facets_[found_.facets[i]]) on_line_[line_of_[i]].push_back(v);
        for (std::vector<std::int32_t>& all : on_line_) {
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
        }
    }
    void divide_beside(Corners corners) {
        std::int32_t line = -1;
        for (const EdgeCorners::Corner& c : corners)
            if (const std::int32_t own = place_[c.corner / 3]; own >= 0) line = line_of_[own];
        if (line < 0) return;
        for (const EdgeCorners::Corner& c : corners)
            if (place_[c.corner / 3] < 0) divide_side(c.corner, on_line_[line]);
    }
    // Points on one line that differ do so in the coordinate in which the ends of a side differ most.
    void divide_side(std::int32_t corner, const std::vector<std::int32_t>& on_line) {
        const Vec3& a = vertices_[start_vertex(facets_, corner)];
        const Vec3& b = vertices_[start_vertex(facets_, next_corner(corner))];
        Eigen::Index axis = 0;
        (b - a).cwiseAbs().maxCoeff(&axis);
        const double sign = b[axis] > a[axis] ? 1 : -1;
        for (const std::int32_t v : on_line) {
            const double along = sign * vertices_[v][axis];
            if (along > sign * a[axis] && along < sign * b[axis]) found_.points.push_back({corner, along, v});
        }
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::vector<std::int32_t> place_;    // among the flat ones, else -1
    std::vector<std::int32_t> line_of_;  // of the flat ones
    std::vector<std::vector<std::int32_t>> on_line_;
    FlatFacets found_;
};

}  // namespace

FlatFacets find_flat_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    return FlatLines(vertices, facets).find();
}

}  // namespace kerf

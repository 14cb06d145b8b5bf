// Each facet has two sides. Two sides that face each other in the wedge between consecutive facets around an edge
// belong to one cell, which joins sides to sets. Facets that edges connect form a component. One set of sides of a
// component is its outside; each other one is closed by facets of the component alone and bounds a cell. A point lies
// in at most one such set of each other component, so the outside of a component is joined with the innermost set
// around it.
#include "surface/regions/cells.h"

#include <algorithm>
#include <array>
#include <span>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/radial_order.h"

namespace kerf {

namespace {

// The facets that have a set of sides on one of their sides only, by set, turned so that it is behind them.
// `set_of_side`: 2 #F; negative: none.
std::vector<Shell> boundaries_of(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const std::vector<std::int32_t>& set_of_side, std::int32_t count) {
    std::vector<Shell> shells(count);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Triangle& t = facets[f];
        const std::int32_t front = set_of_side[2 * f], back = set_of_side[2 * f + 1];
        if (front == back) continue;
        const auto add = [&](std::int32_t set, const Triangle& turned) {
            if (set < 0) return;
            shells[set].facets.push_back(turned);
            shells[set].box.extend(box_around(vertices, t));
        };
        add(front, {t[0], t[2], t[1]});
        add(back, t);
    }
    return shells;
}

// Six times the volume behind facets, relative to a point near them.
double sixfold_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    if (facets.empty()) return 0;
    const Vec3& base = vertices[facets[0][0]];
    long double sum = 0;
    for (const Triangle& t : facets)
        sum += (vertices[t[0]] - base).dot((vertices[t[1]] - base).cross(vertices[t[2]] - base));
    return static_cast<double>(sum);
}

class CellFinder {
 public:
    CellFinder(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
        : vertices_(vertices), facets_(facets) {}

    std::optional<Cells> run() {
        if (!join_at_edges()) return std::nullopt;
        find_outsides();
        UnionFind joined(sets_.count + 1);  // the last one is the unbounded cell
        nest(joined);
        return number(joined);
    }

 private:
    bool join_at_edges() {
        UnionFind sides(2 * facets_.size()), components(facets_.size());
        bool conforms = true;
        EdgeCorners(facets_).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
            for (const auto& c : corners) components.join(corners[0].corner / 3, c.corner / 3);
            order_.clear();
            for (const auto& c : corners) order_.push_back(c.corner);
            if (corners.size() > 2) order_ = radial_order(vertices_, facets_, low, corners).corners;
            conforms &= !order_.empty();
            for (std::size_t i = 0; i < order_.size(); ++i)
                sides.join(sides_at(facets_, low, order_[i]).ahead,
                           sides_at(facets_, low, order_[(i + 1) % order_.size()]).behind);
        });
        sets_ = sides.take();
        components_ = components.take();
        return conforms;
    }

    // The volumes of the sets of a component add up to 0: the outside has the only negative one.
    void find_outsides() {
        boundaries_ = boundaries_of(vertices_, facets_, sets_.of, sets_.count);
        component_of_.assign(sets_.count, -1);
        for (std::size_t s = 0; s < sets_.of.size(); ++s) component_of_[sets_.of[s]] = components_.of[s / 2];
        outside_.assign(components_.count, -1);
        std::vector<double> least(components_.count, 0);
        for (std::int32_t set = 0; set < sets_.count; ++set) {
            const double volume = sixfold_volume(vertices_, boundaries_[set].facets);
            const std::int32_t c = component_of_[set];
            if (outside_[c] >= 0 && volume >= least[c]) continue;
            outside_[c] = set;
            least[c] = volume;
        }
    }

    // Joins the outside of each component with the cell around it.
    void nest(UnionFind& joined) {
        std::vector<Shell> inner;
        std::vector<std::int32_t> set_of;
        for (std::int32_t set = 0; set < sets_.count; ++set) {
            Shell& boundary = boundaries_[set];
            if (outside_[component_of_[set]] == set || boundary.facets.empty()) continue;
            set_of.push_back(set);
            inner.push_back(std::move(boundary));
        }
        std::vector<std::int32_t> around(components_.count, -1);
        if (components_.count > 1 && !inner.empty()) {
            find_members();
            around = find_innermost(inner, set_of);
        }
        const std::int32_t unbounded = sets_.count;
        for (std::int32_t c = 0; c < components_.count; ++c)
            joined.join(outside_[c], around[c] < 0 ? unbounded : set_of[around[c]]);
    }

    // Returns for each component the innermost boundary around it, or -1: as in locate_shells(), the first one from the
    // smallest box on.
    std::vector<std::int32_t> find_innermost(const std::vector<Shell>& inner,
                                             const std::vector<std::int32_t>& set_of) const {
        const BoxTree boxes = boxes_of(inner);
        const std::vector<std::int32_t> order = by_falling_boxes(inner);
        std::vector<std::int32_t> rank(order.size()), innermost;
        for (std::int32_t k = 0; k < count_of(order); ++k) rank[order[k]] = k;
        for (std::int32_t c = 0; c < components_.count; ++c) {
            std::vector<std::int32_t> candidates = boxes.around(box_of_[c]);
            std::erase_if(candidates, [&](std::int32_t i) { return component_of_[set_of[i]] == c; });
            std::sort(candidates.begin(), candidates.end(),
                      [&](std::int32_t i, std::int32_t j) { return rank[i] > rank[j]; });
            const auto found = std::find_if(candidates.begin(), candidates.end(),
                                            [&](std::int32_t i) { return lies_in(c, inner[i]); });
            innermost.push_back(found == candidates.end() ? -1 : *found);
        }
        return innermost;
    }

    // The facets of each component, the boxes around them, and which vertices several components have.
    void find_members() {
        members_.resize(components_.count);
        box_of_.resize(components_.count);
        std::vector<std::int32_t> component_at(vertices_.size(), -1);
        is_shared_.assign(vertices_.size(), 0);
        for (std::int32_t f = 0; f < count_of(facets_); ++f) {
            const std::int32_t c = components_.of[f];
            members_[c].push_back(f);
            box_of_[c].extend(box_around(vertices_, facets_[f]));
            for (const std::int32_t v : facets_[f]) {
                is_shared_[v] |= component_at[v] >= 0 && component_at[v] != c;
                component_at[v] = c;
            }
        }
    }

    // Whether a component lies inside of the facets of another one. Vertices that it has alone decide, else midpoints
    // of edges.
    bool lies_in(std::int32_t component, const Shell& outer) const {
        constexpr int most_points = 24;
        int left = most_points;
        for (const std::int32_t f : members_[component])
            for (const std::int32_t v : facets_[f]) {
                if (is_shared_[v] || left-- <= 0) continue;
                if (const auto inside = encloses(vertices_, outer, vertices_[v])) return *inside;
            }
        left = most_points;
        for (const std::int32_t f : members_[component])
            for (int i = 0; i < 3 && left-- > 0; ++i) {
                const Vec3 &a = vertices_[facets_[f][i]], &b = vertices_[facets_[f][(i + 1) % 3]];
                if (const auto inside = encloses(vertices_, outer, a / 2 + b / 2)) return *inside;
            }
        return false;
    }

    Cells number(UnionFind& joined) {
        const std::vector<std::int32_t> root = joined.take().of;
        std::vector<std::int32_t> cell(root.size(), -2);
        cell[root.back()] = -1;
        Cells cells;
        const auto cell_of_side = [&](std::int32_t side) {
            std::int32_t& number = cell[root[sets_.of[side]]];
            if (number == -2) number = cells.count++;
            return number;
        };
        for (std::int32_t f = 0; f < count_of(facets_); ++f) {
            const std::int32_t front = cell_of_side(front_side(f));
            cells.sides.push_back({front, cell_of_side(back_side(f))});
        }
        return cells;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::vector<std::int32_t> order_;                   // of the corners at an edge
    Components sets_;                                   // of sides
    Components components_;                             // of facets
    std::vector<Shell> boundaries_;                     // of sets
    std::vector<std::int32_t> component_of_, outside_;  // of a set; of a component
    std::vector<std::vector<std::int32_t>> members_;    // of components
    std::vector<Box> box_of_;
    std::vector<char> is_shared_;  // #V
};

std::vector<std::int32_t> cell_of_each_side(const Cells& cells) {
    std::vector<std::int32_t> cell;
    for (const auto [front, back] : cells.sides) cell.insert(cell.end(), {front, back});
    return cell;
}

}  // namespace

std::optional<Cells> find_cells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    KERF_CHECK(are_in_range(facets, vertices.size()) && have_distinct_corners(facets));
    return CellFinder(vertices, facets).run();
}

std::vector<double> cell_volumes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const Cells& cells) {
    std::vector<double> volumes;
    for (const Shell& shell : boundaries_of(vertices, facets, cell_of_each_side(cells), cells.count))
        volumes.push_back(sixfold_volume(vertices, shell.facets) / 6);
    return volumes;
}

CellLocator::CellLocator(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Cells& cells)
    : vertices_(vertices),
      shells_(boundaries_of(vertices, facets, cell_of_each_side(cells), cells.count)),
      boxes_(boxes_of(shells_)) {}

std::optional<std::int32_t> CellLocator::find(const Vec3& point) const {
    for (const std::int32_t c : boxes_.around(Box(point, point))) {
        const auto inside = encloses(vertices_, shells_[c], point);
        if (!inside) return std::nullopt;
        if (*inside) return c;
    }
    return -1;
}

}  // namespace kerf

// Facets of input and result are compared by the coordinates of their corners, since repairs renumber vertices: points
// are sorted, and a facet is the sorted triple of the places of its corners among them. Facets that the input does not
// have are changed ones if their number is one of the file, else added ones. Their distance from the input is proven by
// Nearness (surface/diagnosis/nearness.h) for a bound that is raised by a fourth whenever it does not hold for a facet,
// from 1e-12 of the diagonal on; a bound that has been raised serves all further facets, so that the whole takes few
// proofs. Beyond the diagonal the distance counts as infinite.
#include "run/prepare/inside/repair_measures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <tuple>

#include "base/core/cancellation.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/nearness.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

bool is_before(const Vec3& a, const Vec3& b) {
    return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
}

bool is_finite(const Soup& soup, const Triangle& t) {
    return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return soup.vertices[v].allFinite(); });
}

std::vector<Triangle> finite_facets(const Soup& soup) {
    std::vector<Triangle> facets;
    std::copy_if(soup.facets.begin(), soup.facets.end(), std::back_inserter(facets),
                 [&](const Triangle& t) { return is_finite(soup, t); });
    return facets;
}

// Returns the facets that bound the inside, turned outwards; of regions, those with nothing on one side.
std::vector<Triangle> outer_facets(const Soup& soup) {
    if (soup.sides.empty()) return soup.facets;
    std::vector<Triangle> outer;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto [front, back] = soup.sides[f];
        const auto& [a, b, c] = soup.facets[f];
        if (front.is_valid() != back.is_valid())
            outer.push_back(back.is_valid() ? Triangle{a, b, c} : Triangle{a, c, b});
    }
    return outer;
}

// Each edge is there as often in one direction as in the other. Facets with a repeated vertex bound nothing.
bool is_closed(std::vector<Triangle> facets) {
    std::erase_if(facets, [](const Triangle& t) { return has_repeated_vertex(t); });
    bool closed = true;
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        std::int32_t sum = 0;
        for (const auto& [high, corner] : corners) sum += start_vertex(facets, corner) == low ? 1 : -1;
        closed = closed && sum == 0;
    });
    return closed;
}

// Facets by their corners as places of a given set of points, so that those of two soups can be compared.
class FacetsByPlace {
 public:
    explicit FacetsByPlace(const Soup& soup) {
        for (const Vec3& p : soup.vertices)
            if (p.allFinite()) points_.push_back(p);
        std::sort(points_.begin(), points_.end(), is_before);
        for (const Triangle& t : soup.facets)
            if (const Triangle known = by_place(soup, t); known[0] >= 0) facets_.push_back(known);
        std::sort(facets_.begin(), facets_.end());
    }
    bool has(const Soup& soup, const Triangle& t) const {
        const Triangle known = by_place(soup, t);
        return known[0] >= 0 && std::binary_search(facets_.begin(), facets_.end(), known);
    }

 private:
    // Ascending; -1 for a corner that is none of the points.
    Triangle by_place(const Soup& soup, Triangle t) const {
        for (std::int32_t& v : t) {
            const Vec3& p = soup.vertices[v];
            const auto found =
                p.allFinite() ? std::lower_bound(points_.begin(), points_.end(), p, is_before) : points_.end();
            v = found != points_.end() && *found == p ? found - points_.begin() : -1;
        }
        std::sort(t.begin(), t.end());
        return t;
    }

    std::vector<Vec3> points_;
    std::vector<Triangle> facets_;
};

// A set of facets and the distance that others are proven to have from it, with one bound for all that grows as it
// must.
class GrowingBound {
 public:
    GrowingBound(const TriangleTree& tree, const std::vector<Triangle>& facets, double diagonal)
        : nearness_(tree, facets), diagonal_(diagonal), bound_(least * diagonal) {}
    void take(const Soup& soup, const Triangle& t) {
        const std::array<Vec3, 3> corners = {soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]};
        const auto holds = [&] {
            return nearness_.holds(
                corners, bound_, [&](std::int32_t) { return bound_; }, most_divisions, last_);
        };
        while (bound_ <= diagonal_ && !holds()) bound_ *= step;
    }
    double value() const {
        return bound_ <= diagonal_ ? nearness_.directed_distance() : std::numeric_limits<double>::infinity();
    }

 private:
    static constexpr double least = 1e-12, step = 1.25;  // of the diagonal; of the bound before
    static constexpr int most_divisions = 100'000;       // of a facet

    Nearness nearness_;
    double diagonal_, bound_;
    std::int32_t last_ = -1;
};

std::int32_t facets_in_file(const Soup& soup) {
    return soup.polygon.empty() ? count_of(soup.facets) : soup.polygon.back() + 1;
}

std::int64_t count_lost(const Soup& before, const Soup& after) {
    const FacetsByPlace left(after);
    return std::count_if(before.facets.begin(), before.facets.end(),
                         [&](const Triangle& t) { return !left.has(before, t); });
}

}  // namespace

SoupMeasures measure_soup(const Soup& soup) {
    SoupMeasures measures;
    measures.facets = std::ssize(soup.facets);
    const std::vector<Triangle> finite = finite_facets(soup);
    for (const Triangle& t : finite) measures.area += triangle_area(soup.vertices, t);
    const std::vector<Triangle> outer = outer_facets(soup);
    if (!outer.empty() && finite.size() == soup.facets.size() && is_closed(outer))
        measures.volume = enclosed_volume(soup.vertices, outer);
    return measures;
}

RepairMeasures measure_repair(const Soup& before, const Soup& after, const std::function<void()>& check_cancelled) {
    RepairMeasures measures;
    measures.before = measure_soup(before);
    measures.after = measure_soup(after);
    measures.lost_facets = count_lost(before, after);
    const std::vector<Triangle> facets = finite_facets(before);
    if (facets.empty()) return measures;
    const std::int32_t first_new = facets_in_file(before);
    std::vector<Vec3> vertices = before.vertices;  // unused ones must be finite, too
    for (Vec3& p : vertices)
        if (!p.allFinite()) p = Vec3::Zero();
    const TriangleTree tree(vertices, facets);
    const double diagonal = box_around_finite(before.vertices).diagonal().norm();
    GrowingBound changed(tree, facets, diagonal), added(tree, facets, diagonal);
    const FacetsByPlace known(before);
    const CancellationCheck check(check_cancelled);
    for (std::int32_t f = 0; f < count_of(after.facets); ++f) {
        check.at(f);
        const Triangle& t = after.facets[f];
        if (!is_finite(after, t) || known.has(after, t)) continue;
        const bool is_new = (after.polygon.empty() ? f : after.polygon[f]) >= first_new;
        (is_new ? added : changed).take(after, t);
        ++(is_new ? measures.added_facets : measures.changed_facets);
    }
    measures.distance_of_changed = changed.value();
    measures.distance_of_added = added.value();
    return measures;
}

}  // namespace kerf

// A complex keeps the pair (region in front, region behind) of each facet as its only truth. The facets of region r are
// indexed once, by a counting sort over all sides; its surface is extracted on demand, with the facets turned that have
// r in front, so that both sides of a wall have the same keys. A region is closed if at every edge it has as many
// facets that run along the edge one way as the other; `excess` is the difference. The single region is a special case:
// it is kept as a Surface, without pairs and names, and all other members are empty then (`names_.empty()`). Contacts
// are edges of more than two outer facets, and vertices whose outer corners, joined over edges of two, are several
// fans.
#include "surface/complex/complex.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/geometry/union_find.h"
#include "surface/complex/inverted_region.h"
#include "surface/complex/touching.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

Triangle turned_over(const Triangle& t) { return {t[0], t[2], t[1]}; }

void check_sides(const SurfaceArrays& facets, const std::vector<FacetSides>& sides,
                 const std::vector<std::string>& names) {
    KERF_CHECK(is_well_formed(facets) && sides.size() == facets.facets.size() && names.size() >= 1);
    for (std::size_t f = 0; f < sides.size(); ++f) {
        const auto [front, back] = sides[f];
        KERF_CHECK(std::max(front, back) < RegionIndex(names.size()) && std::min(front, back) >= RegionIndex::none());
        if (front == back)
            throw Error(ErrorCode::input,
                        fmt::format("Facet {} at {} has {} on both sides. Leave it out.", f,
                                    place_text(facets.vertices[facets.facets[f][0]]),
                                    front.is_valid() ? fmt::format("the region '{}'", names[front.value()])
                                                     : std::string("nothing")));
    }
}

// A region and how often its facets have an edge in the one direction more than in the other.
struct EdgeBalance {
    RegionIndex region;
    int excess;
};

// A region without another side at this edge, or none.
RegionIndex region_open_at(const std::vector<Triangle>& facets, const std::vector<FacetSides>& sides, std::int32_t low,
                           std::span<const EdgeCorners::Corner> corners, std::vector<EdgeBalance>& balances) {
    balances.clear();
    const auto add = [&](RegionIndex region, int excess) {
        if (!region.is_valid()) return;
        const auto found = std::find_if(balances.begin(), balances.end(),
                                        [&](const EdgeBalance& other) { return other.region == region; });
        if (found == balances.end())
            balances.push_back({region, excess});
        else
            found->excess += excess;
    };
    for (const auto& [high, corner] : corners) {
        const int direction = start_vertex(facets, corner) == low ? 1 : -1;
        add(sides[corner / 3].back, direction);
        add(sides[corner / 3].front, -direction);
    }
    for (const EdgeBalance& balance : balances)
        if (balance.excess != 0) return balance.region;
    return RegionIndex::none();
}

void check_closed(const SurfaceArrays& facets, const std::vector<FacetSides>& sides,
                  const std::vector<std::string>& names) {
    std::vector<EdgeBalance> balances;
    EdgeCorners(facets.facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        const RegionIndex open = region_open_at(facets.facets, sides, low, corners, balances);
        if (!open.is_valid()) return;
        const Vec3 middle = (facets.vertices[low] + facets.vertices[corners.front().high]) / 2;
        throw Error(ErrorCode::input, fmt::format("The region '{}' is open at {}: its facets do not close there. Add "
                                                  "the wall that is missing, or turn the facets that lie wrongly.",
                                                  names[open.value()], place_text(middle)));
    });
}

// Of each region six times its volume, from a vertex of its own, and the sum of the magnitudes of all terms.
struct SignedVolume {
    std::int32_t origin = -1;
    double sum = 0, magnitude = 0;
};

// Refuses regions that close the wrong way. Volumes that may be negative by rounding alone are none of them.
void check_turned_outwards(const SurfaceArrays& facets, const std::vector<FacetSides>& sides,
                           const std::vector<std::string>& names) {
    constexpr double rounding = 1e-9;  // as a share of the magnitudes
    std::vector<SignedVolume> volumes(names.size());
    const auto add = [&](RegionIndex region, const Triangle& t, double sign) {
        if (!region.is_valid()) return;
        SignedVolume& own = volumes[region.value()];
        if (own.origin < 0) own.origin = t[0];
        const Vec3& origin = facets.vertices[own.origin];
        const Vec3 a = facets.vertices[t[0]] - origin, b = facets.vertices[t[1]] - origin,
                   c = facets.vertices[t[2]] - origin;
        const double term = sign * a.dot(b.cross(c));
        own.sum += term;
        own.magnitude += std::abs(term);
    };
    for (std::size_t f = 0; f < sides.size(); ++f) {
        add(sides[f].back, facets.facets[f], 1);
        add(sides[f].front, facets.facets[f], -1);
    }
    for (std::size_t r = 0; r < names.size(); ++r)
        if (volumes[r].sum < -rounding * volumes[r].magnitude)
            throw InvertedRegion(
                fmt::format("The region '{}' is inside out, with a volume of {:.6g}: turn its facets, or exchange the "
                            "regions behind them and in front of them, which are the columns of sides.",
                            names[r], volumes[r].sum / 6));
}

std::array<Key, 2> edge_of(Key a, Key b) { return {std::min(a, b), std::max(a, b)}; }

template <class T>
void sort_unique(std::vector<T>& items) {
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

// The corner of a facet at its vertex where this corner, an edge, ends.
std::int32_t corner_at_end(std::int32_t corner) { return next_corner(corner); }

}  // namespace

bool Contacts::has(Key vertex) const { return std::binary_search(vertices.begin(), vertices.end(), vertex); }
bool Contacts::has(Key a, Key b) const { return std::binary_search(edges.begin(), edges.end(), edge_of(a, b)); }

Contacts find_contacts(const std::vector<Triangle>& outer, std::span<const Key> key) {
    Contacts contacts;
    UnionFind fans(3 * outer.size());  // of corners at their vertices
    EdgeCorners(outer).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        if (corners.size() > 2) {
            const Key a = key[low], b = key[corners.front().high];
            contacts.edges.push_back(edge_of(a, b));
            contacts.vertices.insert(contacts.vertices.end(), {a, b});
        } else if (corners.size() == 2) {
            const std::int32_t c = corners[0].corner, d = corners[1].corner;
            const bool same_start = start_vertex(outer, c) == start_vertex(outer, d);
            fans.join(c, same_start ? d : corner_at_end(d));
            fans.join(corner_at_end(c), same_start ? corner_at_end(d) : d);
        }
    });
    std::vector<std::int32_t> fan_of_vertex(key.size(), -1);
    for (std::int32_t corner = 0; corner < 3 * count_of(outer); ++corner) {
        std::int32_t& fan = fan_of_vertex[start_vertex(outer, corner)];
        const std::int32_t own = fans.root(corner);
        if (fan < 0) fan = own;
        if (fan != own) contacts.vertices.push_back(key[start_vertex(outer, corner)]);
    }
    sort_unique(contacts.vertices);
    sort_unique(contacts.edges);
    return contacts;
}

Complex::Complex(Surface surface) : only_(std::move(surface)) {}

Complex::Complex(SurfaceArrays facets, std::vector<FacetSides> sides, std::vector<std::string> region_names)
    : facets_(std::move(facets)), sides_(std::move(sides)), names_(std::move(region_names)) {
    check_sides(facets_, sides_, names_);
    find_facets_of_regions();
    for (std::size_t r = 0; r + 1 < first_.size(); ++r)
        if (first_[r] == first_[r + 1])
            throw Error(ErrorCode::input, fmt::format("The region '{}' has no facets. Leave it out.", names_[r]));
    check_closed(facets_, sides_, names_);
    check_turned_outwards(facets_, sides_, names_);
    if (names_.size() == 1) become_only_region();
}

void Complex::become_only_region() {
    std::variant<Surface, ManifoldDefect> built = Surface::build(arrays_of(RegionIndex(0)));
    if (const auto* defect = std::get_if<ManifoldDefect>(&built))
        throw Error(ErrorCode::input, fmt::format("The region '{}' touches itself at {}. Part its surface there.",
                                                  names_[0], place_text(defect->where)));
    *this = Complex(std::get<Surface>(std::move(built)));
}

// One pass over the facets for all regions.
void Complex::find_facets_of_regions() {
    first_.assign(names_.size() + 1, 0);
    const auto each_side = [&](auto visit) {
        for (std::int32_t f = 0; f < count_of(sides_); ++f)
            for (const RegionIndex region : {sides_[f].back, sides_[f].front})
                if (region.is_valid()) visit(region.value(), f);
    };
    each_side([&](std::int32_t region, std::int32_t) { ++first_[region + 1]; });
    for (std::size_t r = 1; r < first_.size(); ++r) first_[r] += first_[r - 1];
    facet_of_region_.resize(first_.back());
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    each_side([&](std::int32_t region, std::int32_t facet) { facet_of_region_[next[region]++] = facet; });
}

std::int32_t Complex::vertex_count() const {
    return names_.empty() ? only_.vertex_count() : static_cast<std::int32_t>(facets_.vertices.size());
}
std::int32_t Complex::facet_count() const {
    return names_.empty() ? only_.facet_count() : static_cast<std::int32_t>(facets_.facets.size());
}
const Vec3& Complex::point(std::int32_t vertex) const {
    return names_.empty() ? only_.point(Vertex(vertex)) : facets_.vertices[vertex];
}
Triangle Complex::vertices(std::int32_t facet) const {
    return names_.empty() ? only_.triangle(Facet(facet)) : facets_.facets[facet];
}
std::int32_t Complex::patch(std::int32_t facet) const {
    return names_.empty() ? only_.patch(Facet(facet)) : facets_.patch[facet];
}

Surface Complex::take_only_region() {
    KERF_CHECK(names_.empty());
    return std::exchange(only_, {});
}
SurfaceArrays Complex::arrays() const { return names_.empty() ? only_.arrays() : facets_; }

Surface Complex::surface_of(RegionIndex region) const {
    return names_.empty() ? only_ : separated_surface(arrays_of(region));
}

Contacts Complex::find_contacts() const {
    std::vector<Triangle> outer;
    for (std::size_t f = 0; f < sides_.size(); ++f)
        if (!sides_[f].is_wall()) outer.push_back(facets_.facets[f]);
    return kerf::find_contacts(outer, facets_.vertex_key);
}

SurfaceArrays Complex::arrays_of(RegionIndex region) const {
    KERF_CHECK(region.is_valid() && region.value() < region_count());
    if (names_.empty()) return only_.arrays();
    SurfaceArrays own;
    std::vector<std::int32_t> used;
    const auto begin = facet_of_region_.begin() + first_[region.value()],
               end = facet_of_region_.begin() + first_[region.value() + 1];
    for (auto it = begin; it != end; ++it) {
        const Triangle& t = facets_.facets[*it];
        own.facets.push_back(sides_[*it].back == region ? t : turned_over(t));
        own.facet_key.push_back(facets_.facet_key[*it]);
        own.patch.push_back(facets_.patch[*it]);
        used.insert(used.end(), t.begin(), t.end());
    }
    sort_unique(used);
    for (const std::int32_t v : used) {
        own.vertices.push_back(facets_.vertices[v]);
        own.vertex_key.push_back(facets_.vertex_key[v]);
    }
    for (Triangle& t : own.facets)
        for (std::int32_t& v : t) v = std::lower_bound(used.begin(), used.end(), v) - used.begin();
    return own;
}

}  // namespace kerf

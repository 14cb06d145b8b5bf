// Shells are found by union-find if all neighbours agree, as they do in most files; otherwise a breadth-first search
// over the edges of two facets turns facets until they agree.
//
// Nesting is found by parity: shells do not meet, so one vertex of a shell tells whether the whole shell lies within
// another one. The shells around a shell are nested in each other, and so are their boxes: the innermost is the first
// that is found from the smallest box on, and its own place tells the others.
#include "surface/diagnosis/orientation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/union_find.h"
#include "surface/complex/mass_properties.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/ray_parity.h"

namespace kerf {

namespace {

void turn(Triangle& facet) { std::swap(facet[1], facet[2]); }

// Breadth-first search over one shell at a time, relative to the orientation of its first facet.
class Propagation {
 public:
    Propagation(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner)
        : facets_(facets), partner_(partner), turned_(facets.size(), 0) {
        result_.shell.assign(facets.size(), -1);
    }

    FacetShells run() {
        for (std::int32_t f = 0; f < count_of(facets_); ++f)
            if (result_.shell[f] < 0) {
                search(f);
                turn_minority();
                ++result_.shell_count;
            }
        std::sort(result_.turned.begin(), result_.turned.end());
        return std::move(result_);
    }

 private:
    void search(std::int32_t seed) {
        members_.assign(1, seed);
        contradiction_ = -1;
        result_.shell[seed] = result_.shell_count;
        for (std::size_t i = 0; i < members_.size(); ++i)
            for (std::int32_t corner = 3 * members_[i]; corner < 3 * members_[i] + 3; ++corner)
                if (partner_[corner] >= 0) cross(corner);
        if (contradiction_ >= 0) result_.contradictions.push_back(contradiction_);
    }
    void cross(std::int32_t corner) {
        const std::int32_t facet = corner / 3, other = partner_[corner] / 3;
        const bool disagree = start_vertex(facets_, corner) == start_vertex(facets_, partner_[corner]);
        const char turned = turned_[facet] ^ disagree;
        if (result_.shell[other] < 0) {
            result_.shell[other] = result_.shell_count;
            turned_[other] = turned;
            members_.push_back(other);
        } else if (turned_[other] != turned && (contradiction_ < 0 || other < contradiction_)) {
            contradiction_ = other;
        }
    }
    void turn_minority() {
        const auto count = std::count_if(members_.begin(), members_.end(), [&](std::int32_t f) { return turned_[f]; });
        const char minority = 2 * count <= std::ssize(members_);
        for (std::int32_t f : members_)
            if (turned_[f] == minority) result_.turned.push_back(f);
    }

    const std::vector<Triangle>& facets_;
    const std::vector<std::int32_t>& partner_;
    std::vector<char> turned_;  // relative to the first facet of the shell
    std::vector<std::int32_t> members_;
    std::int32_t contradiction_ = -1;  // of the shell that is searched
    FacetShells result_;
};

// The findings about the neighbours of a range of facets.
struct RangeOfShells {
    bool agree = true;
    std::vector<std::int32_t> crossing;  // corners whose partners lie in an earlier range
};

// Shells of facets that all agree; nothing where some do not.
std::optional<FacetShells> shells_that_agree(const std::vector<Triangle>& facets,
                                             const std::vector<std::int32_t>& partner) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    UnionFind sets(facets.size());
    const auto ranges = values_of_ranges(facets.size(), grain, [&](const IndexRange& range) {
        RangeOfShells found;
        const std::int32_t first = 3 * range.first, last = 3 * range.last;
        for (std::int32_t c = first; c < last; ++c) {
            const std::int32_t other = partner[c];
            if (other < 0 || other > c) continue;
            found.agree &= start_vertex(facets, c) != start_vertex(facets, other);
            if (other >= first)
                sets.join(c / 3, other / 3);  // of one range, as all that these two are joined to by now
            else
                found.crossing.push_back(c);
        }
        return found;
    });
    for (const RangeOfShells& range : ranges) {
        if (!range.agree) return std::nullopt;
        for (const std::int32_t c : range.crossing) sets.join(c / 3, partner[c] / 3);
    }
    Components components = sets.take();
    return FacetShells{std::move(components.of), components.count, {}, {}};
}

// A vertex of a shell decides whether it lies in one whose box contains its own, unless it lies on that; then another
// one does.
std::optional<bool> is_inner(const std::vector<Vec3>& vertices, const Shell& inner, const Shell& outer) {
    constexpr std::size_t attempts = 8;
    for (std::size_t f = 0; f < std::min(attempts, inner.facets.size()); ++f)
        for (std::int32_t v : inner.facets[f])
            if (const auto inside = encloses(vertices, outer, vertices[v])) return inside;
    return std::nullopt;
}

// Sets parent, or contact, of a shell. `candidates`: the shells whose boxes are around its own, the smallest first.
void place_among(const std::vector<Vec3>& vertices, const std::vector<Shell>& shells,
                 const std::vector<std::int32_t>& candidates, const Shell& shell, ShellPlace& place) {
    for (const std::int32_t j : candidates) {
        const std::optional<bool> inner = is_inner(vertices, shell, shells[j]);
        if (inner == false) continue;
        (inner ? place.parent : place.touches) = j;
        return;
    }
}

// Sets parent, or contact, and direction of all. `order`: of the shells, the smallest boxes last.
void find_parents(const std::vector<Vec3>& vertices, const std::vector<Shell>& shells,
                  const std::vector<std::int32_t>& order, std::vector<ShellPlace>& places) {
    constexpr std::size_t grain = 64;
    std::vector<std::int32_t> rank(shells.size());
    for (std::int32_t k = 0; k < count_of(order); ++k) rank[order[k]] = k;
    const BoxTree boxes = boxes_of(shells);
    for_ranges_on_threads(shells.size(), grain, [&](const IndexRange& range) {
        for (std::size_t i = range.first; i < range.last; ++i) {
            std::vector<std::int32_t> candidates = boxes.around(shells[i].box);
            std::erase(candidates, static_cast<std::int32_t>(i));
            std::sort(candidates.begin(), candidates.end(),
                      [&](std::int32_t j, std::int32_t k) { return rank[j] > rank[k]; });
            place_among(vertices, shells, candidates, shells[i], places[i]);
            places[i].outward = is_outward(vertices, shells[i].facets);
        }
    });
}

void mark_shell_around(const std::vector<Vec3>& vertices, const std::vector<Shell>& shells, const Vec3& hole,
                       std::vector<ShellPlace>& places) {
    ShellPlace* innermost = nullptr;
    for (std::size_t i = 0; i < shells.size(); ++i) {
        if (!shells[i].box.contains(hole) || !encloses(vertices, shells[i], hole).value_or(false)) continue;
        if (!innermost || places[i].depth > innermost->depth) innermost = &places[i];
    }
    if (innermost) innermost->has_hole = true;
}

bool is_closed(const std::vector<std::int32_t>& partner) {
    return std::find(partner.begin(), partner.end(), -1) == partner.end();
}

[[noreturn]] void refuse(const Soup& soup, std::int32_t facet, const char* what) {
    const Vec3& p = soup.vertices[soup.facets[facet][0]];
    const std::int32_t number = soup.file_facets({facet})[0];
    throw Error(
        ErrorCode::input,
        fmt::format("The shell of facet {} near ({:.9g}, {:.9g}, {:.9g}) {}", number, p.x(), p.y(), p.z(), what),
        {{ElementKind::facet, {number}, {{p.x(), p.y(), p.z()}}, {}}});
}

}  // namespace

FacetShells find_facet_shells(const std::vector<Triangle>& facets, const std::vector<std::int32_t>& partner) {
    KERF_CHECK(have_distinct_corners(facets) && partner.size() == 3 * facets.size());
    if (std::optional<FacetShells> shells = shells_that_agree(facets, partner)) return std::move(*shells);
    return Propagation(facets, partner).run();
}

ConsistentFacets make_consistent(const std::vector<Triangle>& facets) {
    ConsistentFacets consistent{find_facet_shells(facets, edge_partners(facets)), facets};
    turn_facets(consistent.facets, consistent.turned);
    return consistent;
}

std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      const FacetShells& of_facets, const std::vector<Vec3>& holes) {
    const std::vector<Shell> shells = collect_shells(vertices, facets, of_facets.shell, of_facets.shell_count);
    std::vector<ShellPlace> places(shells.size());
    for (std::int32_t f = count_of(facets); f-- > 0;) places[of_facets.shell[f]].first_facet = f;
    const std::vector<std::int32_t> order = by_falling_boxes(shells);
    find_parents(vertices, shells, order, places);
    for (const std::int32_t i : order)
        if (places[i].parent >= 0) places[i].depth = places[places[i].parent].depth + 1;
    for (const Vec3& hole : holes) mark_shell_around(vertices, shells, hole, places);
    return places;
}

Orientation find_orientation(const FacetShells& shells, const std::vector<ShellPlace>& places) {
    KERF_CHECK(shells.contradictions.empty() && count_of(places) == shells.shell_count);
    Orientation orientation;
    orientation.report.facets_flipped = std::ssize(shells.turned);
    orientation.report.shells = shells.shell_count;
    std::vector<char> flip;
    for (const ShellPlace& place : places) {
        const bool is_void = place.depth % 2;
        flip.push_back(place.outward == is_void);
        orientation.report.shells_flipped += flip.back();
    }
    if (orientation.report.shells_flipped == 0) {
        orientation.turned = shells.turned;
        return orientation;
    }
    auto next = shells.turned.begin();
    for (std::int32_t f = 0; f < count_of(shells.shell); ++f) {
        const bool is_turned = next != shells.turned.end() && *next == f;
        next += is_turned;
        if (is_turned != (flip[shells.shell[f]] != 0)) orientation.turned.push_back(f);
    }
    return orientation;
}

void turn_facets(std::vector<Triangle>& facets, const std::vector<std::int32_t>& turned) {
    for (const std::int32_t f : turned) turn(facets[f]);
}

OrientationReport orient(Soup& soup) {
    KERF_CHECK(are_in_range(soup.facets, soup.vertices.size()));
    std::vector<std::int32_t> partner = edge_partners(soup.facets);
    KERF_CHECK(is_closed(partner));
    const FacetShells shells = find_facet_shells(soup.facets, partner);
    partner = {};
    if (!shells.contradictions.empty())
        refuse(soup, shells.contradictions[0], "is one-sided like a Moebius strip. It bounds no body: model it again.");
    turn_facets(soup.facets, shells.turned);
    const std::vector<ShellPlace> places = locate_shells(soup.vertices, soup.facets, shells);
    for (const ShellPlace& place : places)
        if (place.touches >= 0)
            refuse(
                soup, place.first_facet,
                "touches another one, so that inside and outside cannot be told apart. Unite the bodies or move them "
                "apart.");
    Orientation orientation = find_orientation(shells, places);
    turn_facets(soup.facets, shells.turned);  // back again
    turn_facets(soup.facets, orientation.turned);
    return orientation.report;
}

}  // namespace kerf

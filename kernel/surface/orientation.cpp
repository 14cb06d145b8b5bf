// A search over the edges of two facets turns facets until neighbours agree.
//
// Nesting by parity: shells do not meet, so one vertex of a shell tells whether the whole shell lies within another
// one. Of those around a shell each lies within the next, so that they have the order of their boxes: the innermost is
// the first to be found from the smallest box on, and has the others around itself.
#include "surface/orientation.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/check.h"
#include "core/elements.h"
#include "core/error.h"
#include "surface/edge_corners.h"
#include "surface/mass_properties.h"
#include "surface/ray_parity.h"

namespace kerf {

namespace {

void turn(Triangle& facet) { std::swap(facet[1], facet[2]); }

// Breadth-first search over one shell at a time, relative to the orientation of its first facet.
class Propagation {
 public:
    explicit Propagation(const std::vector<Triangle>& facets)
        : facets_(facets), partner_(edge_partners(facets)), turned_(facets.size(), 0) {
        result_.facets = facets;
        result_.shell.assign(facets.size(), -1);
    }

    ConsistentFacets run() {
        for (std::size_t f = 0; f < facets_.size(); ++f)
            if (result_.shell[f] < 0) {
                search(static_cast<std::int32_t>(f));
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
        const char turned = turned_[facet] ^ static_cast<char>(disagree);
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
        const auto size = static_cast<std::ptrdiff_t>(members_.size());
        const char minority = 2 * count <= size;
        for (std::int32_t f : members_) {
            if (turned_[f] != minority) continue;
            turn(result_.facets[f]);
            result_.turned.push_back(f);
        }
    }

    const std::vector<Triangle>& facets_;
    std::vector<std::int32_t> partner_;
    std::vector<char> turned_;  // relative to the first facet of the shell
    std::vector<std::int32_t> members_;
    std::int32_t contradiction_ = -1;  // of the shell that is searched
    ConsistentFacets result_;
};

// A vertex of a shell decides whether it lies in one whose box contains its own, unless it lies on that; then another
// one does.
std::optional<bool> is_inner(const std::vector<Vec3>& vertices, const Shell& inner, const Shell& outer) {
    constexpr std::size_t attempts = 8;
    for (std::size_t f = 0; f < std::min(attempts, inner.facets.size()); ++f)
        for (std::int32_t v : inner.facets[f])
            if (const auto inside = encloses(vertices, outer, vertices[v])) return inside;
    return std::nullopt;
}

// Sets depth and parent, or contact, of shell i, once those of the shells with larger boxes are known. `rank`: of the
// shells, the smallest boxes last.
void place_among(const std::vector<Vec3>& vertices, const std::vector<Shell>& shells, const BoxTree& boxes,
                 const std::vector<std::int32_t>& rank, std::int32_t i, std::vector<ShellPlace>& places) {
    std::vector<std::int32_t> candidates = boxes.around(shells[i].box);
    std::erase(candidates, i);
    std::sort(candidates.begin(), candidates.end(), [&](std::int32_t j, std::int32_t k) { return rank[j] > rank[k]; });
    for (const std::int32_t j : candidates) {
        const std::optional<bool> inner = is_inner(vertices, shells[i], shells[j]);
        if (inner == false) continue;
        if (inner) {
            places[i].parent = j;
            places[i].depth = places[j].depth + 1;
        } else {
            places[i].touches = j;
        }
        return;
    }
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

bool is_closed(const std::vector<Triangle>& facets) {
    const std::vector<std::int32_t> partner = edge_partners(facets);
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

ConsistentFacets make_consistent(const std::vector<Triangle>& facets) {
    KERF_CHECK(have_distinct_corners(facets));
    return Propagation(facets).run();
}

std::vector<ShellPlace> locate_shells(const std::vector<Vec3>& vertices, const ConsistentFacets& consistent,
                                      const std::vector<Vec3>& holes) {
    const std::vector<Shell> shells =
        collect_shells(vertices, consistent.facets, consistent.shell, consistent.shell_count);
    std::vector<ShellPlace> places(shells.size());
    for (std::size_t f = consistent.shell.size(); f-- > 0;)
        places[consistent.shell[f]].first_facet = static_cast<std::int32_t>(f);
    const BoxTree boxes = boxes_of(shells);
    const std::vector<std::int32_t> order = by_falling_boxes(shells);
    std::vector<std::int32_t> rank(shells.size());
    for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = static_cast<std::int32_t>(k);
    for (const std::int32_t i : order) {
        place_among(vertices, shells, boxes, rank, i, places);
        places[i].outward = is_outward(vertices, shells[i].facets);
    }
    for (const Vec3& hole : holes) mark_shell_around(vertices, shells, hole, places);
    return places;
}

OrientationReport orient(Soup& soup) {
    KERF_CHECK(are_in_range(soup.facets, soup.vertices.size()));
    KERF_CHECK(is_closed(soup.facets));
    ConsistentFacets consistent = make_consistent(soup.facets);
    if (!consistent.contradictions.empty())
        refuse(soup, consistent.contradictions[0],
               "is one-sided like a Moebius strip. It bounds no body: model it again.");
    OrientationReport report;
    report.facets_flipped = static_cast<std::int64_t>(consistent.turned.size());
    report.shells = consistent.shell_count;
    std::vector<char> flip;
    for (const ShellPlace& shell : locate_shells(soup.vertices, consistent)) {
        if (shell.touches >= 0)
            refuse(
                soup, shell.first_facet,
                "touches another one, so that inside and outside cannot be told apart. Unite the bodies or move them "
                "apart.");
        const bool is_void = shell.depth % 2;
        flip.push_back(shell.outward == is_void);
        report.shells_flipped += flip.back();
    }
    soup.facets = std::move(consistent.facets);
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        if (flip[consistent.shell[f]]) turn(soup.facets[f]);
    return report;
}

}  // namespace kerf

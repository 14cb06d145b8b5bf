// Patches are chosen in rounds. A round makes a patch of its current shape for each open opening, adds all patches to
// the surface, and looks for facets of open patches that cross something. Of two new patches the later gives way, of a
// new and a settled one the new; the one that gives way tries the next shape (smooth, relaxed, plain), and after the
// last one its opening stays open. Two patches with the same chord, an edge between points of rims, count as crossing,
// since the edge would have four facets. Comparisons are made on vertices welded by coordinates, so that patches at
// equal points are neighbours.
//
// If crossings are so many that the search ends early, no patch is settled in that round. An opening is "folded" if its
// plain patch meets facets of the surface with which it shares vertices: let_cross() leaves it open, and fills the
// others across the surface where that may be.
#include "surface/openings/opening_filler.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/predicates.h"
#include "base/geometry/triangle.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

// Returns for each vertex the first one with its coordinates.
std::vector<std::int32_t> first_in_place(const std::vector<Vec3>& vertices) {
    std::vector<std::int32_t> order, first(vertices.size());
    std::iota(first.begin(), first.end(), 0);
    for (const std::int32_t v : first)
        if (vertices[v].allFinite()) order.push_back(v);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t a, std::int32_t b) { return lexicographically_less(vertices[a], vertices[b]); });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (vertices[order[i]] == vertices[order[i - 1]]) first[order[i]] = first[order[i - 1]];
    return first;
}

bool is_no_triangle(const std::vector<Vec3>& vertices, const Triangle& t) {
    if (has_repeated_vertex(t)) return true;
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
        if (!vertices[t[i]].allFinite()) return true;
        longest = std::max(longest, (vertices[t[(i + 1) % 3]] - vertices[t[i]]).squaredNorm());
    }
    constexpr double nothing = 1e-12;
    return !(doubled_area_vector(vertices, t).norm() > nothing * longest);
}

class OpeningFiller {
 public:
    OpeningFiller(const OpenRims& all, std::vector<RimOpening> openings, const FillingRequest& request)
        : all_(all), request_(request), vertices_(all.soup().vertices), first_(first_in_place(vertices_)) {
        for (RimOpening& opening : openings) {
            const bool is_smooth = opening.bend < BendDegrees::lid && !opening.is_flat;
            filled_.push_back({std::move(opening), {}, is_smooth ? PatchShape::smooth : PatchShape::relaxed});
        }
        for (const Triangle& t : all.soup().facets) {
            const Triangle welded = {first_[t[0]], first_[t[1]], first_[t[2]]};
            if (!is_no_triangle(vertices_, welded)) facets_.push_back(welded);
        }
        surface_count_ = facets_.size();
        surface_vertices_ = vertices_.size();
        is_open_.assign(filled_.size(), 1);
        is_folded_.assign(filled_.size(), 0);
    }

    std::vector<FilledOpening> run() {
        constexpr int most_filling_rounds = 12;
        for (int round = 0; round < most_filling_rounds && make_patches(); ++round)
            settle(round + 1 == most_filling_rounds);
        if (request_.may_cross) let_cross();
        return std::move(filled_);
    }

 private:
    // Makes patches for all openings that have none; false if no patch is left to be looked at.
    bool make_patches() {
        bool is_any = false;
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            FilledOpening& filled = filled_[i];
            while (is_open_[i] && !filled.patch) {
                request_.check_cancelled();
                ShapedPatch made = make_patch(all_, filled.opening, filled.shape, request_.growth);
                if (made.is_usable && has_triangles(made.mesh))
                    filled.patch = std::move(made.mesh);
                else
                    try_next(i);
            }
            is_any |= is_open_[i] != 0;
        }
        return is_any;
    }
    static bool has_triangles(const PatchMesh& mesh) {
        return std::none_of(mesh.triangles().begin(), mesh.triangles().end(),
                            [&](const Triangle& t) { return is_no_triangle(mesh.points(), t); });
    }
    void try_next(std::size_t i) {
        filled_[i].patch.reset();
        if (filled_[i].shape == PatchShape::plain)
            is_open_[i] = 0;
        else
            filled_[i].shape = static_cast<PatchShape>(static_cast<int>(filled_[i].shape) + 1);
    }
    // Patches that meet something get the next shape, or none if it is the last round.
    void settle(bool is_last) {
        facets_.resize(surface_count_);
        vertices_.resize(surface_vertices_);
        owner_.assign(surface_count_, -1);
        for (std::size_t i = 0; i < filled_.size(); ++i)
            if (filled_[i].patch) add_facets(i);
        std::vector<char> chosen(facets_.size(), 0), meets(filled_.size(), 0);
        for (std::size_t f = surface_count_; f < facets_.size(); ++f) chosen[f] = is_open_[owner_[f]];
        constexpr std::size_t most_pairs = 200'000;
        const auto pairs = find_intersections_of(chosen, vertices_, facets_, most_pairs);
        for (const auto& [f, g] : pairs) {
            const std::int32_t one = owner_[f], two = owner_[g];
            // Two new patches: the later one gives way. Otherwise the new one does.
            const bool first_gives_way = two < 0 || !is_open_[two] || (one > two && is_open_[one]);
            const std::int32_t which = one >= 0 && first_gives_way && is_open_[one] ? one : two;
            meets[which] = 1;
            if (is_last && one >= 0 && is_open_[one]) meets[one] = 1;
            if (filled_[which].shape == PatchShape::plain && (one < 0 || two < 0)) note_fold(which, f, g);
        }
        mark_equal_chords(meets);
        const bool is_complete = pairs.size() < most_pairs;
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            if (!is_open_[i]) continue;
            if (!meets[i])
                is_open_[i] = !is_complete && !is_last;
            else if (is_last)
                filled_[i].patch.reset(), is_open_[i] = 0;
            else
                try_next(i);
            if (is_last && !is_complete) filled_[i].patch.reset();
        }
    }
    void add_facets(std::size_t i) {
        const PatchMesh& patch = *filled_[i].patch;
        const std::vector<std::int32_t> number = numbers(i, count_of(vertices_));
        vertices_.insert(vertices_.end(), patch.points().begin() + patch.rim_count(), patch.points().end());
        for (const Triangle& t : patch.triangles()) {
            facets_.push_back({number[t[0]], number[t[1]], number[t[2]]});
            owner_.push_back(i);
        }
    }
    // Returns numbers for the points of a patch: those of the surface, then numbers from `next` on.
    std::vector<std::int32_t> numbers(std::size_t i, std::int32_t next) const {
        std::vector<std::int32_t> number;
        for (const Rim* rim : filled_[i].opening.rims)
            for (const std::int32_t v : rim->vertices) number.push_back(first_[v]);
        while (count_of(number) < filled_[i].patch->count()) number.push_back(next++);
        return number;
    }
    // Marks two patches with the same edge between vertices of their rims, which would have four facets.
    void mark_equal_chords(std::vector<char>& meets) {
        std::vector<std::pair<UndirectedEdge, std::size_t>> chords;
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            if (!filled_[i].patch) continue;
            const std::vector<std::int32_t> number = numbers(i, 0);
            for (const UndirectedEdge& e : filled_[i].patch->chords())
                chords.emplace_back(undirected(number[e[0]], number[e[1]]), i);
        }
        std::sort(chords.begin(), chords.end());
        for (std::size_t c = 1; c < chords.size(); ++c)
            if (chords[c].first == chords[c - 1].first) {
                const bool later_is_open = is_open_[chords[c].second];
                meets[later_is_open ? chords[c].second : chords[c - 1].second] = 1;
            }
    }
    // Notes a patch that meets facets with which it also shares vertices.
    void note_fold(std::int32_t which, std::int32_t f, std::int32_t g) {
        for (const std::int32_t v : facets_[f])
            for (const std::int32_t w : facets_[g]) is_folded_[which] |= v == w;
    }
    void let_cross() {
        for (std::size_t i = 0; i < filled_.size(); ++i) {
            if (filled_[i].patch || is_folded_[i] || filled_[i].opening.bend > BendDegrees::folded) continue;
            ShapedPatch made = make_patch(all_, filled_[i].opening, PatchShape::relaxed, request_.growth);
            if (!made.is_usable || !has_triangles(made.mesh)) continue;
            filled_[i].patch = std::move(made.mesh);
            filled_[i].shape = PatchShape::relaxed;
            filled_[i].crosses = true;
        }
    }

    const OpenRims& all_;
    const FillingRequest& request_;
    std::vector<FilledOpening> filled_;
    std::vector<Vec3> vertices_;       // of the surface, then of patches
    std::vector<std::int32_t> first_;  // #V of the surface
    std::vector<Triangle> facets_;     // of the surface if they have area, then of patches
    std::size_t surface_count_ = 0, surface_vertices_ = 0;
    std::vector<std::int32_t> owner_;  // of each facet; -1: the surface
    std::vector<char> is_open_;        // per opening: its patch is not settled
    std::vector<char> is_folded_;
};

}  // namespace

double FilledOpening::area() const {
    double sum = 0;
    for (const Triangle& t : patch->triangles()) sum += triangle_area(patch->points(), t);
    return sum;
}

double FilledOpening::height() const {
    if (opening.rims.size() > 1) return 0;
    const auto& points = patch->points();
    const RimPlane plane = rim_plane({points.begin(), points.begin() + patch->rim_count()});
    double largest = 0;
    for (std::int32_t v = patch->rim_count(); v < patch->count(); ++v)
        largest = std::max(largest, std::abs(plane.normal.dot(points[v] - plane.centre)));
    return largest;
}

std::vector<FilledOpening> fill_openings(const OpenRims& all, std::vector<RimOpening> openings,
                                         const FillingRequest& request) {
    if (openings.empty()) return {};
    return OpeningFiller(all, std::move(openings), request).run();
}

PatchAppender::PatchAppender(Soup& soup) : soup_(soup) {
    const auto next = [](const std::vector<std::int32_t>& numbers) {
        return numbers.empty() ? 0 : 1 + *std::max_element(numbers.begin(), numbers.end());
    };
    next_vertex_ = next(soup.vertex_number);
    next_polygon_ = next(soup.polygon);
}

void PatchAppender::append(const FilledOpening& filled, std::int32_t patch) {
    std::vector<std::int32_t> number;
    for (const Rim* rim : filled.opening.rims) number.insert(number.end(), rim->vertices.begin(), rim->vertices.end());
    const PatchMesh& mesh = *filled.patch;
    for (std::int32_t v = mesh.rim_count(); v < mesh.count(); ++v) {
        number.push_back(count_of(soup_.vertices));
        soup_.vertices.push_back(mesh.points()[v]);
        if (!soup_.vertex_number.empty()) soup_.vertex_number.push_back(next_vertex_++);
    }
    for (const Triangle& t : mesh.triangles()) {
        soup_.facets.push_back({number[t[0]], number[t[1]], number[t[2]]});
        soup_.patch.push_back(patch);
        if (!soup_.polygon.empty()) soup_.polygon.push_back(next_polygon_++);
    }
}

std::int32_t add_patch(Soup& soup, const std::string& name) {
    const auto is_known = [&](const std::string& wanted) {
        return std::find(soup.patch_names.begin(), soup.patch_names.end(), wanted) != soup.patch_names.end();
    };
    std::string free = name;
    for (int n = 2; is_known(free); ++n) free = fmt::format("{}_{}", name, n);
    soup.patch_names.push_back(free);
    if (!soup.patch_colours.empty()) soup.patch_colours.push_back({0, 0, 0, 0});
    return count_of(soup.patch_names) - 1;
}

}  // namespace kerf

#include "repair/arrangement.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/elements.h"
#include "geometry/predicates.h"
#include "geometry/union_find.h"
#include "repair/crossing_pairs.h"
#include "repair/distinct_points.h"
#include "repair/facet_contact.h"
#include "repair/facet_divider.h"

namespace kerf {

namespace {

constexpr int most_arrangement_rounds = 4;
constexpr int fine_rounds = 3;         // with new points at the nearest doubles
constexpr int coarser_each_round = 2;  // bits

bool are_copies(const Triangle& s, const Triangle& t) { return std::is_permutation(s.begin(), s.end(), t.begin()); }

class Arranger {
 public:
    Arranger(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const std::function<void()>& poll)
        : given_vertices_(vertices.size()), points_(vertices), poll_(poll) {
        for (const Vec3& p : vertices) extent_ = std::max(extent_, p.cwiseAbs().maxCoeff());
        for (std::size_t f = 0; f < facets.size(); ++f) {
            Triangle t = facets[f];
            for (std::int32_t& v : t) v = points_.number_of(vertices[v]);
            if (has_repeated_vertex(t) || axis_across(corners(t)) < 0) continue;
            facets_.push_back(t);
            parent_.push_back(static_cast<std::int32_t>(f));
        }
        changed_.assign(facets_.size(), 1);
    }

    Arrangement run() {
        std::vector<FacetPair> pairs = find_pairs();
        result_.crossing_pairs = static_cast<std::int64_t>(pairs.size());
        for (; has_crossing(pairs) && result_.rounds < most_arrangement_rounds; pairs = find_pairs()) {
            divide(pairs);
            ++result_.rounds;
        }
        return finish(pairs);
    }

 private:
    Corners corners(const Triangle& t) const { return {points_.all()[t[0]], points_.all()[t[1]], points_.all()[t[2]]}; }
    std::vector<FacetPair> find_pairs() const {
        return crossing_pairs(points_.all(), facets_, changed_, most_pairs(), poll_);
    }
    std::size_t most_pairs() const { return 1'000'000 + 8 * facets_.size(); }
    bool are_copies(const FacetPair& pair) const { return kerf::are_copies(facets_[pair[0]], facets_[pair[1]]); }
    bool has_crossing(const std::vector<FacetPair>& pairs) const {
        return !std::all_of(pairs.begin(), pairs.end(), [&](const FacetPair& pair) { return are_copies(pair); });
    }

    bool share_area(const FacetPair& pair) const;
    double grid() const;
    void divide(const std::vector<FacetPair>& pairs);
    void join_copies(const std::vector<std::int32_t>& divided, UnionFind& plane) const;
    void replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided);
    Arrangement finish(const std::vector<FacetPair>& pairs);

    const std::size_t given_vertices_;
    DistinctPoints points_;
    const std::function<void()>& poll_;
    double extent_ = 0;  // the largest coordinate
    std::vector<Triangle> facets_;
    std::vector<std::int32_t> parent_;
    std::vector<char> changed_;  // of facets: since crossings were looked for
    Arrangement result_;
};

bool Arranger::share_area(const FacetPair& pair) const {
    if (are_copies(pair)) return true;
    const Corners p = corners(facets_[pair[0]]), q = corners(facets_[pair[1]]);
    for (const Vec3& x : q)
        if (orientation(p[0], p[1], p[2], x) != 0) return false;
    return kerf::share_area(p, q, axis_across(p));
}

double Arranger::grid() const {
    if (result_.rounds < fine_rounds) return 0;
    return std::ldexp(1.0, std::ilogb(extent_) - 52 + coarser_each_round * (result_.rounds - fine_rounds + 1));
}

// Facets with the same corners are divided together, also where only others of their pairs were looked for.
void Arranger::join_copies(const std::vector<std::int32_t>& divided, UnionFind& plane) const {
    std::vector<std::pair<Triangle, std::int32_t>> sorted;
    sorted.reserve(divided.size());
    for (const std::int32_t f : divided) {
        Triangle t = facets_[f];
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, f);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first) plane.join(sorted[i].second, sorted[i - 1].second);
}

void Arranger::divide(const std::vector<FacetPair>& pairs) {
    UnionFind plane(facets_.size());
    std::vector<FacetPair> contacts;
    std::vector<char> is_divided(facets_.size(), 0);
    for (const FacetPair& pair : pairs) {
        if (share_area(pair)) {
            plane.join(pair[0], pair[1]);
            if (result_.rounds == 0) ++result_.coplanar_overlaps;
        } else {
            contacts.push_back(pair);
            contacts.push_back({pair[1], pair[0]});
        }
        for (const std::int32_t f : pair) is_divided[f] = 1;
    }
    std::sort(contacts.begin(), contacts.end());
    std::vector<std::int32_t> divided;
    for (std::size_t f = 0; f < facets_.size(); ++f)
        if (is_divided[f]) divided.push_back(static_cast<std::int32_t>(f));
    join_copies(divided, plane);
    std::stable_sort(divided.begin(), divided.end(),
                     [&](std::int32_t a, std::int32_t b) { return plane.root(a) < plane.root(b); });
    std::vector<std::int32_t> others;
    others.reserve(contacts.size());
    for (const FacetPair& contact : contacts) others.push_back(contact[1]);

    FacetDivider divider(points_, facets_, grid());
    std::vector<FacetPiece> pieces;
    std::vector<CrossedFacet> members;
    for (std::size_t i = 0; i < divided.size();) {
        poll_();
        members.clear();
        const std::int32_t root = plane.root(divided[i]);
        for (; i < divided.size() && plane.root(divided[i]) == root; ++i) {
            const auto [first, last] =
                std::equal_range(contacts.begin(), contacts.end(), FacetPair{divided[i], 0},
                                 [](const FacetPair& a, const FacetPair& b) { return a[0] < b[0]; });
            members.push_back({divided[i], std::span(others).subspan(first - contacts.begin(), last - first)});
        }
        divider.divide(members, pieces);
    }
    result_.largest_rounding = std::max(result_.largest_rounding, divider.largest_rounding());
    replace(pieces, is_divided);
}

// Puts the pieces into the places of what was divided.
void Arranger::replace(std::vector<FacetPiece>& pieces, const std::vector<char>& is_divided) {
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const FacetPiece& a, const FacetPiece& b) { return a.facet < b.facet; });
    std::vector<Triangle> facets;
    std::vector<std::int32_t> parent;
    changed_.clear();
    auto piece = pieces.begin();
    const auto add = [&](const Triangle& t, std::size_t of, char is_changed) {
        facets.push_back(t);
        parent.push_back(parent_[of]);
        changed_.push_back(is_changed);
    };
    for (std::size_t f = 0; f < facets_.size(); ++f) {
        if (!is_divided[f]) add(facets_[f], f, 0);
        for (; piece != pieces.end() && piece->facet == static_cast<std::int32_t>(f); ++piece)
            add(piece->corners, f, 1);
    }
    facets_ = std::move(facets);
    parent_ = std::move(parent);
}

Arrangement Arranger::finish(const std::vector<FacetPair>& pairs) {
    for (const FacetPair& pair : pairs) {
        if (are_copies(pair)) continue;
        const Corners p = corners(facets_[pair[0]]);
        result_.unresolved.push_back({(p[0] + p[1] + p[2]) / 3, pair});
    }
    result_.vertices = points_.take();
    result_.new_vertices = static_cast<std::int64_t>(result_.vertices.size() - given_vertices_);
    result_.facets = std::move(facets_);
    result_.parent = std::move(parent_);
    return std::move(result_);
}

}  // namespace

Arrangement arrange(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                    const std::function<void()>& poll) {
    return Arranger(
               vertices, facets, poll ? poll : [] {})
        .run();
}

}  // namespace kerf

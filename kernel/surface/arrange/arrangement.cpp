// Rounds of division. A round finds the pairs of facets that meet elsewhere than in shared vertices and edges
// (crossing_pairs.h), puts facets that share area in one plane into groups (plane_groups.h), and has each group divided
// exactly by all facets that touch it (facet_divider.h). The new points are rounded to doubles, and facets with a
// common edge are given the same points on it (divided_facets.h), so that nothing opens.
//
// Rounding may make pieces cross again (Lazard and Valque 2025, lazard2025). Further rounds look only at facets that
// have changed, and first join vertices, edges and facets nearer than a tolerance (near_features.h), since rounding
// alone would make them cross again and again; the tolerance grows with each round. Some surfaces get worse from round
// to round: then the round with the fewest pairs counts. "Copies", which are facets with the same three vertices, do
// not count as crossing. All lists of pairs, groups and pieces are ascending, on which the result depends.
#include "surface/arrange/arrangement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base/core/ids.h"
#include "base/geometry/predicates.h"
#include "surface/arrange/inside/crossing_pairs.h"
#include "surface/arrange/inside/divided_facets.h"
#include "surface/arrange/inside/facet_divider.h"
#include "surface/arrange/inside/near_features.h"
#include "surface/arrange/inside/plane_groups.h"

namespace kerf {

namespace {

constexpr int most_arrangement_rounds = 10;
constexpr int exact_rounds = 1;         // which divide without a tolerance
constexpr double first_tolerance = 4;   // of the first further round, in spacings of doubles at the largest coordinate
constexpr double tolerance_growth = 4;  // in each round
constexpr double bent_tolerances = 2;   // for walls whose facets are bent by the vertices of others

bool are_copies(const Triangle& s, const Triangle& t) { return std::is_permutation(s.begin(), s.end(), t.begin()); }

class Arranger {
 public:
    Arranger(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
             const std::function<void()>& check_cancelled)
        : given_vertices_(vertices.size()),
          given_facets_(facets.size()),
          divided_{DistinctPoints(vertices)},
          check_cancelled_(check_cancelled) {
        for (const Vec3& p : vertices) extent_ = std::max(extent_, p.cwiseAbs().maxCoeff());
        for (std::int32_t f = 0; f < count_of(facets); ++f) {
            Triangle t = facets[f];
            for (std::int32_t& v : t) v = divided_.points.number_of(vertices[v]);
            if (!divided_.has_area(t)) continue;
            divided_.facets.push_back(t);
            divided_.parent.push_back(f);
        }
        divided_.changed.assign(divided_.facets.size(), 1);
    }

    Arrangement run() {
        std::vector<FacetPair> pairs = find_pairs();
        result_.crossing_pairs = std::ssize(pairs);
        for (; is_to_be_divided(pairs); ++result_.rounds, pairs = find_pairs()) {
            if (result_.rounds > 0) keep_if_best(pairs);
            if (result_.rounds >= exact_rounds) pairs = join_near(pairs);
            divide(pairs);
        }
        if (has_crossing(pairs) && !best_.facets.empty() && best_.pairs.size() < pairs.size()) {
            divided_.facets = std::move(best_.facets);
            divided_.parent = std::move(best_.parent);
            pairs = std::move(best_.pairs);
        }
        return finish(pairs);
    }

    Arrangement run_walls(const std::vector<char>& is_wall, double tolerance) {
        given_tolerance_ = bent_tolerances * tolerance;
        std::vector<FacetPair> pairs;
        for (auto fewest = std::numeric_limits<std::size_t>::max(); result_.rounds < most_arrangement_rounds;
             ++result_.rounds) {
            const double move =
                join_near_features(divided_, pieces_of(is_wall), tolerance, given_vertices_, check_cancelled_);
            result_.largest_move = std::max(result_.largest_move, move);
            const std::vector<char> walls = pieces_of(is_wall);
            std::vector<char> reached = walls;
            pairs = plane_overlaps(divided_, reached, *given_tolerance_, check_cancelled_);
            std::erase_if(pairs, [&](const FacetPair& pair) { return !walls[pair[0]] || !walls[pair[1]]; });
            const auto copies = std::count_if(pairs.begin(), pairs.end(), [&](const auto& p) { return are_copies(p); });
            const std::size_t unlike = pairs.size() - copies;
            if (unlike == 0 || unlike >= fewest) break;
            fewest = unlike;
            divide(pairs);
        }
        return finish(pairs);
    }

 private:
    // Hands a property of given facets (#F) on to their pieces.
    std::vector<char> pieces_of(const std::vector<char>& given) const {
        std::vector<char> pieces;
        for (const std::int32_t parent : divided_.parent) pieces.push_back(given[parent]);
        return pieces;
    }
    std::vector<FacetPair> find_pairs() {
        std::vector<FacetPair> pairs =
            crossing_pairs(divided_.points.all(), divided_.facets, divided_.changed, most_pairs(), check_cancelled_);
        std::fill(divided_.changed.begin(), divided_.changed.end(), 0);
        return pairs;
    }
    // A surface with more pairs is hopeless: a solid tangle, or one that rounding makes worse and worse.
    std::size_t most_pairs() const {
        if (result_.rounds > 0) return 5000 + 10 * result_.crossing_pairs;
        return 200'000 + 2 * divided_.facets.size();
    }
    bool are_copies(const FacetPair& pair) const {
        return kerf::are_copies(divided_.facets[pair[0]], divided_.facets[pair[1]]);
    }
    bool has_crossing(const std::vector<FacetPair>& pairs) const {
        return !std::all_of(pairs.begin(), pairs.end(), [&](const FacetPair& pair) { return are_copies(pair); });
    }
    bool is_to_be_divided(const std::vector<FacetPair>& pairs) const {
        return result_.rounds < most_arrangement_rounds && pairs.size() <= most_pairs() && has_crossing(pairs);
    }
    // Rounding may make more facets cross than in the round before: then the round with the fewest counts.
    void keep_if_best(const std::vector<FacetPair>& pairs) {
        if (!best_.facets.empty() && best_.pairs.size() <= pairs.size()) return;
        best_ = {divided_.facets, divided_.parent, pairs};
    }
    double tolerance() const;
    bool share_area(const FacetPair& pair) const;
    std::vector<FacetPair> join_near(const std::vector<FacetPair>& pairs);
    void divide(const std::vector<FacetPair>& pairs);
    Arrangement finish(const std::vector<FacetPair>& pairs);

    const std::size_t given_vertices_, given_facets_;
    DividedFacets divided_;
    const std::function<void()>& check_cancelled_;
    double extent_ = 0;                           // the largest coordinate
    std::optional<double> given_tolerance_ = {};  // instead of that for roundings
    struct Best {
        std::vector<Triangle> facets;
        std::vector<std::int32_t> parent;
        std::vector<FacetPair> pairs;
    } best_;
    Arrangement result_;
};

bool Arranger::share_area(const FacetPair& pair) const {
    if (are_copies(pair)) return true;
    const Corners p = divided_.corners(divided_.facets[pair[0]]), q = divided_.corners(divided_.facets[pair[1]]);
    if (!lie_in_one_plane(p, q, tolerance())) return false;
    return kerf::share_area(p, q, axis_across(p));
}

double Arranger::tolerance() const {
    if (given_tolerance_) return *given_tolerance_;
    const double spacing = std::ldexp(1.0, std::ilogb(extent_) - 52);
    return first_tolerance * std::pow(tolerance_growth, std::max(0, result_.rounds - exact_rounds)) * spacing;
}

// Joins near features, because rounding alone would make them cross again and again. Adds the pairs of facets that lie
// on one another up to roundings, which are divided as if they did so exactly.
std::vector<FacetPair> Arranger::join_near(const std::vector<FacetPair>& pairs) {
    std::vector<char> is_near(divided_.facets.size(), 0);
    for (const FacetPair& pair : pairs)
        if (!are_copies(pair))
            for (const std::int32_t f : pair) is_near[f] = 1;
    plane_overlaps(divided_, is_near, tolerance(), check_cancelled_);
    result_.largest_move = std::max(result_.largest_move, join_near_features(divided_, std::move(is_near), tolerance(),
                                                                             given_vertices_, check_cancelled_));
    std::vector<char> changed = divided_.changed;
    std::vector<FacetPair> joined = find_pairs();
    const std::vector<FacetPair> overlaps = plane_overlaps(divided_, changed, tolerance(), check_cancelled_);
    joined.insert(joined.end(), overlaps.begin(), overlaps.end());
    std::sort(joined.begin(), joined.end());
    joined.erase(std::unique(joined.begin(), joined.end()), joined.end());
    return joined;
}

// Returns both directions of the pairs that are not in one group, ascending.
std::vector<FacetPair> contacts_between(const PlaneGroups& groups, const std::vector<FacetPair>& pairs) {
    std::vector<FacetPair> contacts;
    for (const auto& [a, b] : pairs)
        if (groups.of[a] != groups.of[b]) contacts.insert(contacts.end(), {{a, b}, {b, a}});
    std::sort(contacts.begin(), contacts.end());
    return contacts;
}

void Arranger::divide(const std::vector<FacetPair>& pairs) {
    std::vector<FacetPair> overlaps;
    std::vector<char> is_divided(divided_.facets.size(), 0);
    for (const FacetPair& pair : pairs) {
        if (share_area(pair)) overlaps.push_back(pair);
        for (const std::int32_t f : pair) is_divided[f] = 1;
    }
    if (result_.rounds == 0) result_.coplanar_overlaps = std::ssize(overlaps);
    std::vector<std::int32_t> chosen;
    for (std::int32_t f = 0; f < count_of(divided_.facets); ++f)
        if (is_divided[f]) chosen.push_back(f);
    const PlaneGroups groups = group_planes(divided_, chosen, overlaps, tolerance());
    const std::vector<FacetPair> contacts = contacts_between(groups, pairs);
    std::vector<std::int32_t> others;
    others.reserve(contacts.size());
    for (const FacetPair& contact : contacts) others.push_back(contact[1]);

    FacetDivider divider(divided_.points, divided_.facets);
    std::vector<FacetPiece> pieces;
    std::vector<PointOnEdge> on_edges;
    std::vector<CrossedFacet> members;
    for (std::size_t g = 0; g < groups.count(); ++g) {
        check_cancelled_();
        members.clear();
        for (std::size_t i = groups.first[g]; i < groups.first[g + 1]; ++i) {
            const auto [first, last] =
                std::equal_range(contacts.begin(), contacts.end(), FacetPair{groups.facets[i], 0},
                                 [](const FacetPair& a, const FacetPair& b) { return a[0] < b[0]; });
            members.push_back({groups.facets[i], std::span(others).subspan(first - contacts.begin(), last - first)});
        }
        divider.divide(members, pieces, on_edges);
    }
    result_.largest_rounding = std::max(result_.largest_rounding, divider.largest_rounding());
    divided_.share_points(pieces, is_divided, on_edges);
    divided_.replace(pieces, is_divided);
}

Arrangement Arranger::finish(const std::vector<FacetPair>& pairs) {
    for (const FacetPair& pair : pairs) {
        if (are_copies(pair)) continue;
        const Corners p = divided_.corners(divided_.facets[pair[0]]);
        result_.unresolved.push_back({(p[0] + p[1] + p[2]) / 3, pair});
    }
    result_.vertices = divided_.points.take();
    result_.new_vertices = result_.vertices.size() - given_vertices_;
    std::vector<std::int32_t> left = divided_.parent;
    left.erase(std::unique(left.begin(), left.end()), left.end());
    result_.dropped_facets = given_facets_ - left.size();
    result_.facets = std::move(divided_.facets);
    result_.parent = std::move(divided_.parent);
    return std::move(result_);
}

}  // namespace

Arrangement arrange(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                    const std::function<void()>& check_cancelled) {
    return Arranger(
               vertices, facets, check_cancelled ? check_cancelled : [] {})
        .run();
}

Arrangement arrange_walls(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                          const std::vector<char>& is_wall, double tolerance,
                          const std::function<void()>& check_cancelled) {
    return Arranger(
               vertices, facets, check_cancelled ? check_cancelled : [] {})
        .run_walls(is_wall, tolerance);
}

}  // namespace kerf

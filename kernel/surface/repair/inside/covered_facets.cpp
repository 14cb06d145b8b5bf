#include "surface/repair/inside/covered_facets.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "base/core/ids.h"
#include "surface/arrange/winding_number.h"
#include "surface/diagnosis/intersections.h"
#include "surface/regions/divided_space.h"
#include "surface/repair/inside/rims.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// The fate of the copies of one facet.
enum class SingleFate : std::uint8_t { stays_as_first, stays_turned, goes };

// Returns per piece whether its edges are there as often in one direction as in the other.
std::vector<char> find_balanced(const std::vector<Triangle>& facets, const Rims& rims) {
    std::vector<char> is_balanced(rims.pieces.size(), 1);
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        int sum = 0;
        for (const auto& c : corners) sum += start_vertex(facets, c.corner) == low ? 1 : -1;
        if (sum != 0) is_balanced[rims.piece_of[corners[0].corner / 3]] = 0;
    });
    return is_balanced;
}

// Returns the fate of each single facet of a piece; none: its winding numbers do not tell.
std::optional<std::vector<SingleFate>> find_fates(const std::vector<Vec3>& vertices, const SingleFacets& single,
                                                  const std::vector<std::int32_t>& times) {
    if (!find_self_intersections(vertices, single.facets, 1).empty()) return {};
    const WindingNumber winding(vertices, single.facets, times);
    std::vector<SingleFate> fates(single.facets.size(), SingleFate::goes);
    bool is_any = false;
    for (std::int32_t u = 0; u < count_of(fates); ++u) {
        const double beside = winding.beside(u);
        const double in_front = beside - times[u] / 2.0, behind = beside + times[u] / 2.0;
        if (std::min(in_front, behind) < -0.5) return {};
        if ((in_front > 0.5) == (behind > 0.5)) continue;
        fates[u] = behind > 0.5 ? SingleFate::stays_as_first : SingleFate::stays_turned;
        is_any = true;
    }
    if (!is_any) return {};
    return fates;
}

}  // namespace

CoveredFacets find_covered_facets(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                  const std::function<void()>& check_cancelled) {
    CoveredFacets found{{}, {}, {}, std::vector<char>(facets.size(), 0), std::vector<char>(facets.size(), 0)};
    if (!has_edge_of_many(facets)) return found;
    const Rims rims = find_rims(facets);
    const std::vector<char> is_balanced = find_balanced(facets, rims);
    for (const std::vector<std::int32_t>& piece : rims.facets_of_pieces()) {
        const std::int32_t p = rims.piece_of[piece.front()];
        if (!is_balanced[p] || rims.pieces[p].edges_of_many == 0) continue;
        check_cancelled();
        std::vector<Triangle> own;
        for (const std::int32_t f : piece) own.push_back(facets[f]);
        const CompactFacets compact = make_compact(vertices, own);
        const SingleFacets single = single_facets(compact.facets);
        if (single.facets.size() == own.size()) continue;
        for (const std::int32_t f : piece) found.is_closed[f] = 1;
        std::vector<std::int32_t> times(single.facets.size(), 0);
        for (std::size_t i = 0; i < own.size(); ++i) times[single.single_of[i]] += single.is_turned[i] ? -1 : 1;
        const auto fates = find_fates(compact.vertices, single, times);
        if (!fates) continue;
        for (const std::int32_t f : piece) found.is_told[f] = 1;
        std::vector<char> is_there(single.facets.size(), 0);
        for (std::size_t i = 0; i < own.size(); ++i) {
            const std::int32_t u = single.single_of[i];
            const SingleFate fate = (*fates)[u];
            const bool is_right =
                fate != SingleFate::goes && (fate == SingleFate::stays_turned) == (single.is_turned[i] != 0);
            if (fate == SingleFate::goes)
                (times[u] == 0 ? found.folds : found.inside).push_back(piece[i]);
            else if (!is_right || std::exchange(is_there[u], char{1}))
                found.copies.push_back(piece[i]);
        }
    }
    for (std::vector<std::int32_t>* list : {&found.copies, &found.folds, &found.inside})
        std::sort(list->begin(), list->end());
    return found;
}

}  // namespace kerf

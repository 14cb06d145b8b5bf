// Copies, which are facets with the same three vertices, are judged by sheets: groups of copies that hang together over
// edges of two groups. With one facet for each group, the edges of the rim of a sheet are counted: without the sheet an
// edge has one facet less, so that an odd number above 1 means that the surface closes without it. A sheet whose copies
// are turned against each other is a fold if that holds for most of its rim; then all of its copies go. Walls between
// bodies that touch are copies as well, turned in equal numbers; they go where all other facets close without them.
#include "surface/repair/inside/facet_copies.h"

#include <algorithm>
#include <span>

#include "base/core/ids.h"
#include "base/geometry/union_find.h"
#include "surface/diagnosis/superfluous_facets.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

// Whether both put the same three vertices in the same sense of rotation.
bool have_same_turn(const Triangle& s, const Triangle& t) {
    const auto first = std::find(t.begin(), t.end(), s[0]) - t.begin();
    return t[(first + 1) % 3] == s[1];
}

struct CopySheet {
    bool is_folded = false;
    std::int64_t groups = 0;
    std::int64_t free = 0, even = 0, odd = 0;  // edges of its rim with one facet, an even number, an odd one above 1

    // Whether no facet of the sheet stays.
    bool is_fold(bool is_all, bool with_walls) const {
        if (!is_folded || (!with_walls && free == 0)) return false;
        if (groups == 1 && odd + even == 0) return !is_all;  // a flat pocket
        return odd > even;
    }
};

class CopyJudge {
 public:
    CopyJudge(const std::vector<Triangle>& facets, const std::vector<FacetCopies>& copies, bool with_walls)
        : facets_(facets), copies_(copies), with_walls_(with_walls), group_of_(facets.size(), -1) {
        std::vector<char> is_surplus(facets.size(), 0);
        for (std::int32_t g = 0; g < count_of(copies); ++g) {
            group_of_[copies[g].facets[0]] = g;
            for (std::size_t i = 1; i < copies[g].facets.size(); ++i) is_surplus[copies[g].facets[i]] = 1;
        }
        for (std::int32_t f = 0; f < count_of(facets); ++f) {
            if (is_surplus[f]) continue;
            single_.push_back(facets[f]);
            number_.push_back(f);
        }
    }

    SurplusCopies judge() {
        const EdgeCorners edges(single_);
        const Components sheet_of = find_sheets(edges);
        const std::vector<CopySheet> sheets = measure(edges, sheet_of);
        const bool is_all = single_.size() == copies_.size();
        const std::vector<char> cancels = find_cancelling();
        SurplusCopies surplus;
        for (std::size_t g = 0; g < copies_.size(); ++g) {
            const std::vector<std::int32_t>& all = copies_[g].facets;
            const bool is_fold = cancels[g] || sheets[sheet_of.of[g]].is_fold(is_all, with_walls_);
            std::vector<std::int32_t>& list = is_fold ? surplus.folds : surplus.copies;
            list.insert(list.end(), all.begin() + (is_fold ? 0 : 1), all.end());
        }
        std::sort(surplus.copies.begin(), surplus.copies.end());
        std::sort(surplus.folds.begin(), surplus.folds.end());
        return surplus;
    }

 private:
    using Corners = std::span<const EdgeCorners::Corner>;

    std::int32_t group(const EdgeCorners::Corner& c) const { return group_of_[number_[c.corner / 3]]; }
    bool is_within(const Corners& corners) const {
        return corners.size() == 2 && group(corners[0]) >= 0 && group(corners[1]) >= 0;
    }
    Components find_sheets(const EdgeCorners& edges) const {
        UnionFind sets(copies_.size());
        edges.for_each_edge([&](std::int32_t, Corners corners) {
            if (is_within(corners)) sets.join(group(corners[0]), group(corners[1]));
        });
        return sets.take();
    }
    // Marks groups with as many copies turned one way as the other, the walls of bodies that touch. A piece that hangs
    // together over edges may lose all of them if it has other facets, an even number of these at each edge.
    std::vector<char> find_cancelling() const {
        std::vector<char> cancels(copies_.size(), 0), is_cancelling(facets_.size(), 0);
        for (std::size_t g = 0; with_walls_ && g < copies_.size(); ++g) {
            const std::vector<std::int32_t>& all = copies_[g].facets;
            const auto same = std::count_if(
                all.begin(), all.end(), [&](std::int32_t f) { return have_same_turn(facets_[all[0]], facets_[f]); });
            cancels[g] = 2 * same == std::ssize(all);
            for (const std::int32_t f : all) is_cancelling[f] = cancels[g];
        }
        const EdgeCorners edges(facets_);
        UnionFind sets(facets_.size());
        std::vector<char> is_odd(facets_.size(), 0), has_others(facets_.size(), 0);
        edges.for_each_edge([&](std::int32_t, Corners corners) {
            for (const EdgeCorners::Corner& c : corners) sets.join(corners[0].corner / 3, c.corner / 3);
        });
        edges.for_each_edge([&](std::int32_t, Corners corners) {
            const auto others = std::count_if(corners.begin(), corners.end(), [&](const EdgeCorners::Corner& c) {
                return !is_cancelling[c.corner / 3];
            });
            const std::int32_t piece = sets.root(corners[0].corner / 3);
            is_odd[piece] |= others % 2;
            has_others[piece] |= others > 0;
        });
        for (std::size_t g = 0; g < copies_.size(); ++g) {
            const std::int32_t piece = sets.root(copies_[g].facets[0]);
            cancels[g] = cancels[g] && has_others[piece] && !is_odd[piece];
        }
        return cancels;
    }
    std::vector<CopySheet> measure(const EdgeCorners& edges, const Components& sheet_of) const {
        std::vector<CopySheet> sheets(sheet_of.count);
        for (std::size_t g = 0; g < copies_.size(); ++g) {
            CopySheet& sheet = sheets[sheet_of.of[g]];
            ++sheet.groups;
            for (const std::int32_t f : copies_[g].facets)
                sheet.is_folded |= !have_same_turn(facets_[copies_[g].facets[0]], facets_[f]);
        }
        edges.for_each_edge([&](std::int32_t, Corners corners) {
            if (is_within(corners)) return;
            for (const EdgeCorners::Corner& c : corners) {
                if (group(c) < 0) continue;
                CopySheet& sheet = sheets[sheet_of.of[group(c)]];
                ++(corners.size() == 1 ? sheet.free : corners.size() % 2 == 0 ? sheet.even : sheet.odd);
            }
        });
        return sheets;
    }

    const std::vector<Triangle>& facets_;
    const std::vector<FacetCopies>& copies_;
    bool with_walls_;
    std::vector<std::int32_t> group_of_;  // of the first facet of a group, else -1
    std::vector<Triangle> single_;        // one facet of each group
    std::vector<std::int32_t> number_;    // their numbers
};

}  // namespace

SurplusCopies find_surplus_copies(const std::vector<Triangle>& facets, bool with_walls) {
    const SuperfluousFacets found = find_superfluous_facets(facets);
    if (found.copies.empty()) return {};
    return CopyJudge(facets, found.copies, with_walls).judge();
}

}  // namespace kerf

// Two nodes for each facet, its front and back side, are labelled inside or outside by a minimum cut, as the cells of
// an arrangement are by winding numbers (Zhou et al. 2016, zhou2016; Jacobson et al. 2013, jacobson2013). The vote of a
// side is its winding number less 1/2, clamped to [-1/2, 1/2], times the area of the facet; it is the capacity of the
// link to inside or outside. Sides that face each other around an edge (surface/soup/radial_order.h) have a link whose
// capacity is a share of the squared length of the edge: a cut through it leaves the edge open.
//
// Where no edge is open, winding numbers are whole: sides are joined over edges of two facets into sets, and a sample
// of each patch votes for all of it. Where edges are open, all facets vote, and sides are joined only where their votes
// agree, since a wall inside may begin at a facet that is missing. The cut is needed only where joined sets that face
// each other vote differently; if it takes too many steps, votes alone decide.
#include "surface/arrange/hull.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "base/core/ids.h"
#include "base/core/threads.h"
#include "base/geometry/max_flow.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "surface/arrange/winding_number.h"
#include "surface/regions/divided_space.h"
#include "surface/soup/edge_corners.h"
#include "surface/soup/radial_order.h"

namespace kerf {

namespace {

// Some of the facets of a patch: the largest ones, and a share of all, ascending. Changes the order of `patch`.
std::vector<std::int32_t> samples_of(std::vector<std::int32_t>& patch, const std::vector<double>& areas) {
    constexpr std::size_t largest = 8, each = 16;
    std::vector<std::int32_t> chosen;
    for (std::size_t i = 0; i < patch.size(); i += each) chosen.push_back(patch[i]);
    const auto last = patch.begin() + std::min(largest, patch.size());
    std::partial_sort(patch.begin(), last, patch.end(), [&](std::int32_t f, std::int32_t g) {
        return areas[f] != areas[g] ? areas[f] > areas[g] : f < g;
    });
    chosen.insert(chosen.end(), patch.begin(), last);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

// Labels the space on each side of each facet, by front_side() and back_side() (surface/soup/radial_order.h). `facets`:
// in range, each once, with different corners, each standing for `times` facets, those that are turned subtracted;
// `winding` is that of them.
class SideLabeller {
 public:
    SideLabeller(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                 const std::vector<std::int32_t>& times, const WindingNumber& winding,
                 const std::function<void()>& check_cancelled)
        : vertices_(vertices),
          facets_(facets),
          times_(times),
          winding_(winding),
          check_cancelled_(check_cancelled),
          votes_(2 * facets.size()) {
        for (const Triangle& t : facets) areas_.push_back(triangle_area(vertices, t));
    }

    // Returns whether a side is inside (2 #F).
    std::vector<char> run() {
        find_facing_sides();
        check_cancelled_();
        if (is_open_)
            ask_all();
        else
            ask_patches();
        join();
        return cut();
    }

 private:
    // Sides that face each other around an edge.
    struct Facing {
        std::int32_t a, b;
        double length;  // of the edge
        bool has_two_facets;
    };

    void find_facing_sides() {
        std::vector<std::int32_t> order;
        EdgeCorners(facets_).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
            is_open_ |= corners.size() % 2 != 0;
            order.clear();
            for (const auto& c : corners) order.push_back(c.corner);
            if (corners.size() > 2) order = radial_order(vertices_, facets_, low, corners).corners;  // none: no links
            const double length = (vertices_[low] - vertices_[corners[0].high]).norm();
            for (std::size_t i = 0; i < order.size(); ++i)
                facing_.push_back({sides_at(facets_, low, order[i]).ahead,
                                   sides_at(facets_, low, order[(i + 1) % order.size()]).behind, length,
                                   order.size() == 2});
        });
    }

    // Votes for both sides of a facet: weight times winding number less 1/2, at most 1/2; negative: outside.
    void ask(std::int32_t facet, double weight) {
        const double beside = winding_.beside(facet);
        for (const auto& [side, sign] : {std::pair(front_side(facet), -1), std::pair(back_side(facet), 1)})
            votes_[side] = weight * std::clamp(beside + sign * times_[facet] / 2.0 - 0.5, -0.5, 0.5);
    }
    void ask_all() {
        constexpr std::size_t facets_between_checks = 1 << 14, grain = 1 << 8;
        for (std::size_t first = 0; first < facets_.size(); first += facets_between_checks) {
            check_cancelled_();
            for_ranges_on_threads(std::min(facets_between_checks, facets_.size() - first), grain,
                                  [&](const IndexRange& range) {
                                      for (std::size_t f = first + range.first; f < first + range.last; ++f)
                                          ask(f, areas_[f]);
                                  });
        }
    }
    void ask_patches() {
        constexpr std::int32_t questions_between_checks = 4096;
        std::int32_t questions = 0;
        UnionFind joined(facets_.size());
        for (const Facing& facing : facing_)
            if (facing.has_two_facets) joined.join(facing.a / 2, facing.b / 2);
        const Components patches = joined.take();
        std::vector<std::vector<std::int32_t>> facets_of(patches.count);
        for (std::int32_t f = 0; f < count_of(facets_); ++f) facets_of[patches.of[f]].push_back(f);
        for (std::vector<std::int32_t>& patch : facets_of) {
            double area = 0, asked = 0;
            for (const std::int32_t f : patch) area += areas_[f];
            const std::vector<std::int32_t> samples = samples_of(patch, areas_);
            for (const std::int32_t f : samples) asked += areas_[f];
            if (asked > 0)
                for (const std::int32_t f : samples) {
                    if (++questions % questions_between_checks == 0) check_cancelled_();
                    ask(f, areas_[f] / asked * area);
                }
        }
    }

    // Winding numbers change little from facet to facet, also where they pass 1/2 on the way to a hole; they jump where
    // a wall between the two is missing.
    bool agree(std::int32_t a, std::int32_t b) const {
        constexpr double jump = 0.4;
        const double of_a = votes_[a] / areas_[a / 2], of_b = votes_[b] / areas_[b / 2];
        return (of_a > 0) == (of_b > 0) || !(std::abs(of_a - of_b) > jump);
    }

    // Joins sides into sets that are labelled as a whole. Where edges are open, the border between inside and outside
    // may cross an edge of two facets, as where a wall inside begins at a facet that is missing.
    void join() {
        UnionFind joined(votes_.size());
        for (std::size_t i = 0; i + 1 < facing_.size(); ++i) {
            const Facing &one = facing_[i], &other = facing_[i + 1];
            if (!one.has_two_facets) continue;
            if (is_open_ && !(agree(one.a, one.b) && agree(other.a, other.b))) {
                ++i;
                continue;
            }
            joined.join(one.a, one.b);
            joined.join(other.a, other.b);
            ++i;
        }
        sets_ = joined.take();
    }

    std::vector<char> cut() {
        // The price of an open edge is that of facets on the wrong side with this share of its squared length as area.
        constexpr double cost_of_edge = 0.05;
        constexpr std::int64_t steps_of_link = 1000;
        std::vector<double> votes(sets_.count, 0);
        for (std::size_t side = 0; side < votes_.size(); ++side) votes[sets_.of[side]] += votes_[side];
        std::vector<char> is_inside;
        for (const double vote : votes) is_inside.push_back(vote > 0);
        std::erase_if(facing_, [&](const Facing& f) { return sets_.of[f.a] == sets_.of[f.b]; });
        if (std::any_of(facing_.begin(), facing_.end(),
                        [&](const Facing& f) { return is_inside[sets_.of[f.a]] != is_inside[sets_.of[f.b]]; })) {
            check_cancelled_();
            MaxFlow flow(sets_.count);
            for (std::int32_t s = 0; s < sets_.count; ++s)
                flow.add_terminal(s, std::max(votes[s], 0.0), std::max(-votes[s], 0.0));
            for (const Facing& f : facing_)
                flow.add_edge(sets_.of[f.a], sets_.of[f.b], cost_of_edge * f.length * f.length);
            if (flow.solve(steps_of_link * std::ssize(facing_)))
                for (std::int32_t s = 0; s < sets_.count; ++s) is_inside[s] = !flow.on_sink_side(s);
        }
        std::vector<char> of_sides;
        for (const std::int32_t set : sets_.of) of_sides.push_back(is_inside[set]);
        return of_sides;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const std::vector<std::int32_t>& times_;
    const WindingNumber& winding_;
    const std::function<void()>& check_cancelled_;
    std::vector<double> areas_, votes_;  // #F; 2 #F
    std::vector<Facing> facing_;         // the links of an edge follow each other
    bool is_open_ = false;
    Components sets_;  // of sides
};

}  // namespace

std::vector<HullFate> find_hull(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                const std::function<void()>& check_cancelled) {
    const SingleFacets single = single_facets(facets);
    std::vector<std::int32_t> times(single.facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (const std::int32_t u = single.single_of[f]; u >= 0) times[u] += single.is_turned[f] ? -1 : 1;
    check_cancelled();
    const WindingNumber winding(vertices, single.facets, times);
    check_cancelled();
    const std::vector<char> is_inside = SideLabeller(vertices, single.facets, times, winding, check_cancelled).run();

    std::vector<HullFate> fate(facets.size(), HullFate::outside);
    std::vector<std::int32_t> stays(single.facets.size(), -1);  // of each single facet the one that stays
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        const std::int32_t u = single.single_of[f];
        if (u < 0) continue;
        const bool in_front = is_inside[front_side(u)] != 0, behind = is_inside[back_side(u)] != 0;
        if (in_front == behind) {
            fate[f] = behind ? HullFate::inside : HullFate::outside;
            continue;
        }
        const bool is_right = behind != (single.is_turned[f] != 0);
        fate[f] = HullFate::copy;
        if (stays[u] >= 0 && (!is_right || fate[stays[u]] == HullFate::stays)) continue;
        if (stays[u] >= 0) fate[stays[u]] = HullFate::copy;
        stays[u] = f;
        fate[f] = is_right ? HullFate::stays : HullFate::turns;
    }
    return fate;
}

}  // namespace kerf

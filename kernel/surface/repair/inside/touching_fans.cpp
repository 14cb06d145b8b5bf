// A fan is a set of corners of facets at one vertex that edges connect, by pairs where an edge has more than two facets
// (surface/repair/inside/edge_pairs.h). Each fan but the widest of a vertex gets a copy of the vertex, which moves
// along the fan's middle, the mean direction of its edges; its narrowness is the least cosine of an edge with the
// middle, and the fan where it is least is the widest. A move is 1e-4 of the shortest edge, or the resolution of single
// precision if that is more, so that files keep it. Pairs of facets at an edge whose ends are still common then get a
// middle of their own, moved into the wedge of material between the two facets; the pair with the widest wedge keeps
// the edge.
//
// All moves are tried at once; those whose facets cross something that they did not cross before are taken back, until
// none do. Fans with facets that lie on others at the vertex are not moved at all, because a move would leave a crack
// between bodies that touch.
#include "surface/repair/inside/touching_fans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/core/drop_items.h"
#include "base/core/ids.h"
#include "base/geometry/angles.h"
#include "base/geometry/predicates.h"
#include "surface/diagnosis/intersections.h"
#include "surface/repair/inside/edge_pairs.h"
#include "surface/repair/inside/facet_pieces.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double move_share = 1e-4, largest_move_share = 0.25;
constexpr double single_precision = 0x1p-22;  // of a coordinate; the resolution of files of single precision
constexpr int most_separation_rounds = 6;
constexpr std::size_t most_fan_crossings = 100'000;

// Returns the distance by which something may move at a point; 0 if none is both large enough to tell and small enough.
double move_at(const Vec3& point, double shortest_edge, double bound) {
    const double move = std::max(move_share * shortest_edge, single_precision * point.cwiseAbs().maxCoeff());
    return move <= std::min(bound, largest_move_share * shortest_edge) ? move : 0;
}

// The corners of facets that one fan has at a vertex.
struct TouchingFan {
    std::int32_t vertex = 0;
    std::vector<std::int32_t> corners = {};
    bool stays = false;          // open, or tangled in an edge without pairs
    Vec3 middle = Vec3::Zero();  // unit vector into it
    double narrowness = 0;       // least cosine between the middle and an edge
    double shortest_edge = 0;
    bool is_moved = true;    // else it shares the old vertex
    std::int32_t copy = -1;  // its own vertex
};

// The middle of an edge, for one pair of facets alone.
struct EdgeMiddle {
    std::array<std::int32_t, 2> corners;
    Vec3 point;
    double move = 0;
};

class FanSeparator {
 public:
    FanSeparator(Soup& soup, double bound, bool at_openings)
        : soup_(soup), bound_(bound), at_openings_(at_openings), pairs_(pair_facets(soup.vertices, soup.facets)) {}

    FanSeparation run() {
        find_fans_to_copy();
        if (!fans_.empty()) copy_fans();
        say_why();
        if (!at_openings_) {
            say_crowded();
            std::vector<EdgeMiddle> middles = find_middles();
            if (!middles.empty()) divide(std::move(middles));
        }
        if (divided_.count + opened_.count > 0)
            drop_unused_vertices(soup_);
        else
            forget_copies();
        for (RepairAction* action : {&divided_, &opened_, &too_near_, &lies_on_, &would_cross_, &crowded_})
            result_.actions.push_back(std::move(*action));
        return std::move(result_);
    }

 private:
    std::int32_t vertex(std::int32_t corner) const { return soup_.facets[corner / 3][corner % 3]; }
    const Vec3& point(std::int32_t corner) const { return soup_.vertices[vertex(corner)]; }
    static std::int32_t previous(std::int32_t corner) { return next_corner(next_corner(corner)); }
    RepairPlace place(std::int32_t corner, double measure) const {
        return {point(corner), soup_.file_facets({corner / 3}), measure};
    }
    void find_fans_to_copy();
    void measure(TouchingFan& fan) const;
    void choose(std::vector<TouchingFan>& fans);
    void copy_fans();
    void set_copies();
    void leave_what_lies_on_others(const std::vector<char>& chosen);
    bool undo_what_crosses(const std::vector<Triangle>& before, std::vector<char>& chosen);
    std::vector<EdgeMiddle> find_middles() const;
    void add_middles(const std::vector<std::array<std::int32_t, 2>>& pairs, std::vector<EdgeMiddle>& middles) const;
    double wedge(std::int32_t c, std::int32_t d) const;
    void divide(std::vector<EdgeMiddle> middles);
    void say_crowded();
    void say_why();
    void forget_copies() {
        soup_.vertices.resize(vertex_count_);
        soup_.vertex_number.resize(had_numbers_ ? vertex_count_ : 0);
    }
    std::int32_t add_vertex(const Vec3& point, std::int32_t number) {
        soup_.vertices.push_back(point);
        soup_.vertex_number.push_back(number);
        return count_of(soup_.vertices) - 1;
    }

    Soup& soup_;
    double bound_;
    bool at_openings_;
    std::size_t vertex_count_ = soup_.vertices.size();
    bool had_numbers_ = !soup_.vertex_number.empty();
    EdgePairs pairs_;
    std::vector<TouchingFan> fans_;  // that get a vertex of their own
    FanSeparation result_;
    RepairAction divided_{"pinched vertex divided", "pinched vertices divided", "moved"},
        opened_{"touching edge divided", "touching edges divided", "moved"},
        too_near_{"place where the surface touches itself", "places where the surface touches itself"},
        lies_on_{"place where the surface touches itself", "places where the surface touches itself"},
        would_cross_{"place where the surface touches itself", "places where the surface touches itself"},
        crowded_{"edge of more than two facets", "edges of more than two facets", "facets"};
};

void FanSeparator::find_fans_to_copy() {
    const std::vector<std::int32_t> root = find_fans(soup_.facets, pairs_);
    std::vector<std::int32_t> first(soup_.vertices.size(), -1);
    std::vector<char> has_many(soup_.vertices.size(), 0), is_open(soup_.vertices.size(), 0);
    for (std::int32_t corner = 0; corner < count_of(root); ++corner) {
        const std::int32_t v = vertex(corner);
        if (first[v] < 0) first[v] = root[corner];
        has_many[v] |= first[v] != root[corner];
        if (pairs_.is_open[corner]) is_open[v] = is_open[vertex(next_corner(corner))] = 1;
    }
    for (std::size_t v = 0; at_openings_ && v < has_many.size(); ++v) has_many[v] &= is_open[v];
    std::vector<std::array<std::int32_t, 3>> corners;
    for (std::int32_t c = 0; c < count_of(root); ++c)
        if (const std::int32_t v = vertex(c); has_many[v]) corners.push_back({v, root[c], c});
    std::sort(corners.begin(), corners.end());
    std::vector<TouchingFan> at_vertex;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto [v, fan, corner] = corners[i];
        if (i == 0 || fan != corners[i - 1][1]) at_vertex.push_back({v});
        at_vertex.back().corners.push_back(corner);
        if (i + 1 == corners.size() || corners[i + 1][0] != v) {
            choose(at_vertex);
            at_vertex.clear();
        }
    }
}

void FanSeparator::measure(TouchingFan& fan) const {
    std::vector<Vec3> edges;
    fan.shortest_edge = std::numeric_limits<double>::infinity();
    for (const std::int32_t c : fan.corners) {
        for (const std::int32_t edge : {c, previous(c)}) fan.stays |= pairs_.partner[edge] < 0;
        for (const std::int32_t other : {next_corner(c), previous(c)}) {
            edges.push_back(point(other) - point(c));
            fan.shortest_edge = std::min(fan.shortest_edge, edges.back().norm());
            fan.middle += edges.back().normalized();
        }
    }
    fan.middle.normalize();
    fan.narrowness = 1;
    for (const Vec3& edge : edges) fan.narrowness = std::min(fan.narrowness, edge.normalized().dot(fan.middle));
}

// All but the widest, if no other fan has to stay.
void FanSeparator::choose(std::vector<TouchingFan>& fans) {
    for (TouchingFan& fan : fans) measure(fan);
    if (std::none_of(fans.begin(), fans.end(), [](const TouchingFan& fan) { return fan.stays; }))
        std::min_element(fans.begin(), fans.end(), [](const TouchingFan& a, const TouchingFan& b) {
            return a.narrowness < b.narrowness;
        })->stays = true;
    for (TouchingFan& fan : fans) {
        if (fan.stays) continue;
        if (move_at(point(fan.corners[0]), fan.shortest_edge, bound_) > 0)
            fans_.push_back(std::move(fan));
        else
            too_near_.add(place(fan.corners[0], 0));
    }
}

void FanSeparator::set_copies() {
    for (const TouchingFan& fan : fans_) {
        const Vec3& old = soup_.vertices[fan.vertex];
        soup_.vertices[fan.copy] = old + move_at(old, fan.shortest_edge, bound_) * fan.middle;
        for (const std::int32_t c : fan.corners) soup_.facets[c / 3][c % 3] = fan.is_moved ? fan.copy : fan.vertex;
    }
}

void FanSeparator::copy_fans() {
    std::vector<char> chosen(soup_.facets.size(), 0);
    for (const TouchingFan& fan : fans_)
        for (const std::int32_t c : fan.corners) chosen[c / 3] = 1;
    leave_what_lies_on_others(chosen);
    const std::vector<Triangle> before = soup_.facets;
    number_vertices(soup_);
    for (TouchingFan& fan : fans_)
        fan.copy = add_vertex(Vec3(soup_.vertices[fan.vertex]), soup_.vertex_number[fan.vertex]);
    set_copies();
    while (undo_what_crosses(before, chosen)) continue;
    for (const TouchingFan& fan : fans_) {
        if (!fan.is_moved) continue;
        const double move = (soup_.vertices[fan.copy] - soup_.vertices[fan.vertex]).norm();
        result_.largest_move = std::max(result_.largest_move, move);
        divided_.add({soup_.vertices[fan.vertex], soup_.file_facets({fan.corners[0] / 3}), move});
    }
}

// Fans of which a facet lies on another at the vertex stay: what touches with other facets would come apart by a crack.
void FanSeparator::leave_what_lies_on_others(const std::vector<char>& chosen) {
    const auto has = [&](std::int32_t f, std::int32_t v) {
        return std::count(soup_.facets[f].begin(), soup_.facets[f].end(), v) > 0;
    };
    const auto share_vertex = [&](std::int32_t f, std::int32_t g) {
        return std::any_of(soup_.facets[f].begin(), soup_.facets[f].end(), [&](std::int32_t v) { return has(g, v); });
    };
    const IntersectingPairs pairs =
        find_intersections_of(chosen, soup_.vertices, soup_.facets, most_fan_crossings, share_vertex);
    const bool may_be_more = pairs.size() == most_fan_crossings;
    std::vector<char> is_on_another(soup_.vertices.size(), may_be_more);
    for (const auto& [f, g] : pairs)
        for (const std::int32_t v : soup_.facets[f])
            if (has(g, v)) is_on_another[v] = 1;
    std::vector<char> stays;
    for (const TouchingFan& fan : fans_) {
        stays.push_back(is_on_another[fan.vertex]);
        if (stays.back()) lies_on_.add(place(fan.corners[0], 0));
    }
    drop_items(fans_, stays);
}

// Fans with a facet that crosses one which it did not cross before share the old vertex again. Whether there are any.
// `before`: the facets over the old vertices; `chosen`: those that have changed, before and behind.
bool FanSeparator::undo_what_crosses(const std::vector<Triangle>& before, std::vector<char>& chosen) {
    const auto corners_before = [&](std::int32_t f) {
        const auto& [a, b, c] = before[f];
        return std::array{soup_.vertices[a], soup_.vertices[b], soup_.vertices[c]};
    };
    const auto is_new = [&](std::int32_t f, std::int32_t g) {
        return !triangles_intersect(corners_before(f), before[f], corners_before(g), before[g]);
    };
    std::vector<char> is_bad(soup_.facets.size(), 0);
    bool is_any = false;
    const IntersectingPairs pairs =
        find_intersections_of(chosen, soup_.vertices, soup_.facets, most_fan_crossings, is_new);
    for (const auto& [f, g] : pairs) is_bad[f] = is_bad[g] = 1;
    if (const bool are_all = pairs.size() < most_fan_crossings; are_all) std::fill(chosen.begin(), chosen.end(), 0);
    for (TouchingFan& fan : fans_) {
        if (!fan.is_moved) continue;
        const bool crosses =
            std::any_of(fan.corners.begin(), fan.corners.end(), [&](std::int32_t c) { return is_bad[c / 3]; });
        if (!crosses) continue;
        is_any = true;
        fan.is_moved = false;
        for (const std::int32_t c : fan.corners) chosen[c / 3] = 1;
        would_cross_.add({soup_.vertices[fan.vertex], soup_.file_facets({fan.corners[0] / 3})});
    }
    set_copies();
    return is_any;
}

// The angle of the material from the facet of a corner to that of its partner, going around the edge.
double FanSeparator::wedge(std::int32_t c, std::int32_t d) const {
    const std::int32_t low = std::min(vertex(c), vertex(next_corner(c)));
    const std::int32_t high = std::max(vertex(c), vertex(next_corner(c)));
    const Vec3 &a = soup_.vertices[low], &b = soup_.vertices[high];
    const double angle = dihedral_degrees(a, b, point(previous(c)), point(previous(d)));
    return orientation(a, b, point(previous(c)), point(previous(d))) >= 0 ? angle : 360 - angle;
}

// Adds a middle for each pair of facets with the same two ends but the widest.
void FanSeparator::add_middles(const std::vector<std::array<std::int32_t, 2>>& pairs,
                               std::vector<EdgeMiddle>& middles) const {
    std::size_t widest = 0;
    for (std::size_t i = 1; i < pairs.size(); ++i)
        if (wedge(pairs[i][0], pairs[i][1]) > wedge(pairs[widest][0], pairs[widest][1])) widest = i;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i == widest) continue;
        const std::int32_t c = pairs[i][0];
        const Vec3& a = soup_.vertices[std::min(vertex(c), vertex(next_corner(c)))];
        const Vec3& b = soup_.vertices[std::max(vertex(c), vertex(next_corner(c)))];
        const double half = wedge(c, pairs[i][1]) * std::numbers::pi / 360;
        const Vec3 beside = towards_apex(a, b, point(previous(c)));
        const Vec3 into = std::cos(half) * beside + std::sin(half) * (b - a).normalized().cross(beside);
        const double move = move_at((a + b) / 2, (b - a).norm(), bound_);
        middles.push_back({pairs[i], (a + b) / 2 + move * into, move});
    }
}

std::vector<EdgeMiddle> FanSeparator::find_middles() const {
    std::vector<EdgeMiddle> middles;
    for (const CrowdedEdge& edge : pairs_.crowded) {
        if (!edge.is_paired) continue;
        std::vector<std::pair<UndirectedEdge, std::array<std::int32_t, 2>>> pairs;
        for (std::size_t i = 0; i < edge.corners.size(); i += 2) {
            const std::int32_t c = edge.corners[i];
            pairs.push_back({undirected(vertex(c), vertex(next_corner(c))), {c, edge.corners[i + 1]}});
        }
        std::sort(pairs.begin(), pairs.end());
        for (std::size_t i = 0, j = 0; i < pairs.size(); i = j) {
            std::vector<std::array<std::int32_t, 2>> same;
            for (; j < pairs.size() && pairs[j].first == pairs[i].first; ++j) same.push_back(pairs[j].second);
            if (same.size() > 1) add_middles(same, middles);
        }
    }
    return middles;
}

void FanSeparator::divide(std::vector<EdgeMiddle> middles) {
    std::vector<char> chosen(soup_.facets.size(), 0);
    std::erase_if(middles, [&](const EdgeMiddle& middle) {
        if (middle.move == 0) too_near_.add(place(middle.corners[0], 0));
        return middle.move == 0;
    });
    number_vertices(soup_);
    const std::int32_t number = *std::max_element(soup_.vertex_number.begin(), soup_.vertex_number.end()) + 1;
    const auto old_count = count_of(soup_.vertices);
    for (int attempt = 0; attempt < most_separation_rounds && !middles.empty(); ++attempt) {
        Soup trial{soup_.vertices, soup_.facets, soup_.patch, {}};
        std::vector<SidePoint> points;
        for (const EdgeMiddle& middle : middles) {
            for (const std::int32_t c : middle.corners) points.push_back({c, 0, count_of(trial.vertices)});
            trial.vertices.push_back(middle.point);
        }
        divide_at(trial, points);
        chosen.assign(trial.facets.size(), 0);
        for (std::size_t f = 0; f < trial.facets.size(); ++f)
            chosen[f] = *std::max_element(trial.facets[f].begin(), trial.facets[f].end()) >= old_count;
        std::vector<char> crosses(middles.size(), 0);
        for (const auto& [f, g] : find_intersections_of(chosen, trial.vertices, trial.facets, most_fan_crossings))
            for (const std::int32_t facet : {f, g})
                for (const std::int32_t v : trial.facets[facet])
                    if (v >= old_count) crosses[v - old_count] = 1;
        if (std::find(crosses.begin(), crosses.end(), 1) == crosses.end()) {
            for (const EdgeMiddle& middle : middles) opened_.add(place(middle.corners[0], middle.move));
            for (std::int32_t i = 0; i < count_of(middles); ++i) add_vertex(middles[i].point, number + i);
            divide_at(soup_, points);
            return;
        }
        for (std::size_t i = 0; i < middles.size(); ++i)
            if (crosses[i]) would_cross_.add(place(middles[i].corners[0], 0));
        drop_items(middles, crosses);
    }
}

void FanSeparator::say_crowded() {
    for (const CrowdedEdge& edge : pairs_.crowded) {
        if (edge.is_paired) continue;
        crowded_.refused_because = edge.reason;
        crowded_.add({(soup_.vertices[edge.low] + soup_.vertices[edge.high]) / 2,
                      soup_.file_facets({edge.corners[0] / 3}), static_cast<double>(edge.corners.size())});
    }
}

void FanSeparator::say_why() {
    too_near_.refused_because = "to move it apart takes more than the bound, or an edge there is too short";
    lies_on_.refused_because = "facets lie on others there, or cross them, which --repair intersections resolves";
    would_cross_.refused_because = "facets would cross if it moved apart";
}

}  // namespace

FanSeparation separate_fans(Soup& soup, double bound, bool at_openings) {
    return FanSeparator(soup, bound, at_openings).run();
}

}  // namespace kerf

// Each vertex of the wrap has a start, its place in the wrap, a target, the closest point of the input, and a count
// `held_` of how often its move was halved; at 3 it does not move. Edges whose middle leaves the input are divided at
// targets where the planes of their ends meet, facets with three such edges also at a corner, as sharp features are
// restored by Attene et al. (2003, attene2003); then edges of flat facets are flipped. Where the wrap is thin, targets
// are less far, so that the two sides do not meet.
//
// The start has no intersections, and that is the invariant: all vertices go to their targets at once, the vertices of
// facets that cross or are spoilt are held back, and this is repeated until there are none. Afterwards some that were
// held are released again, all or an independent set in turn. If facets still cross at the end, the wrap is returned as
// it came.
#include "surface/wrap/inside/wrap_pullback.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "base/core/cancellation.h"
#include "base/core/ids.h"
#include "base/core/mixed_bits.h"
#include "base/geometry/triangle.h"
#include "surface/diagnosis/intersections.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

/// A wrap on its way to the input.
class WrapPullback {
 public:
    WrapPullback(TriangleSet wrap, const TriangleTree& input, double offset,
                 const std::function<void()>& check_cancelled)
        : input_(input),
          offset_(offset),
          check_cancelled_(check_cancelled),
          wrap_(wrap.vertices, wrap.facets),
          wrap_normal_(wrap.facets.size()),
          start_(std::move(wrap.vertices)),
          facets_(std::move(wrap.facets)) {}

    TriangleSet result() {
        find_targets();
        for (int round = 0; round < division_rounds; ++round) divide_edges();
        flip_edges();
        hold_back();
        for (std::uint64_t round = 0; round < release_rounds; ++round) release_some(round);
        return {positions(), std::move(facets_)};
    }

 private:
    static constexpr int division_rounds = 3;
    static constexpr double leaves_input =
        0.03;                               // of the length of an edge: so far from the input its middle is off it
    static constexpr double beside = 0.01;  // of the offset: facets of the place itself
    static constexpr double least_thickness = 1.5;      // of the offset, left of the wrap
    static constexpr double far_from_input = 0.3;       // of the length: bridges something
    static constexpr double near_input = 0.1;           // of the length: planes meet on the input
    static constexpr double sharp_cosine = 0.82;        // of normals, 35 degrees
    static constexpr double along_normal = 0.8;         // cosine: a point beside an opening is not below it
    static constexpr double least_corner = 0.2;         // volume that three normals span
    static constexpr double flattest_facet = 0.02;      // height over length: below that an edge is flipped
    static constexpr double thinnest_facet = 1e-3;      // height over length that may come of a move
    static constexpr double turned_cosine = 0.1;        // of a facet and its former self
    static constexpr double flipped_cosine = 0.5;       // of facets beside an edge that is flipped
    static constexpr std::size_t most_pairs = 200'000;  // of facets that cross, looked for at once
    static constexpr std::uint64_t release_rounds = 6;  // in which vertices that are held back are tried again
    static constexpr int held_back = 3;                 // times that a move is halved; then it is none

    static double height_over_length(const Vec3& a, const Vec3& b, const Vec3& c) {
        const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
        return longest > 0 ? doubled_area_vector(a, b, c).norm() / longest : 0;
    }

    // Finds the target of every vertex.
    void find_targets() {
        for (std::size_t f = 0; f < facets_.size(); ++f) wrap_normal_[f] = doubled_area_vector(start_, facets_[f]);
        for (std::size_t v = 0; v < start_.size(); ++v) {
            check_cancelled_.at(v);
            const Vec3 to = input_.closest(start_[v]).point;
            normal_.push_back((start_[v] - to).normalized());
            add_target(start_[v], to);
        }
    }

    // Adds the target of a vertex, less far where the wrap is thin, so that it does not meet the vertices of the other
    // side.
    void add_target(const Vec3& start, const Vec3& to) {
        const Vec3 way = to - start;
        const double length = way.norm(), least = least_thickness * offset_, far = 3 * length + least;
        const Vec3 direction = length > 0 ? Vec3(way / length) : Vec3::Zero();
        const double thickness = wrap_.first_hit(start, direction, beside * offset_, far,
                                                 [&](std::int32_t f) { return wrap_normal_[f].dot(direction) > 0; });
        const double most = std::max(0.0, (std::min(thickness, far) - least) / 2);
        is_free_.push_back(most >= length);
        target_.push_back(most >= length ? to : Vec3(start + most * direction));
    }

    // The point where the planes of some vertices meet, that is closest to their centre.
    template <std::size_t count>
    static Vec3 common_point(const std::array<Vec3, count>& normals, const std::array<Vec3, count>& points,
                             const Vec3& centre) {
        Eigen::Matrix<double, count, 3> planes;
        Eigen::Matrix<double, count, 1> heights;
        for (std::size_t i = 0; i < count; ++i) {
            planes.row(i) = normals[i].transpose();
            heights[i] = normals[i].dot(points[i] - centre);
        }
        return centre + planes.transpose() * (planes * planes.transpose()).inverse() * heights;
    }

    // Finds the target of the vertex that divides an edge; false if none is wanted.
    bool find_division(std::int32_t a, std::int32_t b, Vec3& to) const {
        if (!is_free_[a] || !is_free_[b]) return false;
        const Vec3 middle = (target_[a] + target_[b]) / 2;
        const double length = (target_[a] - target_[b]).norm();
        const TriangleTree::Closest below = input_.closest(middle);
        if (below.squared_distance <= std::pow(leaves_input * length, 2)) return false;
        if (normal_[a].dot(normal_[b]) < sharp_cosine) {
            const Vec3 common = common_point<2>({normal_[a], normal_[b]}, {target_[a], target_[b]}, middle);
            to = input_.closest(common).point;
            if ((common - to).norm() < near_input * length && (to - middle).norm() < length) return true;
        }
        to = below.point;
        const Vec3 up = (normal_[a] + normal_[b]).normalized(), way = to - middle;
        return below.squared_distance < std::pow(far_from_input * length, 2) &&
               std::abs(way.dot(up)) > along_normal * way.norm();
    }

    // Finds the point where the planes of the corners of a facet meet, for one whose three edges are divided; false if
    // there is none on the input.
    bool find_corner(const Triangle& t, Vec3& to) const {
        const auto& [a, b, c] = t;
        if (std::abs(normal_[a].cross(normal_[b]).dot(normal_[c])) < least_corner) return false;
        const Vec3 centre = (target_[a] + target_[b] + target_[c]) / 3;
        const double length = std::sqrt(doubled_area_vector(target_, t).norm());
        const Vec3 common =
            common_point<3>({normal_[a], normal_[b], normal_[c]}, {target_[a], target_[b], target_[c]}, centre);
        to = input_.closest(common).point;
        return (common - to).norm() < near_input * length && (to - centre).norm() < length;
    }

    std::int32_t add_vertex(const Vec3& start, const Vec3& target, const Vec3& normal) {
        start_.push_back(start);
        normal_.push_back(normal.normalized());
        add_target(start, target);
        return count_of(start_) - 1;
    }

    void divide_edges() {
        std::vector<std::int32_t> middle(3 * facets_.size(), -1);  // of each corner's edge
        const EdgeCorners edges(facets_);
        std::size_t step = 0;
        edges.for_each_edge([&](std::int32_t a, auto corners) {
            check_cancelled_.at(step++);
            const std::int32_t b = corners.front().high;
            Vec3 to;
            if (!find_division(a, b, to)) return;
            const std::int32_t added = add_vertex((start_[a] + start_[b]) / 2, to, normal_[a] + normal_[b]);
            for (const EdgeCorners::Corner& c : corners) middle[c.corner] = added;
        });
        std::vector<Triangle> pieces;
        for (std::size_t f = 0; f < facets_.size(); ++f)
            add_pieces(facets_[f], {middle[3 * f], middle[3 * f + 1], middle[3 * f + 2]}, pieces);
        facets_ = std::move(pieces);
    }

    // `m`: the vertices in the middle of its edges, -1 for none.
    void add_pieces(Triangle t, Triangle m, std::vector<Triangle>& pieces) {
        const auto divided_edges = std::count_if(m.begin(), m.end(), [](std::int32_t v) { return v >= 0; });
        const auto turn = [&] {
            std::rotate(t.begin(), t.begin() + 1, t.end());
            std::rotate(m.begin(), m.begin() + 1, m.end());
        };
        if (divided_edges == 0) {
            pieces.push_back(t);
        } else if (divided_edges == 1) {
            while (m[0] < 0) turn();
            pieces.insert(pieces.end(), {{t[0], m[0], t[2]}, {m[0], t[1], t[2]}});
        } else if (divided_edges == 2) {
            while (m[2] >= 0) turn();
            pieces.push_back({m[0], t[1], m[1]});
            if ((target_[m[0]] - target_[t[2]]).norm() < (target_[m[1]] - target_[t[0]]).norm())
                pieces.insert(pieces.end(), {{m[0], m[1], t[2]}, {m[0], t[2], t[0]}});
            else
                pieces.insert(pieces.end(), {{m[0], m[1], t[0]}, {m[1], t[2], t[0]}});
        } else if (Vec3 to; find_corner(t, to)) {
            const std::int32_t centre = add_vertex((start_[t[0]] + start_[t[1]] + start_[t[2]]) / 3, to,
                                                   normal_[t[0]] + normal_[t[1]] + normal_[t[2]]);
            for (int i = 0; i < 3; ++i)
                pieces.insert(pieces.end(), {{t[i], m[i], centre}, {m[i], t[(i + 1) % 3], centre}});
        } else {
            for (int i = 0; i < 3; ++i) pieces.push_back({t[i], m[i], m[(i + 2) % 3]});
            pieces.push_back(m);
        }
    }

    // Facets that would become flat between three vertices on one edge of the input. Where two flips, tried at once,
    // make the wrap cross itself, they are not done.
    void flip_edges() {
        constexpr int most_tries = 4;
        const std::vector<Triangle> before = facets_;
        std::vector<char> may_flip(facets_.size(), 1);
        for (int tries = 0; tries < most_tries; ++tries) {
            facets_ = before;
            const std::vector<char> is_flipped = flip_where(may_flip);
            const auto pairs = find_intersections_of(is_flipped, start_, facets_, most_pairs);
            if (pairs.empty()) return;
            for (const auto& [f, g] : pairs) may_flip[f] = may_flip[g] = 0;
        }
        facets_ = before;
    }

    // Returns which facets are others now.
    std::vector<char> flip_where(const std::vector<char>& may_flip) {
        std::vector<char> is_flipped(facets_.size(), 0);
        const std::vector<std::int32_t> partner = edge_partners(facets_);
        std::vector<UndirectedEdge> edges;
        for (std::int32_t corner = 0; corner < count_of(partner); ++corner) {
            edges.push_back(undirected(start_vertex(facets_, corner), start_vertex(facets_, next_corner(corner))));
        }
        std::sort(edges.begin(), edges.end());
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            const Triangle t = facets_[f];
            if (is_flipped[f] || height_over_length(target_[t[0]], target_[t[1]], target_[t[2]]) > flattest_facet)
                continue;
            int longest = 0;
            for (int i = 1; i < 3; ++i)
                if (edge_length(t, i) > edge_length(t, longest)) longest = i;
            const std::int32_t other = partner[3 * f + longest];
            if (other < 0) continue;
            const std::int32_t g = other / 3;
            if (is_flipped[g] || !may_flip[f] || !may_flip[g]) continue;
            const std::int32_t a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3];
            const std::int32_t d = facets_[g][(other % 3 + 2) % 3];
            if (std::binary_search(edges.begin(), edges.end(), undirected(c, d))) continue;
            const Triangle first = {a, d, c}, second = {d, b, c};
            if (!is_better(t, facets_[g], first, second)) continue;
            facets_[f] = first;
            facets_[g] = second;
            is_flipped[f] = is_flipped[g] = 1;
        }
        return is_flipped;
    }

    double edge_length(const Triangle& t, int i) const { return (target_[t[(i + 1) % 3]] - target_[t[i]]).norm(); }

    bool is_better(const Triangle& f, const Triangle& g, const Triangle& first, const Triangle& second) const {
        const auto shape_at = [](const std::vector<Vec3>& points, const Triangle& t) {
            return height_over_length(points[t[0]], points[t[1]], points[t[2]]);
        };
        const auto shape = [&](const Triangle& t) { return shape_at(target_, t); };
        if (std::min(shape_at(start_, first), shape_at(start_, second)) < flattest_facet) return false;
        if (std::min(shape(first), shape(second)) <= std::max(flattest_facet, std::min(shape(f), shape(g))))
            return false;
        const auto direction = [&](const Triangle& t) { return Vec3(doubled_area_vector(start_, t).normalized()); };
        const Vec3 old_f = direction(f), old_g = direction(g), new_f = direction(first), new_g = direction(second);
        return old_f.dot(old_g) > flipped_cosine &&
               std::min({new_f.dot(old_f), new_f.dot(old_g), new_g.dot(old_f), new_g.dot(old_g)}) > flipped_cosine;
    }

    Vec3 position(std::int32_t v) const {
        if (held_[v] >= held_back) return start_[v];
        return held_[v] == 0 ? target_[v] : Vec3(start_[v] + std::ldexp(1, -held_[v]) * (target_[v] - start_[v]));
    }

    std::vector<Vec3> positions() const {
        std::vector<Vec3> all(start_.size());
        for (std::int32_t v = 0; v < count_of(all); ++v) all[v] = position(v);
        return all;
    }

    // Whether a facet has become something else than a facet nearly where it was.
    bool is_spoilt(const std::vector<Vec3>& now, const Triangle& t) const {
        if (std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return held_[v] >= held_back; })) return false;
        const Vec3 after = doubled_area_vector(now, t);
        const auto is_turned_from = [&](const Vec3& before) {
            return !(after.dot(before) > turned_cosine * after.norm() * before.norm());
        };
        return height_over_length(now[t[0]], now[t[1]], now[t[2]]) < thinnest_facet ||
               (is_turned_from(doubled_area_vector(start_, t)) &&
                is_turned_from(normal_[t[0]] + normal_[t[1]] + normal_[t[2]]));
    }

    // Holds vertices back until no facet is spoilt and none cross.
    void hold_back() {
        constexpr int patient_rounds = 8;
        held_.assign(start_.size(), 0);
        std::vector<char> chosen(facets_.size(), 1);  // facets that have moved since they were compared with others
        for (int round = 0;; ++round) {
            check_cancelled_();
            const std::vector<Vec3> now = positions();
            std::vector<char> is_bad(facets_.size(), 0);
            for (std::size_t f = 0; f < facets_.size(); ++f) is_bad[f] = is_spoilt(now, facets_[f]);
            for (const auto& [f, g] : find_intersections_of(chosen, now, facets_, most_pairs))
                is_bad[f] = is_bad[g] = 1;
            const std::vector<char> changed = hold(is_bad, round < patient_rounds ? 1 : held_back);
            if (std::find(changed.begin(), changed.end(), char{1}) == changed.end()) return;
            for (std::size_t f = 0; f < facets_.size(); ++f) {
                const auto& [a, b, c] = facets_[f];
                chosen[f] = changed[a] || changed[b] || changed[c] || is_bad[f];
            }
        }
    }

    // The vertices that go less far now.
    std::vector<char> hold(const std::vector<char>& is_bad, int steps) {
        std::vector<char> changed(start_.size(), 0);
        for (std::size_t f = 0; f < facets_.size(); ++f) {
            if (!is_bad[f]) continue;
            for (const std::int32_t v : facets_[f]) changed[v] = held_[v] < held_back;
        }
        for (std::size_t v = 0; v < changed.size(); ++v)
            if (changed[v]) held_[v] = std::min<int>(held_back, held_[v] + steps);
        return changed;
    }

    // Where two facets meet, the vertices of both are held back, although those of one would do. So they are let go
    // again, all at once or no two on one facet, and stay where that does no harm.
    void release_some(std::uint64_t round) {
        check_cancelled_();
        std::vector<char> is_released(held_.size());
        for (std::size_t v = 0; v < held_.size(); ++v) is_released[v] = held_[v] > 0;
        if (round % 2 == 1) keep_independent(is_released, round);
        const std::vector<char> held = held_;
        for (std::size_t v = 0; v < held.size(); ++v)
            if (is_released[v]) held_[v] = 0;
        std::vector<char> chosen(facets_.size(), 0);
        for (std::size_t f = 0; f < facets_.size(); ++f) chosen[f] = has_any(facets_[f], is_released);
        bool is_good = false;
        while (!is_good) {
            is_good = true;
            const auto hold_again = [&](std::size_t f) {
                for (const std::int32_t v : facets_[f]) {
                    if (!is_released[v]) continue;
                    is_released[v] = 0;
                    held_[v] = held[v];
                    is_good = false;
                }
            };
            const std::vector<Vec3> now = positions();
            for (const auto& [f, g] : find_intersections_of(chosen, now, facets_, most_pairs)) {
                hold_again(f);
                hold_again(g);
            }
            for (std::size_t f = 0; f < facets_.size(); ++f)
                if (chosen[f] && has_any(facets_[f], is_released) && is_spoilt(now, facets_[f])) hold_again(f);
        }
    }

    static bool has_any(const Triangle& t, const std::vector<char>& vertices) {
        return vertices[t[0]] || vertices[t[1]] || vertices[t[2]];
    }

    // Leaves no two on one facet, by an order that is another one each round.
    void keep_independent(std::vector<char>& is_chosen, std::uint64_t round) const {
        const auto rank = [&](std::int32_t v) {
            return held_[v] > 0 ? std::pair(mixed_bits(v ^ (round << 40)), v)
                                : std::pair(std::numeric_limits<std::uint64_t>::max(), v);
        };
        for (const Triangle& t : facets_)
            for (const std::int32_t v : t)
                for (const std::int32_t w : t)
                    if (rank(w) < rank(v)) is_chosen[v] = 0;
    }

    const TriangleTree& input_;
    const double offset_;
    const CancellationCheck check_cancelled_;
    const TriangleTree wrap_;           // as it came
    std::vector<Vec3> wrap_normal_;     // of its facets, of any length
    std::vector<Vec3> start_, target_;  // of the wrap, of the input
    std::vector<Vec3> normal_;          // of the input below each vertex, out of the wrap
    std::vector<char> is_free_;         // goes all of its way, so that its plane is that of the input
    std::vector<char> held_;            // how often its move was halved
    std::vector<Triangle> facets_;
};

}  // namespace

TriangleSet pulled_back(TriangleSet wrap, const TriangleTree& input, double offset,
                        const std::function<void()>& check_cancelled) {
    TriangleSet pulled = WrapPullback(wrap, input, offset, check_cancelled).result();
    return find_self_intersections(pulled.vertices, pulled.facets, 1).empty() ? std::move(pulled) : std::move(wrap);
}

}  // namespace kerf

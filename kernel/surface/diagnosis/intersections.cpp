// Two triangles meet if and only if an edge of one meets the other. An edge st meets a triangle abc across its plane if
// s and t are not strictly on one side of it and the line st passes abc on the same side of all three edges. In one
// plane the question is put to the three projections along the coordinate axes: they drop a coordinate, so they are
// exact; at least one of them maps the plane one to one, hence sets of one plane meet if and only if all three
// projections do.
//
// Vertices that the triangles share by number leave less to test:
//   a vertex a: apart from a they meet if and only if the edge opposite to a of one meets the other triangle;
//   an edge ab: if and only if they are coplanar with the third vertices c and d on the same side of ab.
//
// Most pairs of neighbours are plainly apart. A separating plane with a margin beyond rounding proves that in a few
// multiplications and spares the exact predicates, which are slow where all points lie in one plane.
//
// Pairs that may meet come from a FacetTree, in ranges of its units, each with pairs of its own.
#include "surface/diagnosis/intersections.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/predicates.h"
#include "base/geometry/vector_pair.h"
#include "surface/diagnosis/inside/facet_tree.h"

namespace kerf {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vec3, 3>;

// Generous bound of the relative rounding error of the short sums of products of differences below. It holds as long as
// the products do not underflow: for differences that are zero or above 1e-70.
constexpr double rounding = 1e-14;

// Orientation of the projections along an axis.
int projected_sign(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    return CGAL::orientation(Kernel::Point_2(a[u], a[v]), Kernel::Point_2(b[u], b[v]), Kernel::Point_2(c[u], c[v]));
}

bool projected_boxes_meet(int axis, const Vec3& s, const Vec3& t, const Vec3& a, const Vec3& b) {
    for (int i : {(axis + 1) % 3, (axis + 2) % 3})
        if (std::max(s[i], t[i]) < std::min(a[i], b[i]) || std::max(a[i], b[i]) < std::min(s[i], t[i])) return false;
    return true;
}

// Right for points and collinear segments too: there all signs are zero and the boxes decide.
bool projected_segments_meet(int axis, const Vec3& s, const Vec3& t, const Vec3& a, const Vec3& b) {
    return projected_boxes_meet(axis, s, t, a, b) &&
           projected_sign(axis, s, t, a) * projected_sign(axis, s, t, b) <= 0 &&
           projected_sign(axis, a, b, s) * projected_sign(axis, a, b, t) <= 0;
}

bool projected_contains(int axis, const Corners& q, const Vec3& p) {
    const int turn = projected_sign(axis, q[0], q[1], q[2]);
    if (turn == 0) return false;  // a segment: its edges decide
    for (int i = 0; i < 3; ++i)
        if (projected_sign(axis, q[i], q[(i + 1) % 3], p) == -turn) return false;
    return true;
}

bool coplanar_segment_meets(const Vec3& s, const Vec3& t, const Corners& q) {
    for (int axis = 0; axis < 3; ++axis) {
        bool meets = projected_contains(axis, q, s);
        for (int i = 0; i < 3 && !meets; ++i) meets = projected_segments_meet(axis, s, t, q[i], q[(i + 1) % 3]);
        if (!meets) return false;
    }
    return true;
}

// `side_s`, `side_t`: signs of the ends with respect to the plane of q.
bool segment_meets(const Vec3& s, const Vec3& t, int side_s, int side_t, const Corners& q) {
    if (side_s * side_t > 0) return false;
    std::array<int, 3> pass;
    for (int i = 0; i < 3; ++i) pass[i] = orientation(s, t, q[i], q[(i + 1) % 3]);
    const auto [low, high] = std::minmax_element(pass.begin(), pass.end());
    if (*low < 0 && *high > 0) return false;
    // Where q is only a segment, all sides are zero; lines that are skew have passed its edges on both sides already.
    return side_s != 0 || side_t != 0 || coplanar_segment_meets(s, t, q);
}

std::array<int, 3> sides(const Corners& of, const Corners& plane) {
    std::array<int, 3> sign;
    for (int i = 0; i < 3; ++i) sign[i] = orientation(plane[0], plane[1], plane[2], of[i]);
    return sign;
}

bool on_one_side(const std::array<int, 3>& side) { return side[0] == side[1] && side[1] == side[2] && side[0] != 0; }

// True if the plane through `origin` with normal `w` has the points of `p` above and those of `q` below it for sure.
template <std::size_t N>
bool plainly_apart(const Vec3& origin, const Vec3& w, const std::array<Vec3, N>& p, const std::array<Vec3, N>& q) {
    const double margin = rounding * w.cwiseAbs().sum();
    const auto above = [&](const Vec3& x, double sign) {
        const Vec3 d = x - origin;
        return sign * w.dot(d) > margin * d.cwiseAbs().maxCoeff();
    };
    return std::all_of(p.begin(), p.end(), [&](const Vec3& x) { return above(x, 1); }) &&
           std::all_of(q.begin(), q.end(), [&](const Vec3& x) { return above(x, -1); });
}

// True if all of q lies on one side of the plane of p for sure, as where large facets lie close above each other.
bool plainly_on_one_side(const Corners& p, const Corners& q) {
    const Vec3 u = p[1] - p[0], v = p[2] - p[0], normal = u.cross(v);
    const double margin = rounding * u.cwiseAbs().maxCoeff() * v.cwiseAbs().maxCoeff();
    int above = 0, below = 0;
    for (const Vec3& x : q) {
        const Vec3 d = x - p[0];
        const double height = normal.dot(d), error = margin * d.cwiseAbs().maxCoeff();
        above += height > error;
        below += height < -error;
    }
    return above == 3 || below == 3;
}

// Does the work of plainly_apart() in fewer steps, with a margin that is a little larger.
bool plainly_apart_at(const Vec3& a, const Vec3& w, const std::array<Vec3, 2>& p, const std::array<Vec3, 2>& q) {
    const VectorPair to_p = VectorPair(p[0], p[1]) - VectorPair(a, a), to_q = VectorPair(q[0], q[1]) - VectorPair(a, a);
    const VectorPair across(w, w);
    const Pair margin = rounding * (across.squared_norm() + to_p.squared_norm() + to_q.squared_norm());
    const Pair height_p = across.dot(to_p) - margin, height_q = across.dot(to_q) + margin;
    return height_p[0] > 0 && height_p[1] > 0 && height_q[0] < 0 && height_q[1] < 0;
}

bool meet_without_sharing(const Corners& p, const Corners& q) {
    const Vec3 centre_p = (p[0] + p[1] + p[2]) / 3, centre_q = (q[0] + q[1] + q[2]) / 3;
    if (plainly_apart<3>((centre_p + centre_q) / 2, centre_p - centre_q, p, q)) return false;
    if (plainly_on_one_side(p, q) || plainly_on_one_side(q, p)) return false;
    const std::array<int, 3> side_q = sides(q, p);
    if (on_one_side(side_q)) return false;
    const std::array<int, 3> side_p = sides(p, q);
    if (on_one_side(side_p)) return false;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (segment_meets(q[i], q[j], side_q[i], side_q[j], p)) return true;
        if (segment_meets(p[i], p[j], side_p[i], side_p[j], q)) return true;
    }
    return false;
}

// Whether two facets at vertex a meet beyond it; p, q: their other corners. The vectors from a to these suggest a
// separating plane: their sums, if facets are of one size, else the sums of their directions.
bool meet_beyond_vertex(const Vec3& a, const std::array<Vec3, 2>& p, const std::array<Vec3, 2>& q) {
    if (plainly_apart_at(a, (p[0] - q[0]) + (p[1] - q[1]), p, q)) return false;
    const Vec3 along_p = (p[0] - a).normalized() + (p[1] - a).normalized();
    const Vec3 along_q = (q[0] - a).normalized() + (q[1] - a).normalized();
    if (plainly_apart<2>(a, along_p - along_q, p, q)) return false;
    const Corners t_p = {a, p[0], p[1]}, t_q = {a, q[0], q[1]};
    const std::array<int, 3> side_q = sides(t_q, t_p), side_p = sides(t_p, t_q);
    return segment_meets(q[0], q[1], side_q[1], side_q[2], t_p) || segment_meets(p[0], p[1], side_p[1], side_p[2], t_q);
}

// a, b: the shared edge; c, d: the third vertices.
bool meet_beyond_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 e = b - a, f = c - a, g = d - a;
    const double scale = e.squaredNorm() * (f.squaredNorm() + g.squaredNorm());
    if (e.cross(f).dot(e.cross(g)) < -rounding * scale) return false;  // unfolded by more than a right angle
    if (orientation(a, b, c, d) != 0) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (projected_sign(axis, a, b, c) * projected_sign(axis, a, b, d) > 0) return true;
    return false;
}

// Corners of two facets that are the same vertex.
struct Sharing {
    int count = 0;
    std::array<std::array<std::uint8_t, 2>, 2> corners;  // the first two

    Sharing(const Triangle& p, const Triangle& q) {
        unsigned equal = 0;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) equal |= static_cast<unsigned>(p[i] == q[j]) << (3 * i + j);
        for (std::array<std::uint8_t, 2>& corner : corners) {
            count += equal != 0 ? 1 : 0;
            const int bit = std::countr_zero(equal | 0x100U);
            corner = {static_cast<std::uint8_t>(bit / 3), static_cast<std::uint8_t>(bit % 3)};
            equal &= equal - 1;
        }
        count += equal != 0 ? 1 : 0;
    }
};

using CornerPointers = std::array<const Vec3*, 3>;

bool meet_beyond_shared(const CornerPointers& p, const Triangle& p_id, const CornerPointers& q, const Triangle& q_id) {
    const Sharing sharing(p_id, q_id);
    const auto [i, j] = sharing.corners[0];
    const auto [k, l] = sharing.corners[1];
    switch (sharing.count) {
        case 0:
            return meet_without_sharing({*p[0], *p[1], *p[2]}, {*q[0], *q[1], *q[2]});
        case 1:
            return meet_beyond_vertex(*p[i], {*p[(i + 1) % 3], *p[(i + 2) % 3]}, {*q[(j + 1) % 3], *q[(j + 2) % 3]});
        case 2:
            return meet_beyond_edge(*p[i], *p[k], *p[3 - i - k], *q[3 - j - l]);
        default:
            return true;
    }
}

bool facets_intersect(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t) {
    return meet_beyond_shared({&vertices[s[0]], &vertices[s[1]], &vertices[s[2]]}, s,
                              {&vertices[t[0]], &vertices[t[1]], &vertices[t[2]]}, t);
}

// A soup with so many intersections is no surface; finding them all may take minutes.
constexpr std::size_t hopeless_factor = 20;

// Ends a search in ranges behind that with which too many are found, whichever of them are done first.
class SearchEnd {
 public:
    SearchEnd(std::size_t ranges, std::size_t most) : end_(ranges), most_(most), found_(ranges, unknown) {}
    std::size_t end() const { return end_; }
    void tell(std::size_t range, std::size_t found) {
        const std::lock_guard lock(mutex_);
        found_[range] = found;
        for (; known_ < end_ && found_[known_] != unknown; ++known_) {
            sum_ += found_[known_];
            if (sum_ >= most_) end_ = known_ + 1;
        }
    }

 private:
    static constexpr std::size_t unknown = ~std::size_t{0};

    std::atomic<std::size_t> end_;
    const std::size_t most_;
    std::mutex mutex_;
    std::vector<std::size_t> found_;
    std::size_t known_ = 0, sum_ = 0;  // of the ranges before that
};

void keep_first(IntersectingPairs& pairs, std::size_t limit) {
    std::sort(pairs.begin(), pairs.end());
    if (pairs.size() > limit) pairs.resize(limit);
}

// for_each_pair(range, visit) calls visit(f, g) for pairs of facets that may meet, until it returns true; the ranges
// are those of base/core/threads.h.
template <class ForEachPair>
IntersectingPairs first_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      std::size_t count, std::size_t limit, const ForEachPair& for_each_pair) {
    constexpr std::size_t grain = 1024;
    const std::size_t most = hopeless_factor * limit;
    SearchEnd search((count + grain - 1) / grain, most);
    std::vector<IntersectingPairs> of_ranges = values_of_ranges(count, grain, [&](const IndexRange& range) {
        IntersectingPairs pairs;
        if (range.first / grain >= search.end()) return pairs;
        std::size_t found = 0;
        for_each_pair(range, [&](std::int32_t f, std::int32_t g) {
            if (!facets_intersect(vertices, facets[f], facets[g])) return false;
            pairs.push_back(std::minmax(f, g));
            if (pairs.size() > 2 * limit + 1000) keep_first(pairs, limit);
            return ++found >= most;
        });
        keep_first(pairs, limit);
        search.tell(range.first / grain, found);
        return pairs;
    });
    IntersectingPairs all;
    for (std::size_t i = 0; i < search.end(); ++i) all.insert(all.end(), of_ranges[i].begin(), of_ranges[i].end());
    keep_first(all, limit);
    return all;
}

}  // namespace

bool triangles_intersect(const std::array<Vec3, 3>& p, const Triangle& p_id, const std::array<Vec3, 3>& q,
                         const Triangle& q_id) {
    return meet_beyond_shared({&p[0], &p[1], &p[2]}, p_id, {&q[0], &q[1], &q[2]}, q_id);
}

Vec3 meeting_place(const std::vector<Vec3>& vertices, const Triangle& s, const Triangle& t) {
    Vec3 nearest = vertices[s[0]];
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [own, other] : {std::pair(s, t), std::pair(t, s)}) {
        const Vec3 &a = vertices[other[0]], &b = vertices[other[1]], &c = vertices[other[2]];
        const Vec3 normal = (b - a).cross(c - a);
        const auto try_place = [&](const Vec3& place) {
            const double distance = point_triangle_distance(place, a, b, c);
            if (distance < least) nearest = place;
            least = std::min(least, distance);
        };
        for (int i = 0; i < 3; ++i) {
            const bool is_shared = std::find(other.begin(), other.end(), own[i]) != other.end();
            const Vec3 &from = vertices[own[i]], &to = vertices[own[(i + 1) % 3]];
            const double height = normal.dot(from - a), height_of_end = normal.dot(to - a);
            if (!is_shared) try_place(from);
            if (height * height_of_end < 0) try_place(from + height / (height - height_of_end) * (to - from));
        }
    }
    return nearest;
}

SelfIntersectionSearch::SelfIntersectionSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
    : vertices_(vertices), facets_(facets), tree_(std::make_unique<const FacetTree>(vertices, facets)) {}

SelfIntersectionSearch::~SelfIntersectionSearch() = default;

IntersectingPairs SelfIntersectionSearch::pairs_of_share(std::size_t share, std::size_t shares,
                                                         std::size_t limit) const {
    KERF_CHECK(share < shares && limit > 0);
    const std::size_t units = tree_->unit_count();
    const std::size_t first = units * share / shares, last = units * (share + 1) / shares;
    return first_intersections(vertices_, facets_, last - first, limit, [&](IndexRange range, const auto& visit) {
        tree_->any_pair({first + range.first, first + range.last}, visit);
    });
}

IntersectingPairs find_self_intersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                          std::size_t limit) {
    return SelfIntersectionSearch(vertices, facets).pairs_of_share(0, 1, limit);
}

bool nested_shells_are_apart(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& shell, const std::vector<std::int32_t>& parent) {
    KERF_CHECK(shell.size() == facets.size());
    if (parent.size() <= 1) return find_self_intersections(vertices, facets, 1).empty();
    const auto are_next = [&](std::int32_t s, std::int32_t t) {
        return s == t || parent[s] == parent[t] || parent[s] == t || parent[t] == s;
    };
    const FacetTree tree(vertices, facets);
    const auto pairs =
        first_intersections(vertices, facets, tree.unit_count(), 1, [&](const IndexRange& range, const auto& visit) {
            tree.any_pair(range,
                          [&](std::int32_t f, std::int32_t g) { return are_next(shell[f], shell[g]) && visit(f, g); });
        });
    return pairs.empty();
}

IntersectingPairs find_intersections_of(const std::vector<char>& chosen, const std::vector<Vec3>& vertices,
                                        const std::vector<Triangle>& facets, std::size_t limit,
                                        const std::function<bool(std::int32_t, std::int32_t)>& counts) {
    KERF_CHECK(chosen.size() == facets.size());
    std::vector<std::int32_t> few;
    for (std::int32_t f = 0; f < count_of(facets); ++f)
        if (chosen[f]) few.push_back(f);
    const FacetTree tree(vertices, facets, few);
    const auto is_counted = [&](std::int32_t f, std::int32_t g) {
        return !counts || (facets_intersect(vertices, facets[f], facets[g]) && counts(f, g));
    };
    // All facets ask the tree; chosen ones come in both orders.
    return first_intersections(vertices, facets, facets.size(), limit, [&](const IndexRange& range, const auto& visit) {
        for (std::int32_t f = range.first, last = range.last; f < last; ++f)
            if (tree.any_near(f, [&](std::int32_t g) {
                    return g != f && (g < f || !chosen[f]) && is_counted(f, g) && visit(f, g);
                }))
                return;
    });
}

}  // namespace kerf

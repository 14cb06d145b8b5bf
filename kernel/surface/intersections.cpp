// Two triangles meet if and only if an edge of one meets the other. An edge st meets a triangle abc across its plane if
// s and t are not strictly on one side of it and the line st passes abc on the same side of all three edges. In one
// plane the question is put to the three projections along the coordinate axes: they drop a coordinate, so they are
// exact; at least one of them maps the plane one to one, hence sets of one plane meet if and only if all three
// projections do.
//
// What the triangles share by number leaves less to test:
//   a vertex a: apart from a they meet if and only if the edge opposite to a of one meets the other triangle;
//   an edge ab: if and only if they are coplanar with the third vertices c and d on the same side of ab.
//
// Most pairs of neighbours are plainly apart. A separating plane with a margin beyond rounding proves that in a few
// multiplications and spares the exact predicates, which are slow where all points lie in one plane.
#include "surface/intersections.h"

#include <algorithm>
#include <cmath>

#include <CGAL/Box_intersection_d/Box_with_handle_d.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include "core/check.h"
#include "core/elements.h"
#include "geometry/box.h"
#include "geometry/predicates.h"

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

// p[0] and q[0] are the shared vertex.
bool meet_beyond_vertex(const Corners& p, const Corners& q) {
    const Vec3& a = p[0];
    const Vec3 along_p = (p[1] - a).normalized() + (p[2] - a).normalized();
    const Vec3 along_q = (q[1] - a).normalized() + (q[2] - a).normalized();
    if (plainly_apart<2>(a, along_p - along_q, {p[1], p[2]}, {q[1], q[2]})) return false;
    const std::array<int, 3> side_q = sides(q, p), side_p = sides(p, q);
    return segment_meets(q[1], q[2], side_q[1], side_q[2], p) || segment_meets(p[1], p[2], side_p[1], side_p[2], q);
}

// a, b: the shared edge; c, d: the third vertices.
bool meet_beyond_edge(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 e = b - a, f = c - a, g = d - a;
    const double scale = e.squaredNorm() * f.norm() * g.norm();
    if (e.cross(f).dot(e.cross(g)) < -rounding * scale) return false;  // unfolded by more than a right angle
    if (orientation(a, b, c, d) != 0) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (projected_sign(axis, a, b, c) * projected_sign(axis, a, b, d) > 0) return true;
    return false;
}

// Corners of p and q that are the same vertex.
struct Sharing {
    std::array<std::pair<int, int>, 3> corners;
    int count = 0;
};

Sharing find_sharing(const Triangle& p, const Triangle& q) {
    Sharing sharing;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (p[i] == q[j]) {
                sharing.corners[sharing.count++] = {i, j};
                break;
            }
    return sharing;
}

// A soup with so many intersections is no surface; finding them all may take minutes.
constexpr std::size_t hopeless_factor = 20;
struct Hopeless {};

Corners rotated(const Corners& p, int first) { return {p[first], p[(first + 1) % 3], p[(first + 2) % 3]}; }

using FacetBox = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, const Triangle*>;

std::vector<FacetBox> facet_boxes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    std::vector<FacetBox> boxes;
    boxes.reserve(facets.size());
    for (const Triangle& t : facets) {
        const Box box = box_around(vertices, t);
        const Vec3 &low = box.min(), &high = box.max();
        boxes.emplace_back(CGAL::Bbox_3(low.x(), low.y(), low.z(), high.x(), high.y(), high.z()), &t);
    }
    return boxes;
}

// Collects the intersecting ones of the pairs of boxes that it is given, the first of them, until there are too many.
class PairSearch {
 public:
    PairSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::size_t limit)
        : vertices_(vertices), facets_(facets), limit_(limit) {}

    // `for_each_pair` calls what it is given with each pair.
    template <class ForEachPair>
    std::vector<std::pair<std::int32_t, std::int32_t>> run(ForEachPair for_each_pair) {
        try {
            for_each_pair([this](const FacetBox& a, const FacetBox& b) { test(*a.handle(), *b.handle()); });
        } catch (const Hopeless&) {
            // there are enough of them
        }
        keep_first();
        return std::move(pairs_);
    }

 private:
    Corners corners(const Triangle& t) const { return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]}; }
    std::int32_t number(const Triangle& t) const { return static_cast<std::int32_t>(&t - facets_.data()); }
    void keep_first() {
        std::sort(pairs_.begin(), pairs_.end());
        if (pairs_.size() > limit_) pairs_.resize(limit_);
    }
    void test(const Triangle& s, const Triangle& t) {
        if (!triangles_intersect(corners(s), s, corners(t), t)) return;
        pairs_.push_back(std::minmax(number(s), number(t)));
        if (pairs_.size() > 2 * limit_ + 1000) keep_first();  // the boxes come in no particular order
        if (++found_ == hopeless_factor * limit_) throw Hopeless();
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    std::size_t limit_, found_ = 0;
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs_;
};

}  // namespace

bool triangles_intersect(const std::array<Vec3, 3>& p, const Triangle& p_id, const std::array<Vec3, 3>& q,
                         const Triangle& q_id) {
    const Sharing sharing = find_sharing(p_id, q_id);
    const auto [i, j] = sharing.corners[0];
    const auto [k, l] = sharing.corners[1];
    switch (sharing.count) {
        case 0:
            return meet_without_sharing(p, q);
        case 1:
            return meet_beyond_vertex(rotated(p, i), rotated(q, j));
        case 2:
            return meet_beyond_edge(p[i], p[k], p[3 - i - k], q[3 - j - l]);
        default:
            return true;
    }
}

std::vector<std::pair<std::int32_t, std::int32_t>> find_self_intersections(const std::vector<Vec3>& vertices,
                                                                           const std::vector<Triangle>& facets,
                                                                           std::size_t limit) {
    std::vector<FacetBox> boxes = facet_boxes(vertices, facets);
    return PairSearch(vertices, facets, limit).run([&](const auto& test_pair) {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), test_pair);
    });
}

bool nested_shells_are_apart(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& shell, const std::vector<std::int32_t>& parent) {
    KERF_CHECK(shell.size() == facets.size());
    std::vector<std::vector<FacetBox>> inside(parent.size()), of(parent.size());  // of the shells in each, of itself
    std::vector<FacetBox> outermost;
    for (const FacetBox& box : facet_boxes(vertices, facets)) {
        const std::int32_t own = shell[box.handle() - facets.data()], around = parent[own];
        (around < 0 ? outermost : inside[around]).push_back(box);
        of[own].push_back(box);
    }
    const auto pairs = PairSearch(vertices, facets, 1).run([&](const auto& test_pair) {
        CGAL::box_self_intersection_d(outermost.begin(), outermost.end(), test_pair);
        for (std::size_t s = 0; s < parent.size(); ++s) {
            CGAL::box_self_intersection_d(inside[s].begin(), inside[s].end(), test_pair);
            CGAL::box_intersection_d(of[s].begin(), of[s].end(), inside[s].begin(), inside[s].end(), test_pair);
        }
    });
    return pairs.empty();
}

std::vector<std::pair<std::int32_t, std::int32_t>> find_intersections_of(const std::vector<char>& chosen,
                                                                         const std::vector<Vec3>& vertices,
                                                                         const std::vector<Triangle>& facets,
                                                                         std::size_t limit) {
    KERF_CHECK(chosen.size() == facets.size());
    std::vector<FacetBox> all = facet_boxes(vertices, facets), few;
    const auto is_chosen = [&](const FacetBox& box) { return chosen[box.handle() - facets.data()] != 0; };
    std::copy_if(all.begin(), all.end(), std::back_inserter(few), is_chosen);
    return PairSearch(vertices, facets, limit).run([&](const auto& test_pair) {
        const auto test_once = [&](const FacetBox& a, const FacetBox& b) {  // two chosen ones come in both orders
            if (a.handle() != b.handle() && (a.handle() < b.handle() || !is_chosen(b))) test_pair(a, b);
        };
        CGAL::box_intersection_d(few.begin(), few.end(), all.begin(), all.end(), test_once);
    });
}

}  // namespace kerf

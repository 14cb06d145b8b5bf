// A gap is measured between two facets that face each other: the part of one that lies over the other is a convex
// polygon, so that its corners have the largest and the smallest distance. An overlap is measured between two bodies:
// the pairs of facets that intersect tell where it is and whether the bodies lie flat upon each other, and points of
// one body inside of the other tell how deep it is.
#include "surface/diagnosis/inside/wall_mismatch.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "base/core/ids.h"
#include "base/geometry/box_tree.h"
#include "base/geometry/triangle.h"
#include "surface/diagnosis/intersections.h"
#include "surface/soup/ray_parity.h"
#include "surface/soup/triangle_tree.h"

namespace kerf {

namespace {

using FacetCorners = std::array<Vec3, 3>;

FacetCorners corners_of(const std::vector<Vec3>& vertices, const Triangle& t) {
    return {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
}

double longest_edge(const FacetCorners& p) {
    return std::max({(p[1] - p[0]).norm(), (p[2] - p[1]).norm(), (p[0] - p[2]).norm()});
}

// Returns the part of a convex polygon on the side of a plane that its normal points to.
void clip(std::vector<Vec3>& polygon, const Vec3& origin, const Vec3& normal) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double of_p = normal.dot(p - origin), of_q = normal.dot(q - origin);
        if (of_p >= 0) kept.push_back(p);
        if ((of_p > 0 && of_q < 0) || (of_p < 0 && of_q > 0)) kept.push_back(p + of_p / (of_p - of_q) * (q - p));
    }
    polygon = std::move(kept);
}

double doubled_area_along(const std::vector<Vec3>& polygon, const Vec3& normal) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i) sum += doubled_area_vector(polygon[0], polygon[i - 1], polygon[i]);
    return std::abs(normal.dot(sum));
}

struct FacetGap {
    double distance = 0;  // the widest
    Vec3 where = Vec3::Zero();
};

// Whether the facets face each other, with some area over each other.
bool face_each_other(const FacetCorners& f, const FacetCorners& g, FacetGap& gap) {
    constexpr double opposite = -0.5, least_area = 1e-3;  // the cosine of the normals; of the smaller facet
    const Vec3 of_f = doubled_area_vector(f), of_g = doubled_area_vector(g);
    const Vec3 normal = of_f.normalized();
    if (!(normal.dot(of_g) < opposite * of_g.norm())) return false;
    std::vector<Vec3> over(g.begin(), g.end());
    for (std::size_t i = 0; i < 3 && !over.empty(); ++i) clip(over, f[i], normal.cross(f[(i + 1) % 3] - f[i]));
    if (!(doubled_area_along(over, normal) > least_area * std::min(of_f.norm(), of_g.norm()))) return false;
    gap.distance = -std::numeric_limits<double>::infinity();
    for (const Vec3& p : over)
        if (const double height = normal.dot(p - f[0]); height > gap.distance) gap = {height, p - height / 2 * normal};
    return gap.distance > 0;
}

// Results by their bodies.
class Mismatches {
 public:
    WallMismatch& between(std::int32_t a, std::int32_t b, WallMismatch::Kind kind) {
        const std::array<std::int32_t, 2> bodies = {std::min(a, b), std::max(a, b)};
        const WallMismatch none = {kind, bodies, {}, Vec3::Zero(), -1, std::numeric_limits<double>::infinity()};
        return found_.try_emplace(bodies, none).first->second;
    }
    // The facets of each so far: pairs, the worst one of which is known.
    std::vector<WallMismatch> take() {
        std::vector<WallMismatch> all;
        for (auto& [bodies, mismatch] : found_) {
            std::vector<std::int32_t>& facets = mismatch.facets;
            const std::array<std::int32_t, 2> worst = {facets[0], facets[1]};
            std::sort(facets.begin(), facets.end());
            facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
            std::stable_partition(facets.begin(), facets.end(),
                                  [&](std::int32_t f) { return f == worst[0] || f == worst[1]; });
            all.push_back(std::move(mismatch));
        }
        return all;
    }

 private:
    std::map<std::array<std::int32_t, 2>, WallMismatch> found_;
};

// The worst pair is kept in front.
void add_pair(WallMismatch& mismatch, std::int32_t f, std::int32_t g, double distance, const Vec3& where) {
    mismatch.facets.insert(mismatch.facets.end(), {f, g});
    if (!(distance > mismatch.distance)) return;
    mismatch.distance = distance;
    mismatch.where = where;
    std::swap(mismatch.facets[0], *(mismatch.facets.end() - 2));
    std::swap(mismatch.facets[1], mismatch.facets.back());
}

// Returns the largest distance by which an edge of f passes through g, and away from the border of g.
double passage(const FacetCorners& f, const FacetCorners& g) {
    const Vec3 normal = doubled_area_vector(g).normalized();
    double deepest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &s = f[i], &t = f[(i + 1) % 3];
        const double of_s = normal.dot(s - g[0]), of_t = normal.dot(t - g[0]);
        if (!(of_s * of_t < 0)) continue;
        const Vec3 p = s + of_s / (of_s - of_t) * (t - s);
        double depth = std::min(std::abs(of_s), std::abs(of_t));
        for (std::size_t j = 0; j < 3; ++j)
            depth = std::min(depth, normal.cross(g[(j + 1) % 3] - g[j]).normalized().dot(p - g[j]));
        deepest = std::max(deepest, depth);
    }
    return deepest;
}

struct ClosedBody {
    Shell shell;
    std::vector<Vec3> points;  // the corners of its facets, each once, and their centroids
    std::unique_ptr<TriangleTree> tree;
};

class DepthGauge {
 public:
    DepthGauge(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
               const std::vector<std::int32_t>& body)
        : vertices_(vertices) {
        const std::int32_t count = *std::max_element(body.begin(), body.end()) + 1;
        for (Shell& shell : collect_shells(vertices, facets, body, count)) {
            ClosedBody& own = bodies_.emplace_back();
            std::vector<std::int32_t> corners;
            for (const Triangle& t : shell.facets) corners.insert(corners.end(), t.begin(), t.end());
            std::sort(corners.begin(), corners.end());
            corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
            for (const std::int32_t v : corners) own.points.push_back(vertices[v]);
            for (const auto& [a, b, c] : shell.facets)
                own.points.emplace_back((vertices[a] + vertices[b] + vertices[c]) / 3);
            own.shell = std::move(shell);
        }
    }

    // Returns the depth of an overlap. If bodies lie side by side, it is how deep points of one lie in the other; if
    // one is meant to lie in the other, it is how far its corners lie outside of it.
    double depth(std::int32_t a, std::int32_t b) { return std::max(depth_of(a, b), depth_of(b, a)); }

 private:
    double depth_of(std::int32_t a, std::int32_t b) {
        const double inside = furthest(a, b, true, std::numeric_limits<double>::infinity());
        return inside > 0 ? std::min(inside, furthest(a, b, false, inside)) : 0;
    }
    // Ends once a distance exceeds `enough`.
    double furthest(std::int32_t a, std::int32_t b, bool is_inside, double enough) {
        ClosedBody& other = bodies_[b];
        if (!other.tree) other.tree = std::make_unique<TriangleTree>(vertices_, other.shell.facets);
        double furthest = 0;
        for (const Vec3& p : bodies_[a].points) {
            if (furthest >= enough) break;
            const bool may_be = other.shell.box.contains(p);
            const std::optional<bool> is_there = may_be ? encloses(vertices_, other.shell, p) : false;
            if (is_there != is_inside) continue;
            furthest = std::max(furthest, std::sqrt(other.tree->closest(p).squared_distance));
        }
        return furthest;
    }

    const std::vector<Vec3>& vertices_;
    std::vector<ClosedBody> bodies_;
};

// Each facet once, those that several bodies have by the first of these.
std::vector<std::int32_t> different_facets(const std::vector<Triangle>& facets) {
    std::set<Triangle> seen;
    std::vector<std::int32_t> different;
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        Triangle sorted = facets[f];
        std::sort(sorted.begin(), sorted.end());
        if (seen.insert(sorted).second) different.push_back(f);
    }
    return different;
}

}  // namespace

std::vector<WallMismatch> find_gaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                    const std::vector<std::int32_t>& body, double share) {
    Mismatches found;
    if (facets.empty()) return {};
    const BoxTree tree(boxes_around(vertices, facets));
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        const FacetCorners corners = corners_of(vertices, facets[f]);
        const double longest = longest_edge(corners);
        const Vec3 reach = Vec3::Constant(share * longest);
        const Box own = box_around(vertices, facets[f]);
        tree.for_each_meeting(Box(own.min() - reach, own.max() + reach), [&](std::int32_t g) {
            if (g <= f || body[g] == body[f]) return;
            const FacetCorners others = corners_of(vertices, facets[g]);
            const double size = std::min(longest, longest_edge(others));
            FacetGap gap;
            if (!face_each_other(corners, others, gap) || gap.distance > share * size) return;
            WallMismatch& mismatch = found.between(body[f], body[g], WallMismatch::Kind::gap);
            mismatch.least_share = std::min(mismatch.least_share, gap.distance / size);
            add_pair(mismatch, f, g, gap.distance, gap.where);
        });
    }
    return found.take();
}

std::vector<WallMismatch> find_overlaps(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                        const std::vector<std::int32_t>& body) {
    constexpr std::size_t most_pairs = 10'000;
    constexpr double flat = -0.86;     // cosine of normals that are opposite but for 30 degrees
    constexpr double of_facets = 0.1;  // that facets upon each other may be apart
    constexpr double next_to_nothing = 1e-6;
    const std::vector<std::int32_t> number = different_facets(facets);
    std::vector<Triangle> different;
    for (const std::int32_t f : number) different.push_back(facets[f]);
    struct Findings {
        bool lie_flat = false;
        double longest = 0;
    };
    std::map<std::array<std::int32_t, 2>, Findings> findings;
    Mismatches found;
    for (const auto& [s, t] : find_self_intersections(vertices, different, most_pairs)) {
        const std::int32_t f = number[s], g = number[t];
        if (body[f] == body[g]) continue;
        WallMismatch& mismatch = found.between(body[f], body[g], WallMismatch::Kind::overlap);
        const FacetCorners of_f = corners_of(vertices, facets[f]), of_g = corners_of(vertices, facets[g]);
        const double distance = std::max(passage(of_f, of_g), passage(of_g, of_f));
        const double longest = std::max(longest_edge(of_f), longest_edge(of_g));
        const Box common = box_around(of_f).intersection(box_around(of_g));
        add_pair(mismatch, f, g, distance, common.center());
        Findings& own = findings[mismatch.bodies];
        const Vec3 normal = doubled_area_vector(of_f).normalized();
        own.lie_flat |= normal.dot(doubled_area_vector(of_g).normalized()) < flat;
        own.longest = std::max(own.longest, longest);
    }
    std::vector<WallMismatch> all = found.take();
    if (all.empty()) return all;
    DepthGauge gauge(vertices, facets, body);
    for (WallMismatch& mismatch : all) {
        const Findings& own = findings[mismatch.bodies];
        // The depth of points inside is a better measure than that of edges that pass through facets, where there are
        // such points.
        if (const double depth = gauge.depth(mismatch.bodies[0], mismatch.bodies[1]);
            depth > next_to_nothing * own.longest)
            mismatch.distance = depth;
        if (mismatch.distance <= (own.lie_flat ? of_facets : next_to_nothing) * own.longest)
            mismatch.kind = WallMismatch::Kind::unlike;
    }
    return all;
}

}  // namespace kerf

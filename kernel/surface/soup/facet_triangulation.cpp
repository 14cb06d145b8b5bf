// The facet is projected by leaving out the coordinate along which its normal is longest: the others are numbers of the
// file, so that corners on a straight line stay on one. All corners become vertices, then all edges constraints.
// Triangles that can be reached from infinity, or from a hole point, without crossing a constraint are outside.
#include "surface/soup/facet_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/number_text.h"
#include "surface/soup/planar_delaunay.h"
#include "surface/soup/scaled_polygon.h"

namespace kerf {

namespace {

namespace planar {

using Edge = std::array<std::int64_t, 2>;

// The two coordinates that stay, in the order in which the normal points to the viewer.
struct Projection {
    int x = 0, y = 1;

    explicit Projection(const Vec3& normal) {
        int axis = 0;
        normal.cwiseAbs().maxCoeff(&axis);
        x = (axis + 1) % 3;
        y = (axis + 2) % 3;
        if (normal[axis] < 0) std::swap(x, y);
    }
    Vec2 operator()(const Vec3& p) const { return {p[x], p[y]}; }
};

// Along the normal of the polygon of the largest area; zero if none has one.
Vec3 largest_area(const std::vector<Vec3>& vertices, const PolygonalFacet& facet, double scale) {
    Vec3 largest = Vec3::Zero();
    for (const auto& corners : facet.polygons) {
        const ScaledPolygon polygon(vertices, corners);
        if (corners.size() < 3 || !polygon.has_size()) continue;
        const double relative = polygon.scale() / scale;
        const Vec3 sum = newell_sum(polygon) * (relative * relative);
        if (sum.squaredNorm() > largest.squaredNorm()) largest = sum;
    }
    return largest;
}

std::vector<Edge> edges_of(const PolygonalFacet& facet) {
    std::vector<Edge> edges;
    for (const auto& corners : facet.polygons)
        for (std::size_t i = 0; i < corners.size() && (i == 0 || corners.size() > 2); ++i)
            edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
    return edges;
}

class Triangulator {
 public:
    Triangulator(const std::vector<Vec3>& vertices, const Vec3& normal) : vertices_(vertices), project_(normal) {}

    void insert_corners(const PolygonalFacet& facet) {
        for (const auto& corners : facet.polygons)
            for (const std::int64_t v : corners) {
                const auto [known, is_new] = number_of_.try_emplace(v);
                if (!is_new) continue;
                known->second = delaunay_.insert(project_(vertices_[v]));
                corner_.push_back(v);
            }
    }
    // The point where two edges cross, if they do.
    std::optional<Vec3> insert_edges(const std::vector<Edge>& edges) {
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (!delaunay_.insert_edge(number_of_.at(edges[i][0]), number_of_.at(edges[i][1])))
                return crossing_with(edges[i], {edges.begin(), edges.begin() + i});
        return {};
    }
    bool has_faces() const { return delaunay_.has_triangles(); }
    void mark_outside() { delaunay_.mark_enclosed(); }
    // False if the point lies on an edge, so that it does not say which side is the hole.
    bool mark_hole(const Vec3& hole) { return delaunay_.mark_hole(project_(hole)); }
    std::vector<Triangle> triangles() const {
        std::vector<Triangle> found = delaunay_.triangles();
        for (Triangle& t : found) {
            for (std::int32_t& corner : t) corner = corner_[corner];
            std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    // Polygons of one or two corners, of which one is no corner of the triangles.
    std::int64_t count_outside(const PolygonalFacet& facet, const std::vector<Triangle>& triangles) const {
        std::vector<std::int32_t> used;
        for (const Triangle& t : triangles) used.insert(used.end(), t.begin(), t.end());
        std::sort(used.begin(), used.end());
        const auto is_outside = [&](std::int64_t v) {
            const std::int32_t first = corner_[delaunay_.first_number(number_of_.at(v))];
            return !std::binary_search(used.begin(), used.end(), first);
        };
        return std::count_if(facet.polygons.begin(), facet.polygons.end(), [&](const auto& corners) {
            return corners.size() < 3 && std::any_of(corners.begin(), corners.end(), is_outside);
        });
    }

 private:
    // The first of the other edges that crosses one, and where; its middle if rounding hides which.
    Vec3 crossing_with(const Edge& edge, const std::vector<Edge>& others) const {
        const Vec3 &a = vertices_[edge[0]], &b = vertices_[edge[1]];
        for (const Edge& other : others) {
            const Vec3 &c = vertices_[other[0]], &d = vertices_[other[1]];
            const auto side = [&](const Vec3& p, const Vec3& q, const Vec3& of) {
                return planar_orientation(project_(p), project_(q), project_(of));
            };
            const bool is_crossed = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
            if (!is_crossed) continue;
            const auto area = [&](const Vec3& of) {
                const Vec3 u = d - c, v = of - c;
                return std::abs(u[project_.x] * v[project_.y] - u[project_.y] * v[project_.x]);
            };
            const double of_a = area(a), of_b = area(b);
            return of_a + of_b > 0 ? Vec3(a + of_a / (of_a + of_b) * (b - a)) : Vec3((a + b) / 2);
        }
        return (a + b) / 2;
    }

    const std::vector<Vec3>& vertices_;
    Projection project_;
    PlanarDelaunay delaunay_;
    std::map<std::int64_t, std::int32_t> number_of_;  // of a vertex in the triangulation
    std::vector<std::int64_t> corner_;                // and of a number the vertex
};

FacetTriangulation refusal(std::string obstacle) { return {{}, std::move(obstacle), 0}; }

FacetTriangulation triangulate_in_plane(const std::vector<Vec3>& vertices, const PolygonalFacet& facet,
                                        const Vec3& normal) {
    Triangulator triangulator(vertices, normal);
    triangulator.insert_corners(facet);
    if (const auto crossing = triangulator.insert_edges(edges_of(facet)))
        return refusal("has edges that cross near " + place_text(*crossing));
    const Vec3& first = vertices[facet.polygons.front().front()];
    if (!triangulator.has_faces()) return refusal("has no area near " + place_text(first));
    triangulator.mark_outside();
    for (const Vec3& hole : facet.holes)
        if (!triangulator.mark_hole(hole)) return refusal("has its hole point " + place_text(hole) + " on an edge");
    FacetTriangulation result{triangulator.triangles(), {}, 0};
    if (result.triangles.empty())
        return refusal(facet.holes.empty()
                           ? "has no area near " + place_text(first)
                           : "has the hole point " + place_text(facet.holes.front()) + ", which leaves nothing of it");
    result.outside = triangulator.count_outside(facet, result.triangles);
    return result;
}

}  // namespace planar

}  // namespace

FacetTriangulation triangulate_facet(const std::vector<Vec3>& vertices, const PolygonalFacet& facet) {
    std::vector<std::int64_t> corners;
    for (const auto& polygon : facet.polygons) corners.insert(corners.end(), polygon.begin(), polygon.end());
    KERF_CHECK(!corners.empty());
    const ScaledPolygon all(vertices, corners);
    for (const std::int64_t v : corners)
        if (!vertices[v].allFinite()) return planar::refusal("has the corner " + place_text(vertices[v]));
    const Vec3 area = all.has_size() ? planar::largest_area(vertices, facet, all.scale()) : Vec3(Vec3::Zero());
    const Vec3 normal = area.stableNormalized(), &first = vertices[corners.front()];
    if (normal.isZero()) return planar::refusal("has no area near " + place_text(first));
    if (const PlaneHeights heights(all, normal); !heights.is_flat(all))
        return planar::refusal(fmt::format("is not planar: its corners {} and {} are {:.3g} apart along its normal",
                                           place_text(vertices[corners[heights.lowest]]),
                                           place_text(vertices[corners[heights.highest]]),
                                           (heights.high - heights.low) * all.scale()));
    return planar::triangulate_in_plane(vertices, facet, normal);
}

}  // namespace kerf

// Sizes told from facets, each a list of facets with one size for all three corners. Curvature is integrated around the
// vertices (Meyer et al. 2003, meyer2003): A is a third of the facets' areas, H = sum over the edges of turn * length /
// 4, divided by A, the mean curvature, and K = (2 pi - sum of angles) / A the Gaussian one; the larger principal
// curvature is H + sqrt(H^2 - K). At feature edges K says nothing about the surface on either side and counts as 0. The
// thickness is the length of a ray from a facet's centroid into the body up to a facet that faces it; facets at the
// same wall that only turn away from the ray are passed.
#include "surface/size/inside/surface_sizes.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/geometry/angles.h"
#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double feature_turn = 40 * std::numbers::pi / 180;
constexpr double flat = 1e-6;           // radians that an edge turns: rounding of coordinates does as much
constexpr double facing_cosine = -0.5;  // of the normals of both sides of a wall

SizedTriangle sized_facet(const SurfaceArrays& surface, const Triangle& t, double size, double reach = 0) {
    const auto& p = surface.vertices;
    return {p[t[0]], p[t[1]], p[t[2]], {size, size, size}, reach};
}

// Integrals around the vertices.
struct VertexCurvature {
    double area = 0, mean = 0, angle = 0;
    bool at_feature = false;

    // The larger principal one, as an absolute value.
    double largest() const {
        if (area <= 0 || mean <= 0) return 0;
        const double h = mean / area, gauss = at_feature ? 0 : (2 * std::numbers::pi - angle) / area;
        return h + std::sqrt(std::max(0.0, h * h - gauss));
    }
};

void add_facets(const SurfaceArrays& surface, std::vector<VertexCurvature>& at) {
    for (const Triangle& t : surface.facets) {
        const double area = area_vector(surface.vertices, t).norm();
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3& p = surface.vertices[t[i]];
            const Vec3 u = surface.vertices[t[(i + 1) % 3]] - p, v = surface.vertices[t[(i + 2) % 3]] - p;
            at[t[i]].area += area / 3;
            at[t[i]].angle += angle_between(u, v);
        }
    }
}

// Each edge gives half of its turn, and of that each end half.
void add_edges(const SurfaceArrays& surface, std::vector<VertexCurvature>& at) {
    EdgeCorners(surface.facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            const double turn = angle_between(area_vector(surface.vertices, surface.facets[corners[i].corner / 3]),
                                              area_vector(surface.vertices, surface.facets[corners[i + 1].corner / 3]));
            const double length = (surface.vertices[corners[i].high] - surface.vertices[low]).norm();
            for (const std::int32_t v : {low, corners[i].high}) {
                if (turn > feature_turn)
                    at[v].at_feature = true;
                else if (turn > flat)
                    at[v].mean += turn * length / 4;
            }
        }
    });
}

double size_of(double curvature, const CurvatureSizes& wanted) {
    double size = std::numeric_limits<double>::infinity();
    if (wanted.chord_error > 0) size = std::min(size, std::sqrt(8 * wanted.chord_error / curvature));
    if (wanted.segments_per_turn > 0)
        size = std::min(size, 2 * std::numbers::pi / (curvature * wanted.segments_per_turn));
    return size;
}

}  // namespace

std::vector<SizedTriangle> sizes_of_edges(const SurfaceArrays& surface) {
    std::vector<SizedTriangle> sized;
    const auto& p = surface.vertices;
    for (const Triangle& t : surface.facets)
        sized.push_back(sized_facet(
            surface, t, ((p[t[0]] - p[t[1]]).norm() + (p[t[1]] - p[t[2]]).norm() + (p[t[2]] - p[t[0]]).norm()) / 3));
    return sized;
}

std::vector<SizedTriangle> sizes_on_patch(const SurfaceArrays& surface, std::int32_t patch, double size, double reach) {
    std::vector<SizedTriangle> sized;
    for (std::size_t f = 0; f < surface.facets.size(); ++f)
        if (surface.patch[f] == patch) sized.push_back(sized_facet(surface, surface.facets[f], size, reach));
    return sized;
}

std::vector<SizedTriangle> sizes_of_curvature(const SurfaceArrays& surface, const CurvatureSizes& wanted) {
    std::vector<VertexCurvature> at(surface.vertices.size());
    add_facets(surface, at);
    add_edges(surface, at);
    std::vector<SizedTriangle> sized;
    for (const Triangle& t : surface.facets) {
        const double curvature = std::max({at[t[0]].largest(), at[t[1]].largest(), at[t[2]].largest()});
        if (curvature > 0) sized.push_back(sized_facet(surface, t, size_of(curvature, wanted)));
    }
    return sized;
}

std::vector<SizedTriangle> sizes_of_thickness(const SurfaceArrays& surface, double cells_across) {
    const SizedTriangles walls(sizes_of_edges(surface));
    std::vector<SizedTriangle> sized;
    for (const Triangle& t : surface.facets) {
        const Vec3 area = area_vector(surface.vertices, t);
        const Vec3 inwards = -area.normalized();
        if (inwards == Vec3::Zero()) continue;
        const Vec3 centroid = (surface.vertices[t[0]] + surface.vertices[t[1]] + surface.vertices[t[2]]) / 3;
        const double depth = walls.first_hit(centroid, inwards, [&](const SizedTriangle& wall) {
            const Vec3 normal = doubled_area_vector(wall.corner(0), wall.corner(1), wall.corner(2));
            return normal.dot(-inwards) < facing_cosine * normal.norm();
        });
        if (depth > 0 && std::isfinite(depth)) sized.push_back(sized_facet(surface, t, depth / cells_across));
    }
    return sized;
}

}  // namespace kerf

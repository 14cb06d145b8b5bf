#include "solve/equations/inside/surface_springs.h"

#include <Eigen/Geometry>

#include "base/geometry/triangle.h"

namespace kerf {

namespace {

// Values of the shape functions of a triangle, and their slopes against the first two barycentric coordinates.
struct TriangleShapes {
    std::array<double, 6> value{}, slope_a{}, slope_b{};
};

TriangleShapes triangle_shapes(int order, const std::array<double, 3>& l) {
    constexpr std::array<double, 3> in_a = {1, 0, -1}, in_b = {0, 1, -1};
    TriangleShapes shapes;
    for (std::size_t i = 0; i < 3; ++i) {
        shapes.value[i] = order == 1 ? l[i] : l[i] * (2 * l[i] - 1);
        const double slope = order == 1 ? 1 : 4 * l[i] - 1;
        shapes.slope_a[i] = slope * in_a[i];
        shapes.slope_b[i] = slope * in_b[i];
    }
    for (std::size_t e = 0; order == 2 && e < 3; ++e) {
        const auto& [i, j] = triangle_edges[e];
        shapes.value[3 + e] = 4 * l[i] * l[j];
        shapes.slope_a[3 + e] = 4 * (in_a[i] * l[j] + l[i] * in_a[j]);
        shapes.slope_b[3 + e] = 4 * (in_b[i] * l[j] + l[i] * in_b[j]);
    }
    return shapes;
}

Eigen::Matrix3d stiffness_per_area(const Spring& spring, const Vec3& normal) {
    if (spring.normal) return *spring.normal * normal * normal.transpose();
    return spring.stiffness.asDiagonal();
}

}  // namespace

FacetStiffness spring_stiffness(const FeSpace& space, const SurfaceSprings& springs, const SurfaceSprings::Facet& facet,
                                int order) {
    FacetStiffness blocks;
    for (auto& row : blocks) row.fill(Eigen::Matrix3d::Zero());
    const auto nodes = space.nodes_of_facet(facet.part, facet.facet);
    const std::size_t count = order == 1 ? 3 : 6;
    for (const TrianglePoint& at : quadrature::six_points) {
        const TriangleShapes shapes = triangle_shapes(order, at.place);
        Vec3 along_a = Vec3::Zero(), along_b = Vec3::Zero();
        for (std::size_t n = 0; n < count; ++n) {
            along_a += shapes.slope_a[n] * space.points()[nodes[n]];
            along_b += shapes.slope_b[n] * space.points()[nodes[n]];
        }
        const Vec3 doubled = along_a.cross(along_b);
        const Eigen::Matrix3d stiffness =
            at.weight * doubled.norm() / 2 * stiffness_per_area(springs.springs[facet.spring], doubled.normalized());
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = 0; b < count; ++b) blocks[a][b] += shapes.value[a] * shapes.value[b] * stiffness;
    }
    return blocks;
}

std::vector<Vec3> spring_directions(const FeSpace& space, const SurfaceSprings& springs,
                                    const SurfaceSprings::Facet& facet) {
    const Spring& spring = springs.springs[facet.spring];
    if (spring.normal) {
        const Part& part = space.parts()[facet.part];
        return {doubled_area_vector(part.mesh.vertices, part.facets[facet.facet]).normalized()};
    }
    std::vector<Vec3> directions;
    for (int c = 0; c < 3; ++c)
        if (spring.stiffness[c] > 0) directions.push_back(Vec3::Unit(c));
    return directions;
}

}  // namespace kerf

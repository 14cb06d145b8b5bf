#include "solve/space/inside/facet_element.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/geometry/triangle.h"

namespace kerf {

namespace {

std::array<double, 6> shapes_of_facet(const BarycentricOfTriangle& place) {
    std::array<double, 6> shapes{};
    for (std::size_t i = 0; i < 3; ++i) shapes[i] = place[i] * (2 * place[i] - 1);
    for (std::size_t e = 0; e < 3; ++e) shapes[3 + e] = 4 * place[triangle_edges[e][0]] * place[triangle_edges[e][1]];
    return shapes;
}

}  // namespace

TriangleShares node_areas(double area, int order) {
    const double third = area / 3;
    if (order == 1) return {third, third, third, 0, 0, 0};
    return {0, 0, 0, third, third, third};
}

FacetElement::FacetElement(const std::array<Vec3, 3>& corners, int order) : order_(order) {
    std::copy(corners.begin(), corners.end(), nodes_.begin());
    const Vec3 doubled = doubled_area_vector(corners);
    area_ = 0.5 * doubled.norm();
    normal_ = doubled.normalized();
}

FacetElement::FacetElement(const Nodes& nodes) : FacetElement({nodes[0], nodes[1], nodes[2]}, 2) {
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [i, j] = triangle_edges[e];
        if (nodes[3 + e] != 0.5 * (nodes[i] + nodes[j])) is_curved_ = true;
    }
    if (!is_curved_) return;
    nodes_ = nodes;
    area_ = 0;
    for (const TrianglePoint& at : quadrature::six_points) area_ += at.weight * area_vector_at(at.place).norm();
}

Vec3 FacetElement::area_vector_at(const BarycentricOfTriangle& place) const {
    std::array<Vec3, 3> slopes;  // along the barycentric coordinates
    for (std::size_t i = 0; i < 3; ++i) slopes[i] = (4 * place[i] - 1) * nodes_[i];
    for (std::size_t e = 0; e < 3; ++e) {
        const auto [i, j] = triangle_edges[e];
        slopes[i] += 4 * place[j] * nodes_[3 + e];
        slopes[j] += 4 * place[i] * nodes_[3 + e];
    }
    return 0.5 * (slopes[1] - slopes[0]).cross(slopes[2] - slopes[0]);
}

template <class Load>
FacetElement::Forces FacetElement::integrate(Load load) const {
    Forces forces;
    forces.fill(Vec3::Zero());
    for (const TrianglePoint& at : quadrature::six_points) {
        const Vec3 force = at.weight * load(area_vector_at(at.place));
        const auto shapes = shapes_of_facet(at.place);
        for (std::size_t n = 0; n < forces.size(); ++n) forces[n] += shapes[n] * force;
    }
    return forces;
}

FacetElement::Forces FacetElement::forces_of_pressure(double pressure) const {
    if (!is_curved_) return forces_of_traction(-pressure * normal_);
    return integrate([&](const Vec3& area) -> Vec3 { return -pressure * area; });
}

FacetElement::Forces FacetElement::forces_of_traction(const Vec3& traction) const {
    if (is_curved_) return integrate([&](const Vec3& area) -> Vec3 { return area.norm() * traction; });
    Forces forces;
    const TriangleShares shares = node_areas(area_, order_);
    for (std::size_t n = 0; n < forces.size(); ++n) forces[n] = shares[n] * traction;
    return forces;
}

}  // namespace kerf

#include "solve/tet_element.h"

#include <Eigen/Geometry>

namespace kerf {

TetElement::TetElement(const std::array<Vec3, 4>& corners, int order) : corners_(corners), order_(order) {
    const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
    const Vec3 normal = a.cross(b);
    const double determinant = normal.dot(c);
    volume_ = determinant / 6;
    slopes_[1] = b.cross(c) / determinant;
    slopes_[2] = c.cross(a) / determinant;
    slopes_[3] = normal / determinant;
    slopes_[0] = -(slopes_[1] + slopes_[2] + slopes_[3]);
}

TetElement::Shapes TetElement::shapes_at(int order, const Barycentric& point) {
    Shapes shapes{};
    if (order == 1) {
        std::copy(point.begin(), point.end(), shapes.begin());
        return shapes;
    }
    for (std::size_t i = 0; i < 4; ++i) shapes[i] = point[i] * (2 * point[i] - 1);
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[e];
        shapes[4 + e] = 4 * point[i] * point[j];
    }
    return shapes;
}

TetElement::Gradients TetElement::gradients_at(const Barycentric& point) const {
    Gradients gradients;
    if (order_ == 1) {
        std::copy(slopes_.begin(), slopes_.end(), gradients.begin());
        return gradients;
    }
    for (std::size_t i = 0; i < 4; ++i) gradients[i] = (4 * point[i] - 1) * slopes_[i];
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[e];
        gradients[4 + e] = 4 * (point[i] * slopes_[j] + point[j] * slopes_[i]);
    }
    return gradients;
}

Vec3 TetElement::position_of(const Barycentric& point) const {
    Vec3 position = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) position += point[i] * corners_[i];
    return position;
}

Eigen::Matrix3d TetElement::gradient_of(const std::array<Vec3, most_element_nodes>& values,
                                        const Barycentric& point) const {
    const Gradients gradients = gradients_at(point);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int n = 0; n < node_count(); ++n) sum.noalias() += values[n] * gradients[n].transpose();
    return sum;
}

TetElement::Shapes TetElement::node_volumes() const {
    Shapes volumes{};
    for (std::size_t i = 0; i < 4; ++i) volumes[i] = order_ == 1 ? volume_ / 4 : -volume_ / 20;
    if (order_ == 2)
        for (std::size_t e = 4; e < 10; ++e) volumes[e] = volume_ / 5;
    return volumes;
}

void TetElement::stiffness(const Material& material, Stiffness& blocks) const {
    const double lambda = material.lambda(), mu = material.mu();
    const int nodes = node_count();
    const std::size_t points = order_ == 1 ? 1 : quadrature_points.size();
    const double weight = volume_ / static_cast<double>(points);
    for (std::size_t p = 0; p < points; ++p) {
        const Gradients gradients = gradients_at(quadrature_points[p]);
        for (int a = 0; a < nodes; ++a)
            for (int b = a; b < nodes; ++b) {
                const Vec3 &ga = gradients[a], &gb = gradients[b];
                Eigen::Matrix3d block = (weight * lambda) * ga * gb.transpose();
                block.noalias() += (weight * mu) * gb * ga.transpose();
                block.diagonal().array() += weight * mu * ga.dot(gb);
                if (p == 0)
                    blocks[a][b] = block;
                else
                    blocks[a][b] += block;
            }
    }
    for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < a; ++b) blocks[a][b] = blocks[b][a].transpose();
}

TriangleShares node_areas(double area, int order) {
    const double third = area / 3;
    if (order == 1) return {third, third, third, 0, 0, 0};
    return {0, 0, 0, third, third, third};
}

}  // namespace kerf

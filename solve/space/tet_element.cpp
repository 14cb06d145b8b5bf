// An element is an image of the tetrahedron of its corners, on which places are barycentric coordinates (Ergatoudis,
// Irons and Zienkiewicz 1968, ergatoudis1968). Gradients of shape functions on that tetrahedron follow from those of
// the barycentric coordinates (`slopes_`), which are constant. J is the matrix whose row i is the gradient of
// coordinate i of the element (`distortion()`): on a curved element gradients are multiplied by its transposed inverse,
// and volumes by its determinant. Elements are straight if nodes on edges are midpoints bit by bit, and take the
// formulas without J; others are integrated by 14 points (Walkington 2000, walkington2000). In `stiffness()` the blocks
// below the diagonal are copied from those above it.
#include "solve/space/tet_element.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace kerf {

TetElement::TetElement(const std::array<Vec3, 4>& corners, int order) : order_(order) {
    std::copy(corners.begin(), corners.end(), nodes_.begin());
    const Vec3 a = corners[1] - corners[0], b = corners[2] - corners[0], c = corners[3] - corners[0];
    const Vec3 normal = a.cross(b);
    const double determinant = normal.dot(c);
    straight_volume_ = volume_ = determinant / 6;
    slopes_[1] = b.cross(c) / determinant;
    slopes_[2] = c.cross(a) / determinant;
    slopes_[3] = normal / determinant;
    slopes_[0] = -(slopes_[1] + slopes_[2] + slopes_[3]);
}

TetElement::TetElement(const Nodes& nodes) : TetElement({nodes[0], nodes[1], nodes[2], nodes[3]}, 2) {
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[e];
        if (nodes[4 + e] != 0.5 * (nodes[i] + nodes[j])) is_curved_ = true;
    }
    if (!is_curved_) return;
    nodes_ = nodes;
    volume_ = 0;
    for (const TetPoint& at : rule()) volume_ += at.weight * straight_volume_ * stretch_at(at.place);
}

TetElement::Shapes TetElement::shapes_at(int order, const Barycentric& place) {
    Shapes shapes{};
    if (order == 1) {
        std::copy(place.begin(), place.end(), shapes.begin());
        return shapes;
    }
    for (std::size_t i = 0; i < 4; ++i) shapes[i] = place[i] * (2 * place[i] - 1);
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[e];
        shapes[4 + e] = 4 * place[i] * place[j];
    }
    return shapes;
}

Barycentric TetElement::place_of_node(int i) {
    Barycentric place{};
    if (i < 4)
        place[i] = 1;
    else
        place[tet_edges[i - 4][0]] = place[tet_edges[i - 4][1]] = 0.5;
    return place;
}

TetElement::Gradients TetElement::straight_gradients_at(const Barycentric& place) const {
    Gradients gradients;
    if (order_ == 1) {
        std::copy(slopes_.begin(), slopes_.end(), gradients.begin());
        return gradients;
    }
    for (std::size_t i = 0; i < 4; ++i) gradients[i] = (4 * place[i] - 1) * slopes_[i];
    for (std::size_t e = 0; e < 6; ++e) {
        const auto [i, j] = tet_edges[e];
        gradients[4 + e] = 4 * (place[i] * slopes_[j] + place[j] * slopes_[i]);
    }
    return gradients;
}

Eigen::Matrix3d TetElement::distortion(const Gradients& straight) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int n = 0; n < most_element_nodes; ++n) sum.noalias() += nodes_[n] * straight[n].transpose();
    return sum;
}

TetElement::Gradients TetElement::gradients_at(const Barycentric& place) const {
    Gradients gradients = straight_gradients_at(place);
    if (!is_curved_) return gradients;
    const Eigen::Matrix3d back = distortion(gradients).inverse().transpose();
    for (Vec3& gradient : gradients) gradient = back * gradient;
    return gradients;
}

TetElement::Point TetElement::point(const TetPoint& at) const {
    Point point{at.place, at.weight * straight_volume_, straight_gradients_at(at.place)};
    if (!is_curved_) return point;
    const Eigen::Matrix3d distorted = distortion(point.gradients), back = distorted.inverse().transpose();
    point.weight *= distorted.determinant();
    for (Vec3& gradient : point.gradients) gradient = back * gradient;
    return point;
}

double TetElement::stretch_at(const Barycentric& place) const {
    return is_curved_ ? distortion(straight_gradients_at(place)).determinant() : 1;
}

Vec3 TetElement::position_of(const Barycentric& place) const {
    Vec3 position = Vec3::Zero();
    if (!is_curved_) {
        for (std::size_t i = 0; i < 4; ++i) position += place[i] * nodes_[i];
        return position;
    }
    const Shapes shapes = shapes_at(2, place);
    for (int n = 0; n < most_element_nodes; ++n) position += shapes[n] * nodes_[n];
    return position;
}

std::span<const TetPoint> TetElement::rule() const {
    if (is_curved_) return quadrature::fourteen_points;
    if (order_ == 1) return quadrature::one_point;
    return quadrature::four_points;
}

Eigen::Matrix3d TetElement::gradient_of(const Nodes& values, const Barycentric& place) const {
    const Gradients gradients = gradients_at(place);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (int n = 0; n < node_count(); ++n) sum.noalias() += values[n] * gradients[n].transpose();
    return sum;
}

TetElement::Shapes TetElement::node_volumes() const {
    Shapes volumes{};
    if (is_curved_) {
        for (const TetPoint& at : rule()) {
            const double weight = at.weight * straight_volume_ * stretch_at(at.place);
            const Shapes shapes = shapes_at(2, at.place);
            for (int n = 0; n < most_element_nodes; ++n) volumes[n] += weight * shapes[n];
        }
        return volumes;
    }
    for (std::size_t i = 0; i < 4; ++i) volumes[i] = order_ == 1 ? volume_ / 4 : -volume_ / 20;
    if (order_ == 2)
        for (std::size_t e = 4; e < 10; ++e) volumes[e] = volume_ / 5;
    return volumes;
}

void TetElement::stiffness(const Material& material, Stiffness& blocks) const {
    const double lambda = material.lambda(), mu = material.mu();
    const int nodes = node_count();
    bool is_first = true;
    for (const TetPoint& at : rule()) {
        const auto [place, weight, gradients] = point(at);
        for (int a = 0; a < nodes; ++a)
            for (int b = a; b < nodes; ++b) {
                const Vec3 &ga = gradients[a], &gb = gradients[b];
                Eigen::Matrix3d block = (weight * lambda) * ga * gb.transpose();
                block.noalias() += (weight * mu) * gb * ga.transpose();
                block.diagonal().array() += weight * mu * ga.dot(gb);
                if (is_first)
                    blocks[a][b] = block;
                else
                    blocks[a][b] += block;
            }
        is_first = false;
    }
    for (int a = 0; a < nodes; ++a)
        for (int b = 0; b < a; ++b) blocks[a][b] = blocks[b][a].transpose();
}

}  // namespace kerf

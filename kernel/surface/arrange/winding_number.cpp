// A node's solid angle is the sum of its facets' integrals of n . f(r + d), f(y) = y / |y|^3, where r leads from the
// point to the centre of the node and d from there on. It is expanded in d: the dipole times f, the quadrupole times
// its first derivatives, the octupole times its second ones. These are symmetric, so that of the moments of d and n the
// symmetric parts count alone: those are forms of r, as the integrals of (n.r), (d.r)(n.r) and (d.r)^2 (n.r), and their
// traces are Laplacians of these forms.
#include "surface/arrange/winding_number.h"

#include <cmath>
#include <numbers>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

// A node is far if the point is so many of its radii from its centre.
constexpr double far_radii = 2;

// Half of the solid angle of a triangle.
double half_solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double of_a = a.norm(), of_b = b.norm(), of_c = c.norm();
    const double below = of_a * of_b * of_c + a.dot(b) * of_c + b.dot(c) * of_a + c.dot(a) * of_b;
    return std::atan2(a.dot(b.cross(c)), below);
}

using QuadraticForm = std::array<double, 6>;
using CubicForm = std::array<double, 10>;

// (a.r)(b.r)
QuadraticForm product(const Vec3& a, const Vec3& b) {
    return {a.x() * b.x(),
            a.y() * b.y(),
            a.z() * b.z(),
            a.x() * b.y() + a.y() * b.x(),
            a.y() * b.z() + a.z() * b.y(),
            a.z() * b.x() + a.x() * b.z()};
}

// (a.r) q(r)
CubicForm product(const Vec3& a, const QuadraticForm& q) {
    return {a.x() * q[0],
            a.y() * q[1],
            a.z() * q[2],
            a.x() * q[3] + a.y() * q[0],
            a.x() * q[5] + a.z() * q[0],
            a.x() * q[1] + a.y() * q[3],
            a.y() * q[4] + a.z() * q[1],
            a.x() * q[2] + a.z() * q[5],
            a.y() * q[2] + a.z() * q[4],
            a.x() * q[4] + a.y() * q[5] + a.z() * q[3]};
}

double value(const QuadraticForm& q, const Vec3& r) {
    return r.x() * (q[0] * r.x() + q[3] * r.y()) + r.y() * (q[1] * r.y() + q[4] * r.z()) +
           r.z() * (q[2] * r.z() + q[5] * r.x());
}
double value(const CubicForm& c, const Vec3& r) {
    const double x = r.x(), y = r.y(), z = r.z();
    return x * x * (c[0] * x + c[3] * y + c[4] * z) + y * y * (c[1] * y + c[5] * x + c[6] * z) +
           z * z * (c[2] * z + c[7] * x + c[8] * y) + c[9] * x * y * z;
}

double half_laplacian(const QuadraticForm& q) { return q[0] + q[1] + q[2]; }
double half_laplacian(const CubicForm& c, const Vec3& r) {
    return r.x() * (3 * c[0] + c[5] + c[7]) + r.y() * (3 * c[1] + c[3] + c[8]) + r.z() * (3 * c[2] + c[4] + c[6]);
}

template <std::size_t N>
void add_times(std::array<double, N>& sum, double times, const std::array<double, N>& form) {
    for (std::size_t i = 0; i < N; ++i) sum[i] += times * form[i];
}

}  // namespace

// The moments around a point that is `away` from their own centre, seen from there.
void WindingNumber::Node::add_moments(const Node& other, const Vec3& away) {
    add_times(octupole, 1, other.octupole);
    add_times(octupole, 2, product(away, other.quadrupole));
    add_times(octupole, 1, product(away, product(away, other.dipole)));
    add_times(quadrupole, 1, other.quadrupole);
    add_times(quadrupole, 1, product(away, other.dipole));
    dipole += other.dipole;
}

void WindingNumber::Node::add(const Node& other) {
    BoxNode::add(other);
    Node sum;
    sum.area = area + other.area;
    sum.centre = sum.area > 0 ? Vec3(centre + other.area / sum.area * (other.centre - centre)) : other.centre;
    sum.add_moments(*this, centre - sum.centre);
    sum.add_moments(other, other.centre - sum.centre);
    static_cast<BoxNode&>(sum) = *this;
    *this = sum;
}

bool WindingNumber::Node::is_far(const Vec3& point) const {
    const Vec3 reach = (centre - box.min()).cwiseMax(box.max() - centre);
    return (point - centre).squaredNorm() > far_radii * far_radii * reach.squaredNorm();
}

double WindingNumber::Node::solid_angle(const Vec3& point) const {
    const Vec3 r = centre - point;
    const double square = 1 / r.squaredNorm();
    return square * std::sqrt(square) *
           (dipole.dot(r) + half_laplacian(quadrupole) - 3 * square * value(quadrupole, r) +
            1.5 * square * (5 * square * value(octupole, r) - half_laplacian(octupole, r)));
}

WindingNumber::Node WindingNumber::node_of(const Item& item) {
    Node node;
    const Vec3 vector = area_vector(item.corners);
    node.box = box_around(item.corners);
    node.area = vector.norm();
    node.centre = (item.corners[0] + item.corners[1] + item.corners[2]) / 3;
    node.dipole = item.times * vector;
    for (const Vec3& p : item.corners) {
        const Vec3 d = p - node.centre;
        add_times(node.octupole, 1.0 / 12, product(d, product(d, node.dipole)));
    }
    return node;
}

WindingNumber::WindingNumber(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& times)
    : item_of_(facets.size()) {
    KERF_CHECK(are_in_range(facets, vertices.size()) && (times.empty() || times.size() == facets.size()));
    items_.reserve(facets.size());
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        const auto& [a, b, c] = facets[f];
        items_.push_back({{vertices[a], vertices[b], vertices[c]}, f, times.empty() ? 1 : times[f]});
    }
    const auto centre_of = [](const Item& item) -> Vec3 { return box_around(item.corners).center(); };
    const auto halve = [&](std::int32_t first, std::int32_t last) {
        const auto begin = items_.begin();
        const auto facet_of = [](const Item& item) { return item.facet; };
        return halve_by_centre(begin + first, begin + last, centre_of, facet_of) - begin;
    };
    hierarchy_ = {items_.size(), halve, [&](std::int32_t i) { return node_of(items_[i]); }};
    for (std::int32_t i = 0; i < count_of(items_); ++i) item_of_[items_[i].facet] = i;
}

double WindingNumber::beside(std::int32_t facet) const {
    const std::array<Vec3, 3>& p = items_[item_of_[facet]].corners;
    return sum((p[0] + p[1] + p[2]) / 3, facet);
}

double WindingNumber::sum(const Vec3& point, std::int32_t without) const {
    double far = 0, near = 0;
    const auto is_wanted = [&](const Node& node) {
        if (!node.is_far(point)) return true;
        far += node.solid_angle(point);
        return false;
    };
    hierarchy_.any(is_wanted, [&](std::int32_t i) {
        const Item& item = items_[i];
        if (item.facet != without && item.times != 0)
            near += item.times *
                    half_solid_angle(item.corners[0] - point, item.corners[1] - point, item.corners[2] - point);
        return false;
    });
    return (far / 2 + near) / (2 * std::numbers::pi);
}

}  // namespace kerf

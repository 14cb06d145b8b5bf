// Vertices carry unit mass (Ivanov, Andrä and Kudryavtsev 2006, ivanov2006): the inertia then follows the density of
// the mesh, and with it the work. Notation: p vertices, c centroid, I inertia = sum |p - c|^2 E - (p - c)(p - c)^T.
#include "surface/complex/mass_properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/threads.h"
#include "base/geometry/triangle.h"
#include "surface/complex/inside/principal_axes.h"

namespace kerf {

namespace {

// Six times the signed volume of the tetrahedron from the origin to each facet, summed.
class VolumeSum {
 public:
    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        using Exact = Eigen::Matrix<long double, 3, 1>;
        sum_ += a.cast<long double>().dot(Exact(b.cast<long double>()).cross(Exact(c.cast<long double>())));
    }
    double volume() const { return static_cast<double>(sum_ / 6); }

 private:
    long double sum_ = 0;
};

// The rounding error of that sum; corners are relative to the origin of the sum, as they are rounded.
class VolumeErrorSum {
 public:
    void add(const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 ab = b - a, ac = c - a, low = a.cwiseAbs(), middle = b.cwiseAbs(), high = c.cwiseAbs();
        const double far = std::sqrt(std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()}));
        const double area = ab.cross(ac).norm() / 2, move = half_ulp * far;
        swept_ += move * (area + move * (2 * (ab.norm() + ac.norm()) + 4 * move));
        products_ += low.x() * (middle.y() * high.z() + middle.z() * high.y()) +
                     low.y() * (middle.z() * high.x() + middle.x() * high.z()) +
                     low.z() * (middle.x() * high.y() + middle.y() * high.x());
        ++terms_;
    }
    double error(double volume) const {
        constexpr double own_rounding = 1.01;  // of this bound
        constexpr double half_long_ulp = std::numeric_limits<long double>::epsilon() / 2;
        const double of_products = (terms_ + 8) * half_long_ulp * products_ / 6;
        return own_rounding * (swept_ + of_products + half_ulp * std::abs(volume));
    }

 private:
    static constexpr double half_ulp = 0x1p-53;
    double swept_ = 0, products_ = 0;
    std::int64_t terms_ = 0;
};

}  // namespace

double enclosed_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    KERF_CHECK(are_in_range(facets, vertices.size()));
    if (facets.empty()) return 0;
    const Vec3& base = vertices[facets[0][0]];
    VolumeSum sum;
    for (const Triangle& t : facets) sum.add(vertices[t[0]] - base, vertices[t[1]] - base, vertices[t[2]] - base);
    return sum.volume();
}

BoundedVolume bounded_volume(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets) {
    BoundedVolume volume{enclosed_volume(vertices, facets), 0};
    if (facets.empty()) return volume;
    const Vec3& base = vertices[facets[0][0]];
    VolumeErrorSum error;
    for (const Triangle& t : facets) error.add(vertices[t[0]] - base, vertices[t[1]] - base, vertices[t[2]] - base);
    volume.error = error.error(volume.value);
    return volume;
}

double enclosed_volume(const Surface& surface) {
    if (surface.vertex_count() == 0) return 0;
    const Vec3& base = surface.point(Vertex(0));
    VolumeSum sum;
    for (const Facet f : surface.facets()) {
        const auto t = surface.corners(f);
        sum.add(surface.point(t[0]) - base, surface.point(t[1]) - base, surface.point(t[2]) - base);
    }
    return sum.volume();
}

bool is_outward(const std::vector<Vec3>& vertices, const std::vector<Triangle>& shell) {
    return enclosed_volume(vertices, shell) > 0;
}

namespace {

void find_inertia(const Surface& surface, MassProperties& m) {
    const Vec3& base = surface.point(Vertex(0));
    const double n = surface.vertex_count();
    Vec3 sum = Vec3::Zero();
    for (const Vertex v : surface.vertices()) sum += surface.point(v) - base;
    m.centroid = base + sum / n;

    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    for (const Vertex v : surface.vertices()) {
        const Vec3 r = surface.point(v) - m.centroid;
        moment += r * r.transpose();
    }
    m.inertia = moment.trace() * Eigen::Matrix3d::Identity() - moment;
    const PrincipalAxes principal = principal_axes(m.inertia);
    m.eigenvalues = principal.moments;
    m.axes = principal.axes;
}

// Calls add(a, b, c) for the corners of each facet.
template <class Add>
void for_each_facet(const Surface& surface, const Add& add) {
    for (const Facet f : surface.facets()) {
        const auto t = surface.corners(f);
        add(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
    }
}

}  // namespace

// Each sum is added up in one order by one thread.
MassProperties mass_properties(const Surface& surface) {
    MassProperties m;
    if (surface.vertex_count() == 0) return m;
    const Vec3& base = surface.point(Vertex(0));
    VolumeErrorSum error;
    const std::array<std::function<void()>, 2> sums = {
        [&] {
            for_each_facet(
                surface, [&](const Vec3& a, const Vec3& b, const Vec3& c) { error.add(a - base, b - base, c - base); });
        },
        [&] {
            VolumeSum volume;  // in the pass of the area: reaching the points costs more than all sums
            for_each_facet(surface, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
                m.area += triangle_area(a, b, c);
                volume.add(a - base, b - base, c - base);
            });
            m.volume = volume.volume();
            find_inertia(surface, m);
        }};
    const bool is_large = surface.facet_count() > 10'000;  // a thread takes as long to start as some hundred facets
    if (is_large)
        for_each_on_threads(sums.size(), [&](std::size_t i) { sums[i](); });
    else
        for (const auto& sum : sums) sum();
    m.volume_error = error.error(m.volume);
    return m;
}

}  // namespace kerf

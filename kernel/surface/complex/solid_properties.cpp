// Each facet (a, b, c) spans a tetrahedron with the origin o. Of these, with d = det[a, b, c] and s = a + b + c:
//   volume d / 6, integral of x over it d s / 24, integral of x x^T over it d (a a^T + b b^T + c c^T + s s^T) / 120.
#include "surface/complex/solid_properties.h"

#include <Eigen/Geometry>

namespace kerf {

SolidProperties solid_properties(const Complex& complex) {
    SolidProperties solid;
    if (complex.facet_count() == 0) return solid;
    const Vec3& origin = complex.point(0);
    Vec3 first = Vec3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const FacetSides sides = complex.sides(f);
        if (sides.is_wall()) continue;  // counts once for each side of it, with opposite signs
        const auto [i, j, k] = complex.vertices(f);
        const Vec3 a = complex.point(i) - origin, b = complex.point(j) - origin, c = complex.point(k) - origin;
        const Vec3 s = a + b + c;
        const double d = (sides.back.is_valid() ? 1 : -1) * a.dot(b.cross(c));
        solid.volume += d / 6;
        first += d / 24 * s;
        second += d / 120 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + s * s.transpose());
    }
    const Vec3 centre = first / solid.volume;
    second -= solid.volume * (centre * centre.transpose());
    solid.centroid = origin + centre;
    solid.inertia = second.trace() * Eigen::Matrix3d::Identity() - second;
    solid.principal = principal_axes(solid.inertia);
    return solid;
}

}  // namespace kerf

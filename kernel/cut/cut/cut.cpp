#include "cut/cut/cut.h"

#include <array>

#include <Eigen/Geometry>

#include "base/core/check.h"

namespace kerf {

Plane::Plane(const Vec3& point, const Vec3& unit_normal) : origin(point), normal(unit_normal) {
    Eigen::Index smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    u = Vec3::Unit(smallest).cross(normal).normalized();
    v = normal.cross(u);
    KERF_CHECK(is_orthonormal());
}

bool Plane::is_orthonormal() const {
    Eigen::Matrix3d axes;
    axes << u, v, normal;
    return (axes.transpose() * axes).isIdentity(1e-6) && axes.determinant() > 0;
}

Plane Plane::shifted(double distance) const {
    Plane moved = *this;
    moved.origin += distance * normal;
    return moved;
}

const char* name(ContourMethod method) {
    constexpr std::array names = {"min-cut", "edges", "straight"};
    static_assert(names.size() == static_cast<std::size_t>(ContourMethod::straight) + 1);
    return names[static_cast<std::size_t>(method)];
}

const char* name(CutStrategy strategy) {
    constexpr std::array names = {"first-try", "local-repair", "plane-step", "other-axis", "soft", "straight", "whole"};
    static_assert(names.size() == static_cast<std::size_t>(CutStrategy::whole) + 1);
    return names[static_cast<std::size_t>(strategy)];
}

const char* name(Refusal refusal) {
    constexpr std::array names = {
        "none",  "empty-side",   "flow-limit",   "pinched-contour", "crossing-projection", "nesting",
        "chord", "intersection", "not-manifold", "misplaced-shell", "coincident-vertices", "soft"};
    static_assert(names.size() == static_cast<std::size_t>(Refusal::soft) + 1);
    return names[static_cast<std::size_t>(refusal)];
}

CutSummary summary_of(const Cut& cut) {
    return {cut.plane,           cut.method,        cut.strategy,       count_of(cut.tries),
            count_of(cut.loops), cut.contour_edges, cut.contour_length, cut.max_deviation,
            cut.place,           cut.section_area,  cut.interface_area, count_of(cut.interface.triangles),
            cut.quality,         cut.seconds};
}

void describe_contour(const Surface& parent, Cut& cut) {
    for (const auto& loop : cut.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec3 &a = parent.point(loop[i]), &b = parent.point(loop[(i + 1) % loop.size()]);
            ++cut.contour_edges;
            cut.contour_length += (b - a).norm();
            cut.max_deviation = std::max(cut.max_deviation, std::abs(cut.plane.distance(a)));
        }
}

}  // namespace kerf

#include "cut/cut.h"

#include <Eigen/Geometry>

#include "core/check.h"

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
    switch (method) {
        case ContourMethod::min_cut:
            return "min-cut";
        case ContourMethod::edges:
            return "edges";
        case ContourMethod::straight:
            return "straight";
    }
    return "";
}

const char* name(Rung rung) {
    switch (rung) {
        case Rung::first_try:
            return "first-try";
        case Rung::local_repair:
            return "local-repair";
        case Rung::plane_step:
            return "plane-step";
        case Rung::other_axis:
            return "other-axis";
        case Rung::soft:
            return "soft";
        case Rung::straight:
            return "straight";
        case Rung::whole:
            return "whole";
    }
    return "";
}

const char* name(Refusal refusal) {
    switch (refusal) {
        case Refusal::none:
            return "none";
        case Refusal::empty_side:
            return "empty-side";
        case Refusal::flow_limit:
            return "flow-limit";
        case Refusal::pinched_contour:
            return "pinched-contour";
        case Refusal::crossing_projection:
            return "crossing-projection";
        case Refusal::nesting:
            return "nesting";
        case Refusal::chord:
            return "chord";
        case Refusal::intersection:
            return "intersection";
        case Refusal::not_manifold:
            return "not-manifold";
        case Refusal::misplaced_shell:
            return "misplaced-shell";
        case Refusal::coincident_vertices:
            return "coincident-vertices";
        case Refusal::soft:
            return "soft";
    }
    return "";
}

CutSummary summary_of(const Cut& cut) {
    return {cut.plane,
            cut.method,
            cut.rung,
            static_cast<std::int32_t>(cut.tries.size()),
            static_cast<std::int32_t>(cut.loops.size()),
            cut.contour_edges,
            cut.contour_length,
            cut.max_deviation,
            cut.place,
            cut.section_area,
            cut.interface_area,
            static_cast<std::int32_t>(cut.interface.triangles.size()),
            cut.quality,
            cut.seconds};
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

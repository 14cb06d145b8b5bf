#include "cut/cut.h"

#include <Eigen/Geometry>

namespace kerf {

Plane::Plane(const Vec3& point, const Vec3& unit_normal) : origin(point), normal(unit_normal) {
    Eigen::Index smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    u = Vec3::Unit(smallest).cross(normal).normalized();
    v = normal.cross(u);
}

Plane Plane::shifted(double distance) const {
    Plane moved = *this;
    moved.origin += distance * normal;
    return moved;
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
        case Refusal::soft:
            return "soft";
    }
    return "";
}

}  // namespace kerf

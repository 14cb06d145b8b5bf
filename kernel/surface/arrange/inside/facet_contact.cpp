#include "surface/arrange/inside/facet_contact.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/geometry/predicates.h"

namespace kerf {

namespace {

Vec3 flattened(int axis, const Vec3& p, double height) {
    Vec3 flat = p;
    flat[axis] = height;
    return flat;
}

// Whether all of q lies beyond an edge of p, or on its line.
bool is_apart_across_edge(const Corners& p, const Corners& q, int axis) {
    const int turn = projected_orientation(axis, p[0], p[1], p[2]);
    for (int i = 0; i < 3; ++i)
        if (std::all_of(q.begin(), q.end(),
                        [&](const Vec3& x) { return projected_orientation(axis, p[i], p[(i + 1) % 3], x) != turn; }))
            return true;
    return false;
}

}  // namespace

int projected_orientation(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
    return orientation(flattened(axis, a, 0), flattened(axis, b, 0), flattened(axis, c, 0), flattened(axis, c, 1));
}

int axis_across(const Corners& facet) {
    const Vec3 normal = (facet[1] - facet[0]).cross(facet[2] - facet[0]).cwiseAbs();
    std::array<int, 3> axes = {0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(), [&](int i, int j) { return normal[i] > normal[j]; });
    for (const int axis : axes)
        if (projected_orientation(axis, facet[0], facet[1], facet[2]) != 0) return axis;
    return -1;
}

bool has_point(const Corners& facet, int axis, const Vec3& p) {
    const int turn = projected_orientation(axis, facet[0], facet[1], facet[2]);
    for (int i = 0; i < 3; ++i)
        if (projected_orientation(axis, facet[i], facet[(i + 1) % 3], p) == -turn) return false;
    return true;
}

bool lie_in_one_plane(const Corners& p, const Corners& q, double tolerance) {
    if (std::all_of(q.begin(), q.end(), [&](const Vec3& x) { return orientation(p[0], p[1], p[2], x) == 0; }))
        return true;
    if (tolerance == 0) return false;
    const auto normal_of = [](const Corners& t) -> Vec3 { return (t[1] - t[0]).cross(t[2] - t[0]); };
    const Vec3 normal_p = normal_of(p), normal_q = normal_of(q);
    constexpr double steep = 0.5;  // the cosine
    if (!(std::abs(normal_p.dot(normal_q)) >= steep * normal_p.norm() * normal_q.norm())) return false;
    const bool is_p_larger = normal_p.squaredNorm() >= normal_q.squaredNorm();
    const Corners &large = is_p_larger ? p : q, &small = is_p_larger ? q : p;
    const Vec3 normal = (is_p_larger ? normal_p : normal_q).normalized();
    return std::all_of(small.begin(), small.end(),
                       [&](const Vec3& x) { return std::abs(normal.dot(x - large[0])) <= tolerance; });
}

bool share_area(const Corners& p, const Corners& q, int axis) {
    return !is_apart_across_edge(p, q, axis) && !is_apart_across_edge(q, p, axis);
}

}  // namespace kerf

// Pieces inside of the facet, none of them turned over, whose areas add up to its area can neither overlap nor leave a
// hole: an overlap would need a hole of the same size, and pieces that share corners leave none. Distances are compared
// with the spacing of doubles at the largest coordinate, because that is how far a vertex on an edge may be off. They
// are measured from the nearest point of an edge: the normal of a needle is off by its length over its height, so that
// a distance from the plane, measured from a far corner, would be off by as much.
#include "surface/diagnosis/facet_cover.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "base/geometry/closest_point.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

constexpr double spacings = 16;

// Returns the distance of a point from a facet with this unit normal, which is zero if the facet has no area.
double distance_from(const std::array<Vec3, 3>& facet, const Vec3& normal, const Vec3& p) {
    double from_edges = INFINITY, from_plane = 0;
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
        const Vec3 &a = facet[i], &b = facet[(i + 1) % 3];
        const Vec3 offset = p - closest_on_segment(p, a, b);
        inside = inside && normal.dot((b - a).cross(offset)) > 0;
        if (offset.norm() >= from_edges) continue;
        from_edges = offset.norm();
        from_plane = std::abs(normal.dot(offset));
    }
    return inside ? from_plane : from_edges;
}

double perimeter(const std::array<Vec3, 3>& t) {
    return (t[1] - t[0]).norm() + (t[2] - t[1]).norm() + (t[0] - t[2]).norm();
}

}  // namespace

bool covers(const std::array<Vec3, 3>& facet, std::span<const std::array<Vec3, 3>> pieces) {
    double largest = 0;
    for (const Vec3& p : facet) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    const double tolerance = spacings * std::numeric_limits<double>::epsilon() * largest;
    const Vec3 area = area_vector(facet), normal = area.normalized();
    const double area_tolerance = tolerance * perimeter(facet);
    double sum = 0;
    for (const auto& piece : pieces) {
        for (const Vec3& p : piece)
            if (distance_from(facet, normal, p) > tolerance) return false;
        const double part = normal.dot(area_vector(piece));
        if (part < -area_tolerance) return false;
        sum += part;
    }
    return std::abs(sum - area.norm()) <= area_tolerance * (pieces.size() + 1);
}

}  // namespace kerf

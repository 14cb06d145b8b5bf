// Pieces inside of the facet, none of them turned over, whose areas add up to its area can neither overlap nor leave a
// hole: an overlap would need a hole of the same size, and pieces that share corners leave none. Distances are compared
// with the spacing of doubles at the largest coordinate, because that is how far a vertex on an edge may be off.
#include "surface/facet_cover.h"

#include <algorithm>
#include <limits>

#include <Eigen/Geometry>

namespace kerf {

namespace {

constexpr double spacings = 16;

Vec3 area_vector(const std::array<Vec3, 3>& t) { return (t[1] - t[0]).cross(t[2] - t[0]) / 2; }

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
        for (const Vec3& p : piece) {
            if (std::abs(normal.dot(p - facet[0])) > tolerance) return false;
            for (int i = 0; i < 3; ++i) {
                const Vec3 edge = facet[(i + 1) % 3] - facet[i];
                if (normal.dot(edge.cross(p - facet[i])) < -tolerance * edge.norm()) return false;
            }
        }
        const double part = normal.dot(area_vector(piece));
        if (part < -area_tolerance) return false;
        sum += part;
    }
    return std::abs(sum - area.norm()) <= area_tolerance * static_cast<double>(pieces.size() + 1);
}

}  // namespace kerf

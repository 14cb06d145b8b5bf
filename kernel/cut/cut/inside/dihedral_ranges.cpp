// Seen along a contour edge, the surface leaves it in two directions, below and above, with the material between them,
// and the interface in a third, which its apex point sets. Notation: e along the edge, w across it in the sense of the
// plane's normal, u = w x e into the section; angles are measured from u towards w.
#include "cut/cut/inside/dihedral_ranges.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/angles.h"

namespace kerf {

namespace {

constexpr double steepest = 75 * std::numbers::pi / 180;  // of the interface at the contour

struct EdgeFrame {
    Vec3 origin, u, w;

    double angle(const Vec3& direction) const { return std::atan2(direction.dot(w), direction.dot(u)); }
};

EdgeFrame edge_frame(const Vec3& from, const Vec3& to, const Vec3& normal) {
    const Vec3 e = (to - from).normalized();
    const Vec3 w = (normal - normal.dot(e) * e).normalized();
    return {from, w.cross(e), w};
}

// Angles of the surface below and above; the material lies between them.
std::array<double, 2> surface_angles(const Surface& surface, const std::vector<Side>& side, std::int32_t half_edge,
                                     const EdgeFrame& frame, const Vec3& from, const Vec3& to) {
    std::array<double, 2> angle = {0, 0};
    for (const std::int32_t h : {half_edge, Surface::opposite(half_edge)}) {
        const Vec3& apex = surface.point(surface.to_vertex(surface.next(h)));
        angle[side[surface.facet_of(h)] == Side::above] = frame.angle(towards_apex(from, to, apex));
    }
    if (angle[0] > angle[1]) {  // one of them passes the far side of the edge
        if (angle[0] > -angle[1])
            angle[0] -= 2 * std::numbers::pi;
        else
            angle[1] += 2 * std::numbers::pi;
    }
    return angle;
}

}  // namespace

std::vector<HeightRange> dihedral_ranges(const Surface& surface, const Band& band, const std::vector<Side>& side,
                                         const std::vector<std::int32_t>& contour,
                                         const std::vector<Triangle>& triangles, const std::vector<Vec2>& places,
                                         double angle_deg) {
    KERF_CHECK(band.fits(surface) && fit(side, surface));
    KERF_CHECK(contour.size() <= places.size());
    const auto contour_count = static_cast<std::int32_t>(contour.size());
    const double wanted = angle_deg * std::numbers::pi / 180;
    std::vector<HeightRange> ranges(places.size());
    for (const Triangle& t : triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3], apex = t[(i + 2) % 3];
            if (a >= contour_count || b >= contour_count || apex < contour_count) continue;
            const std::int32_t h = surface.find_half_edge(contour[a], contour[b]);
            if (h < 0) continue;  // an edge across the section
            const Vec3 &from = surface.point(contour[a]), &to = surface.point(contour[b]);
            const EdgeFrame frame = edge_frame(from, to, band.plane.normal);
            auto [low, high] = surface_angles(surface, side, h, frame, from, to);
            low += wanted;
            high -= wanted;
            if (low > high) low = high = (low + high) / 2;
            const Vec3 flat = band.plane.lift(places[apex], 0) - frame.origin;
            const auto height_at = [&](double angle) {
                return (flat.dot(frame.u) * std::tan(angle) - flat.dot(frame.w)) / band.plane.normal.dot(frame.w);
            };
            HeightRange& range = ranges[apex];
            if (low > -steepest) range.low = std::max(range.low, height_at(std::min(low, steepest)));
            if (high < steepest) range.high = std::min(range.high, height_at(std::max(high, -steepest)));
        }
    return ranges;
}

}  // namespace kerf

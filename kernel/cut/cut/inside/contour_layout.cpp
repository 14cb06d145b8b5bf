// Where a contour steps up or down a steep wall along a slanted edge, its projection runs back on itself or stands
// still. The triangulation would cut off the spike by a chord, flat upon the wall or through it. Smoothed away before,
// the spike becomes a straight piece of the border, whose triangles reach into the section.
#include "cut/cut/inside/contour_layout.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "base/geometry/angles.h"

namespace kerf {

namespace {

constexpr double spike_cosine = -0.5;   // of the turn at a spike: 120 degrees and more
constexpr double corner_cosine = 0.85;  // of the turn at a corner that must not be cut off: 30 degrees
constexpr double shrunk = 0.4;          // projected length over length of an edge that is too steep
constexpr double size_in_space = 0.8;   // of the mean length of the edges
constexpr int unfolding_passes = 30;    // a run of vertical edges spreads over about so many others

// Smallest angle between the surface and the triangle that cuts off vertex v of the contour.
double ear_angle_deg(const Surface& surface, Vertex previous, Vertex v, Vertex next) {
    double smallest = 180;
    for (const auto& [from, to, apex] : {std::array{previous, v, next}, std::array{v, next, previous}}) {
        const HalfEdge h = surface.find_half_edge(from, to);
        for (const HalfEdge side : {h, Surface::opposite(h)}) {
            const Vertex facet_apex = surface.to_vertex(surface.next(side));
            smallest = std::min(smallest, dihedral_degrees(surface.point(from), surface.point(to), surface.point(apex),
                                                           surface.point(facet_apex)));
        }
    }
    return smallest;
}

class Unfolding {
 public:
    Unfolding(const Surface& surface, const std::vector<Vertex>& vertices, double good_dihedral_deg,
              ContourInPlane& contour);
    bool smooth_once();

 private:
    bool is_folded(std::int32_t i) const;
    bool is_shrunk(std::int32_t i) const;

    ContourInPlane& contour_;
    std::vector<double> length_;     // in space, of the edge to the next vertex
    std::vector<char> flat_if_cut_;  // per vertex: its ear would lie flat on the surface
};

Unfolding::Unfolding(const Surface& surface, const std::vector<Vertex>& vertices, double good_dihedral_deg,
                     ContourInPlane& contour)
    : contour_(contour) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex before = vertices[contour.previous[i]], after = vertices[contour.next[i]];
        length_.push_back((surface.point(after) - surface.point(vertices[i])).norm());
        flat_if_cut_.push_back(ear_angle_deg(surface, before, vertices[i], after) < good_dihedral_deg);
    }
}

// A spike, or a corner that must not be cut off. The section lies on the right of the loop.
bool Unfolding::is_folded(std::int32_t i) const {
    const Vec2 in = contour_.points[i] - contour_.points[contour_.previous[i]];
    const Vec2 out = contour_.points[contour_.next[i]] - contour_.points[i];
    const double cosine = in.dot(out), lengths = in.norm() * out.norm();
    const bool convex = in.x() * out.y() - in.y() * out.x() < 0;
    return cosine < spike_cosine * lengths || (flat_if_cut_[i] && convex && cosine < corner_cosine * lengths);
}

bool Unfolding::is_shrunk(std::int32_t i) const {
    return (contour_.points[contour_.next[i]] - contour_.points[i]).norm() < shrunk * length_[i];
}

// False if nothing was to be smoothed.
bool Unfolding::smooth_once() {
    std::vector<char> smoothed(contour_.points.size(), 0);
    bool any = false;
    for (std::int32_t i = 0; i < count_of(smoothed); ++i) {
        if (!is_folded(i) && !is_shrunk(i)) continue;
        any = true;
        for (const std::int32_t v : {contour_.previous[i], i, contour_.next[i]})
            smoothed[v] = smoothed[contour_.previous[v]] = smoothed[contour_.next[v]] = 1;
    }
    const std::vector<Vec2> before = contour_.points;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (smoothed[i])
            contour_.points[i] = before[i] / 2 + (before[contour_.previous[i]] + before[contour_.next[i]]) / 4;
    return any;
}

}  // namespace

ContourInPlane project_contour(const Surface& surface, const Plane& plane,
                               const std::vector<std::vector<Vertex>>& loops) {
    ContourInPlane contour;
    for (const auto& loop : loops) {
        const std::int32_t first = count_of(contour.points), n = count_of(loop);
        for (std::int32_t i = 0; i < n; ++i) {
            contour.points.push_back(plane.project(surface.point(loop[i])));
            contour.edges.push_back({first + (i + 1) % n, first + i});
            contour.next.push_back(first + (i + 1) % n);
            contour.previous.push_back(first + (i + n - 1) % n);
        }
    }
    return contour;
}

bool unfold(const Surface& surface, const std::vector<Vertex>& vertices, double good_dihedral_deg,
            ContourInPlane& contour) {
    Unfolding unfolding(surface, vertices, good_dihedral_deg, contour);
    int passes = 0;
    while (passes < unfolding_passes && unfolding.smooth_once()) ++passes;
    return passes > 0;
}

std::vector<double> sizes_in_space(const Surface& surface, const std::vector<Vertex>& vertices,
                                   const ContourInPlane& contour) {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vec3& p = surface.point(vertices[i]);
        const Vec3 &before = surface.point(vertices[contour.previous[i]]),
                   &after = surface.point(vertices[contour.next[i]]);
        sizes.push_back(size_in_space * ((before - p).norm() + (after - p).norm()) / 2);
    }
    return sizes;
}

}  // namespace kerf

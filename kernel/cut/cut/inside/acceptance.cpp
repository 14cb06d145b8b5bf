// Interface and surface are compared in the plane: triangles whose boxes overlap there and whose heights overlap, up to
// the rounding of both, are handed to the exact test. Points of the interface are numbered after the vertices of the
// surface, contour points share the number of their surface vertex, so that shared corners are recognised by number.
#include "cut/cut/inside/acceptance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/angles.h"
#include "base/geometry/closest_point.h"
#include "cut/cut/inside/planar_grid.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

class InterfaceJudge {
 public:
    /// `gap`: distances over the size of triangles up to which they are measured.
    InterfaceJudge(const Surface& surface, const Band& band, const Interface& interface, double gap);

    std::vector<Vertex> chords() const;
    std::vector<Vertex> intersections(const CancellationCheck& check_cancelled, std::vector<Collision>& collisions);
    // Quality, with the vertices below the thresholds of the options.
    InterfaceQuality measure(const CutOptions& options, std::vector<Vertex>& soft);

 private:
    struct NearFacet : SlabFacet {
        std::array<Vertex, 3> corners;
        PlanarBox box;
        std::size_t first_pair;
    };
    std::int32_t id(std::int32_t point) const {
        return point < contour_count_ ? interface_.contour[point].value() : surface_.vertex_count() + point;
    }
    Triangle ids(const Triangle& t) const { return {id(t[0]), id(t[1]), id(t[2])}; }
    std::array<Vec3, 3> corners(const Triangle& t) const {
        return {interface_.points[t[0]], interface_.points[t[1]], interface_.points[t[2]]};
    }
    std::array<Vec3, 3> facet_corners(const std::array<Vertex, 3>& t) const {
        return {surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])};
    }
    void add_contour_corners(const Triangle& t, std::vector<Vertex>& vertices) const {
        for (std::int32_t point : t)
            if (point < contour_count_) vertices.push_back(interface_.contour[point]);
    }
    void find_slab_facets();
    void find_pairs(double gap);
    // Calls visit(facet of the slab, number of an interface triangle) for those that may be near each other.
    template <class Visit>
    void for_each_pair(Visit visit) const {
        for (std::size_t f = 0; f < slab_.size(); ++f) {
            const std::size_t end = f + 1 < slab_.size() ? slab_[f + 1].first_pair : pairs_.size();
            for (std::size_t pair = slab_[f].first_pair; pair < end; ++pair) visit(slab_[f], pairs_[pair]);
        }
    }
    void measure_angles(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft) const;
    void measure_dihedrals(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft) const;
    void measure_gaps(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft);

    const Surface& surface_;
    const Band& band_;
    const Interface& interface_;
    std::int32_t contour_count_;
    std::vector<PlanarBox> boxes_;     // of the interface triangles
    std::vector<double> low_, high_;   // heights of the interface triangles
    std::vector<double> size_;         // mean edge lengths of the interface triangles
    std::vector<NearFacet> slab_;      // facets that share heights with the interface
    std::vector<std::int32_t> pairs_;  // interface triangles that may be near, facet by facet of the slab
    PlanarGrid grid_;                  // of the interface triangles
};

std::vector<PlanarBox> triangle_boxes(const Interface& interface, const Plane& plane) {
    std::vector<PlanarBox> boxes(interface.triangles.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::int32_t point : interface.triangles[i]) boxes[i].extend(plane.project(interface.points[point]));
    return boxes;
}

InterfaceJudge::InterfaceJudge(const Surface& surface, const Band& band, const Interface& interface, double gap)
    : surface_(surface),
      band_(band),
      interface_(interface),
      contour_count_(count_of(interface.contour)),
      boxes_(triangle_boxes(interface, band.plane)),
      grid_(boxes_) {
    for (const Triangle& t : interface.triangles) {
        const auto [low, high] =
            std::minmax({band.plane.distance(interface.points[t[0]]), band.plane.distance(interface.points[t[1]]),
                         band.plane.distance(interface.points[t[2]])});
        low_.push_back(low);
        high_.push_back(high);
        const auto p = corners(t);
        size_.push_back(((p[1] - p[0]).norm() + (p[2] - p[1]).norm() + (p[0] - p[2]).norm()) / 3);
    }
    find_slab_facets();
    find_pairs(gap);
}

void InterfaceJudge::find_slab_facets() {
    const double low = *std::min_element(low_.begin(), low_.end()) - band_.rounding;
    const double high = *std::max_element(high_.begin(), high_.end()) + band_.rounding;
    band_.for_each_facet_between(surface_, low, high, [&](const SlabFacet& facet) {
        const auto corners = surface_.corners(facet.facet);
        PlanarBox box;
        for (const Vertex v : corners) box.extend(band_.plane.project(surface_.point(v)));
        slab_.push_back({facet, corners, box, 0});
    });
}

void InterfaceJudge::find_pairs(double gap) {
    for (NearFacet& f : slab_) {
        f.first_pair = pairs_.size();
        const double margin = std::max(band_.rounding, gap * f.box.diagonal().norm());
        grid_.for_each_overlap(grown(f.box, margin), [&](std::int32_t i) {
            const double reach = std::max(band_.rounding, gap * size_[i]);
            if (low_[i] <= f.high + reach && high_[i] >= f.low - reach) pairs_.push_back(i);
        });
    }
}

// Contour edges appear once as directed edges of interface triangles, all others twice. An edge between contour points
// that the surface has too would get four facets.
std::vector<Vertex> InterfaceJudge::chords() const {
    std::vector<std::array<std::int32_t, 2>> between;
    for (const Triangle& t : interface_.triangles)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[i], b = t[(i + 1) % 3];
            if (a < contour_count_ && b < contour_count_) between.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(between.begin(), between.end());
    std::vector<Vertex> vertices;
    for (std::size_t i = 1; i < between.size(); ++i) {
        if (between[i] != between[i - 1]) continue;
        const Vertex a = interface_.contour[between[i][0]], b = interface_.contour[between[i][1]];
        if (surface_.find_half_edge(a, b).is_valid()) vertices.insert(vertices.end(), {a, b});
    }
    return vertices;
}

std::vector<Vertex> InterfaceJudge::intersections(const CancellationCheck& check_cancelled,
                                                  std::vector<Collision>& collisions) {
    std::vector<Vertex> vertices;
    const auto keep = [&](const std::array<Vec3, 3>& first, const std::array<Vec3, 3>& second) {
        if (collisions.size() < max_collisions) collisions.push_back({first, second});
    };
    for_each_pair([&](const NearFacet& f, std::int32_t i) {
        if (!boxes_[i].intersects(grown(f.box, band_.rounding))) return;
        if (low_[i] > f.high + band_.rounding || high_[i] < f.low - band_.rounding) return;
        const Triangle& s = interface_.triangles[i];
        const auto facet = facet_corners(f.corners);
        if (!triangles_intersect(corners(s), ids(s), facet, surface_.triangle(f.facet))) return;
        keep(corners(s), facet);
        vertices.insert(vertices.end(), f.corners.begin(), f.corners.end());
        add_contour_corners(s, vertices);
    });
    for (std::int32_t i = 0; i < count_of(boxes_); ++i) {
        check_cancelled.at(i);
        grid_.for_each_overlap(grown(boxes_[i], band_.rounding), [&](std::int32_t j) {
            if (j <= i) return;
            const Triangle &s = interface_.triangles[i], &t = interface_.triangles[j];
            if (!triangles_intersect(corners(s), ids(s), corners(t), ids(t))) return;
            keep(corners(s), corners(t));
            add_contour_corners(s, vertices);
            add_contour_corners(t, vertices);
        });
    }
    return vertices;
}

void InterfaceJudge::measure_angles(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft) const {
    for (const Triangle& t : interface_.triangles) {
        const auto p = corners(t);
        for (int i = 0; i < 3; ++i) {
            const double angle = angle_degrees(p[i], p[(i + 1) % 3], p[(i + 2) % 3]);
            quality.angle_deg = std::min(quality.angle_deg, angle);
            if (angle < threshold) add_contour_corners(t, soft);
        }
    }
}

void InterfaceJudge::measure_dihedrals(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft) const {
    for (const Triangle& t : interface_.triangles)
        for (int i = 0; i < 3; ++i) {
            if (t[i] >= contour_count_ || t[(i + 1) % 3] >= contour_count_) continue;
            const Vertex from = interface_.contour[t[i]], to = interface_.contour[t[(i + 1) % 3]];
            const HalfEdge h = surface_.find_half_edge(from, to);
            if (!h.is_valid()) continue;  // an interior edge between contour points
            const Vec3 &a = surface_.point(from), &b = surface_.point(to);
            const Vec3 inward = towards_apex(a, b, interface_.points[t[(i + 2) % 3]]);
            for (const HalfEdge side : {h, Surface::opposite(h)}) {
                const Vec3 along = towards_apex(a, b, surface_.point(surface_.to_vertex(surface_.next(side))));
                const double angle = degrees_of_cosine(inward.dot(along));
                quality.dihedral_deg = std::min(quality.dihedral_deg, angle);
                if (angle < threshold) soft.insert(soft.end(), {from, to});
            }
        }
}

// Distances off the contour: surface vertices to interface triangles and interior interface points to facets.
void InterfaceJudge::measure_gaps(double threshold, InterfaceQuality& quality, std::vector<Vertex>& soft) {
    std::vector<char> seen(band_.vertices.size(), 0);
    for (const Vertex v : interface_.contour) seen[band_.vertex_index_of[v]] = 1;
    const auto on_contour = [&](Vertex v) {
        const std::int32_t i = band_.vertex_index_of[v];
        return i >= 0 && seen[i];
    };
    for_each_pair([&](const NearFacet& f, std::int32_t i) {
        const Triangle& s = interface_.triangles[i];
        const auto triangle = corners(s), facet = facet_corners(f.corners);
        const auto note = [&](double distance) {
            quality.gap_rel = std::min(quality.gap_rel, distance / size_[i]);
            if (distance >= threshold * size_[i]) return;
            soft.insert(soft.end(), f.corners.begin(), f.corners.end());
            add_contour_corners(s, soft);
        };
        for (int k = 0; k < 3; ++k)
            if (!on_contour(f.corners[k]))
                note(point_triangle_distance(facet[k], triangle[0], triangle[1], triangle[2]));
        for (int k = 0; k < 3; ++k)
            if (s[k] >= contour_count_) note(point_triangle_distance(triangle[k], facet[0], facet[1], facet[2]));
    });
}

InterfaceQuality InterfaceJudge::measure(const CutOptions& options, std::vector<Vertex>& soft) {
    InterfaceQuality quality;
    measure_angles(options.good_angle_deg, quality, soft);
    measure_dihedrals(options.good_dihedral_deg, quality, soft);
    measure_gaps(options.good_gap_rel, quality, soft);
    return quality;
}

bool is_good(const InterfaceQuality& quality, const CutOptions& options) {
    return quality.angle_deg >= options.good_angle_deg && quality.dihedral_deg >= options.good_dihedral_deg &&
           quality.gap_rel >= options.good_gap_rel;
}

}  // namespace

Verdict judge_interface(const Surface& surface, const Band& band, const Interface& interface,
                        const CutOptions& options) {
    KERF_CHECK(band.fits(surface) && !interface.triangles.empty());
    KERF_CHECK(interface.planar.size() == interface.points.size());
    Verdict verdict;
    InterfaceJudge judge(surface, band, interface, options.good_gap_rel);
    options.check_cancelled();
    verdict.failed = judge.chords();
    if (!verdict.failed.empty()) {
        verdict.refusal = Refusal::chord;
        return verdict;
    }
    options.check_cancelled();
    verdict.failed = judge.intersections(options.check_cancelled, verdict.collisions);
    if (!verdict.collisions.empty()) {  // which may lie off the contour, and then at no vertex of the surface
        verdict.refusal = Refusal::intersection;
        return verdict;
    }
    verdict.quality = judge.measure(options, verdict.failed);
    options.check_cancelled();
    if (!is_good(verdict.quality, options)) verdict.refusal = Refusal::soft;  // at a vertex of the surface or within
    return verdict;
}

}  // namespace kerf

// Gauss-Seidel sweeps over the interior points of an interface in space; the contour stays. The measure of a triangle
// is the smallest of its angles and of its dihedral angles with the surface at contour edges, each over its threshold,
// and no more than `enough`, so that triangles that are good do not count against each other. A point moves towards the
// mean of its neighbours by 1, 1/2, 1/4 or -1/4 of the way, and takes the first step that raises the smallest measure
// around it; hence the worst measure never falls.
#include "cut/cut/inside/interface_smoothing.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "base/geometry/angles.h"

namespace kerf {

namespace {

constexpr int interface_sweeps = 10;
constexpr double enough = 1.1;  // of a threshold: better is not asked for

// The measures of all triangles are kept, so that only those around points that are tried are computed again.
class InterfaceSmoother {
 public:
    InterfaceSmoother(const Surface& surface, const CutOptions& options, Interface& interface);
    // False if no point has moved.
    bool sweep();

 private:
    bool on_contour(std::int32_t point) const { return point < count_of(interface_.contour); }
    std::span<const std::int32_t> around(std::int32_t point) const {
        return std::span(around_).subspan(first_around_[point], first_around_[point + 1] - first_around_[point]);
    }
    double measure(const Triangle& t) const;
    double measure_around(std::int32_t point);
    double worst_around(std::int32_t point) const;
    Vec3 middle_around(std::int32_t point) const;
    bool improve(std::int32_t point);

    const Surface& surface_;
    const CutOptions& options_;
    Interface& interface_;
    std::vector<std::size_t> first_around_;
    std::vector<std::int32_t> around_;  // triangles of each interior point
    std::vector<double> measures_;      // of each triangle
    std::vector<double> tried_;         // of those around a point
};

InterfaceSmoother::InterfaceSmoother(const Surface& surface, const CutOptions& options, Interface& interface)
    : surface_(surface), options_(options), interface_(interface), first_around_(interface.points.size() + 1) {
    const auto for_interior_corners = [&](auto visit) {
        for (std::int32_t i = 0; i < count_of(interface.triangles); ++i)
            for (const std::int32_t point : interface.triangles[i])
                if (!on_contour(point)) visit(point, i);
    };
    for_interior_corners([&](std::int32_t point, std::int32_t) { ++first_around_[point + 1]; });
    std::partial_sum(first_around_.begin(), first_around_.end(), first_around_.begin());
    around_.resize(first_around_.back());
    std::vector<std::size_t> next = first_around_;
    for_interior_corners([&](std::int32_t point, std::int32_t i) { around_[next[point]++] = i; });
    measures_.reserve(interface.triangles.size());
    for (const Triangle& t : interface.triangles) measures_.push_back(measure(t));
}

// Smallest angle of a triangle, and to the surface at its contour edges, over the thresholds.
double InterfaceSmoother::measure(const Triangle& t) const {
    double smallest = enough;
    for (int i = 0; i < 3; ++i) {
        const std::int32_t from = t[i], to = t[(i + 1) % 3], apex = t[(i + 2) % 3];
        const Vec3 &a = interface_.points[from], &b = interface_.points[to], &c = interface_.points[apex];
        smallest = std::min(smallest, angle_degrees(a, b, c) / options_.good_angle_deg);
        if (!on_contour(from) || !on_contour(to)) continue;
        const HalfEdge h = surface_.find_half_edge(interface_.contour[from], interface_.contour[to]);
        if (!h.is_valid()) continue;  // an edge across the section
        for (const HalfEdge side : {h, Surface::opposite(h)}) {
            const Vec3& facet_apex = surface_.point(surface_.to_vertex(surface_.next(side)));
            smallest = std::min(smallest, dihedral_degrees(a, b, c, facet_apex) / options_.good_dihedral_deg);
        }
    }
    return smallest;
}

double InterfaceSmoother::worst_around(std::int32_t point) const {
    double worst = INFINITY;
    for (const std::int32_t i : around(point)) worst = std::min(worst, measures_[i]);
    return worst;
}

// Measures the triangles around a point, into tried_, and returns the worst.
double InterfaceSmoother::measure_around(std::int32_t point) {
    tried_.clear();
    for (const std::int32_t i : around(point)) tried_.push_back(measure(interface_.triangles[i]));
    return *std::min_element(tried_.begin(), tried_.end());
}

Vec3 InterfaceSmoother::middle_around(std::int32_t point) const {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t i : around(point))
        for (const std::int32_t corner : interface_.triangles[i])
            if (corner != point) sum += interface_.points[corner];
    return sum / (2.0 * static_cast<double>(around(point).size()));
}

bool InterfaceSmoother::improve(std::int32_t point) {
    const double before = worst_around(point);
    if (before >= enough) return false;
    Vec3& place = interface_.points[point];
    const Vec3 old = place, middle = middle_around(point);
    for (const double step : {1.0, 0.5, 0.25, -0.25}) {
        place = old + step * (middle - old);
        if (measure_around(point) <= before) continue;
        std::size_t k = 0;
        for (const std::int32_t i : around(point)) measures_[i] = tried_[k++];
        return true;
    }
    place = old;
    return false;
}

bool InterfaceSmoother::sweep() {
    bool any = false;
    for (std::int32_t point = count_of(interface_.contour); point < count_of(interface_.points); ++point) {
        options_.check_cancelled.at(point);
        any |= improve(point);
    }
    return any;
}

}  // namespace

void smooth_interface(const Surface& surface, const CutOptions& options, Interface& interface) {
    InterfaceSmoother smoother(surface, options, interface);
    for (int i = 0; i < interface_sweeps && smoother.sweep(); ++i) {
    }
}

}  // namespace kerf

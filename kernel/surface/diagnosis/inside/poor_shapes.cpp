// The smallest angle lies between the two longest edges u and v, and u.v is the largest of the three such products.
// With A = |u x v|, which is the same at all corners but for rounding, the tangent of that angle is A / u.v.
#include "surface/diagnosis/inside/poor_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Geometry>

#include "base/core/threads.h"
#include "base/geometry/angles.h"

namespace kerf {

namespace {

constexpr double rounding_limit = 64;  // an edge of so many units in the last place of its coordinates is short

double shortest_length(double magnitude) { return rounding_limit * std::numeric_limits<double>::epsilon() * magnitude; }

double largest_finite_magnitude(const std::vector<Vec3>& vertices) {
    constexpr std::size_t grain = std::size_t{1} << 16;
    const auto ranges = values_of_ranges(vertices.size(), grain, [&](const IndexRange& range) {
        double largest = 0;
        for (std::size_t v = range.first; v < range.last; ++v)
            if (const double own = vertices[v].cwiseAbs().maxCoeff(); std::isfinite(own))
                largest = std::max(largest, own);
        return largest;
    });
    return ranges.empty() ? 0 : *std::max_element(ranges.begin(), ranges.end());
}

}  // namespace

PoorShapeSearch::PoorShapeSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 double needle_angle_deg)
    : vertices_(vertices), facets_(facets), needle_angle_deg_(needle_angle_deg) {
    constexpr double slack = 1.01, rounding_of_products = 1e-26;  // both far more than rounding can be
    const double tangent = needle_angle_deg < 80 ? std::tan(needle_angle_deg * std::numbers::pi / 180)
                                                 : std::numeric_limits<double>::infinity();
    needle_bound_ = slack * tangent * tangent + rounding_of_products;
    const double longest = shortest_length(largest_finite_magnitude(vertices));
    short_bound_ = slack * longest * longest + std::numeric_limits<double>::min();
}

void PoorShapeSearch::look_at(std::int32_t facet, PoorShapes& found) const {
    constexpr double least_product = 1e-140;  // the square of a smaller one may vanish
    const Triangle& t = facets_[facet];
    const std::array<Vec3, 3> p = {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
    const Vec3 u = p[1] - p[0], v = p[2] - p[1], w = p[0] - p[2];
    const std::array squares = {u.squaredNorm(), v.squaredNorm(), w.squaredNorm()};
    const double least = std::min({squares[0], squares[1], squares[2]});
    const double product = (squares[0] + squares[1] + squares[2]) / 2 - least;
    if (u.cross(v).squaredNorm() <= needle_bound_ * (product * product) || product < least_product)
        if (const double angle = smallest_angle_degrees(p); angle < needle_angle_deg_)
            found.needles.push_back({angle, facet});
    if (least > short_bound_) return;
    for (std::int32_t i = 0; i < 3; ++i) {
        const std::int32_t j = (i + 1) % 3;
        if (squares[i] > short_bound_ || t[i] > t[j]) continue;  // the facet on the other side has it
        const double magnitude = std::max(p[i].cwiseAbs().maxCoeff(), p[j].cwiseAbs().maxCoeff());
        const double length = (p[j] - p[i]).norm();
        if (length < shortest_length(magnitude)) found.short_edges.push_back({length, facet, i});
    }
}

}  // namespace kerf

// Notation: corners a, b, c, d; u, v, w = b-a, c-a, d-a; D = det[u, v, w] = 6 V. N_i is the outward normal of the face
// opposite to corner i, as long as twice the area of the face. Every formula works on differences of corners, so that a
// tetrahedron far from the origin keeps its accuracy.
//
// Two faces i, j that meet in an edge of length l enclose the dihedral angle t with
//     cot t = -(N_i . N_j) / (D l),
// because |N_i x N_j| = D l. The cotangent falls monotonically from +inf to -inf over (0, 180) degrees, so the extreme
// angles are those of the extreme cotangents, and unlike the cosine it stays accurate for the flat angles of slivers.
#include "mesh/quality.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "core/check.h"
#include "core/elements.h"
#include "core/error.h"

namespace kerf {

namespace {

// Smallest and largest of the values named, without a branch.
struct Range {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();
    void include(double value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

double degrees_from_cotangent(double cotangent) { return std::atan2(1.0, cotangent) * (180 / std::numbers::pi); }

double circumradius(const Vec3& u, const Vec3& v, const Vec3& w, double det) {
    const Vec3 centre_times_2d =
        u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v);
    return centre_times_2d.norm() / (2 * det);
}

int clamp_to_bins(double position) { return std::clamp(static_cast<int>(position), 0, Distribution::bin_count - 1); }

// Logarithms of base two from a table over the leading bits of the mantissa and the first terms of the series: with
// t = m / c - 1, c in the middle of its interval, |t| <= 1/256, the error is below t^4 / 4 ln 2 < 1e-10.
class QuickLogarithm {
 public:
    QuickLogarithm() {
        for (std::size_t i = 0; i < intervals_.size(); ++i) {
            const double centre = 1 + (static_cast<double>(i) + 0.5) / static_cast<double>(intervals_.size());
            intervals_[i] = {std::log2(centre), 1 / centre};
        }
    }
    // Of a positive normal number.
    double operator()(double value) const {
        constexpr int mantissa_bits = 52, exponent_of_one = 1023;
        const auto bits = std::bit_cast<std::uint64_t>(value);
        const std::uint64_t mantissa = bits & ((std::uint64_t{1} << mantissa_bits) - 1);
        const Interval& interval = intervals_[mantissa >> (mantissa_bits - table_bits)];
        const auto in_one_to_two = std::bit_cast<double>(mantissa | std::uint64_t{exponent_of_one} << mantissa_bits);
        const double t = in_one_to_two * interval.reciprocal - 1;
        return static_cast<double>(static_cast<int>(bits >> mantissa_bits) - exponent_of_one) + interval.logarithm +
               std::numbers::log2e * t * (1 + t * (-1.0 / 2 + t * (1.0 / 3)));
    }

 private:
    static constexpr int table_bits = 7;
    struct Interval {
        double logarithm, reciprocal;
    };
    std::array<Interval, 1 << table_bits> intervals_{};
};
const QuickLogarithm quick_log2;

}  // namespace

TetQuality tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 u = b - a, v = c - a, w = d - a;
    // Edge k of this list is the one that faces first[k] and second[k] of `normals` share.
    const std::array<double, 6> lengths = {u.norm(),       v.norm(),       w.norm(),
                                           (d - c).norm(), (d - b).norm(), (c - b).norm()};
    const std::array<Vec3, 4> normals = {(c - b).cross(d - b), w.cross(v), u.cross(w), v.cross(u)};
    constexpr std::array<int, 6> first = {2, 1, 1, 0, 0, 0}, second = {3, 3, 2, 1, 2, 3};

    const double signed_det = -u.dot(normals[1]);
    const double det = std::abs(signed_det);
    Range edge, cotangent_times_det;
    double sum_of_cubes = 0, sum_of_normals = 0;
    for (int k = 0; k < 6; ++k) {
        edge.include(lengths[k]);
        cotangent_times_det.include(-normals[first[k]].dot(normals[second[k]]) / lengths[k]);
        sum_of_cubes += lengths[k] * lengths[k] * lengths[k];
    }
    for (const Vec3& normal : normals) sum_of_normals += normal.norm();

    constexpr double infinity = std::numeric_limits<double>::infinity();
    // Two equal corners leave a rounding error in D.
    if (det == 0 || edge.min == 0) return {0, 180, infinity, infinity, 0, 0, edge.min, edge.max};
    const double inradius = det / sum_of_normals;
    return {.min_dihedral_deg = degrees_from_cotangent(cotangent_times_det.max / det),
            .max_dihedral_deg = degrees_from_cotangent(cotangent_times_det.min / det),
            .radius_edge = circumradius(u, v, w, det) / edge.min,
            .aspect = edge.max / (2 * std::sqrt(6.0) * inradius),
            .shape = 6 * std::numbers::sqrt2 * signed_det / sum_of_cubes,
            .volume = signed_det / 6,
            .min_edge = edge.min,
            .max_edge = edge.max};
}

TriangleAngles triangle_angles(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> sides = {b - a, c - b, a - c};
    const double twice_area = sides[0].cross(sides[1]).norm();
    Range edge_sq, cotangent_times_area;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        edge_sq.include(sides[i].squaredNorm());
        cotangent_times_area.include(-sides[i].dot(sides[(i + 1) % sides.size()]));
    }
    if (twice_area == 0 || edge_sq.min == 0) return {0, 180};
    return {degrees_from_cotangent(cotangent_times_area.max / twice_area),
            degrees_from_cotangent(cotangent_times_area.min / twice_area)};
}

Distribution::Distribution(Scale scale, double low, double high)
    : scale_(scale),
      low_(low),
      high_(high),
      log2_low_(low > 0 ? std::log2(low) : 0),
      bins_per_unit_(1),
      bins_(bin_count, 0) {
    KERF_CHECK(low < high && (scale == Scale::linear || low > 0));
    bins_per_unit_ = bin_count / position(high);
}

// Position of a value on the axis of the bins: bin k covers [k, k + 1).
double Distribution::position(double value) const {
    return bins_per_unit_ * (scale_ == Scale::linear ? value - low_ : std::log2(value / low_));
}

// Inverse of position().
double Distribution::value_at(double position) const {
    const double units = position / bins_per_unit_;
    return scale_ == Scale::linear ? low_ + units : low_ * std::exp2(units);
}

void Distribution::add(double value) {
    KERF_CHECK(!bins_.empty() && !std::isnan(value));
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
    ++count_;
    ++bins_[bin_of(value)];
}

int Distribution::bin_of(double value) const {
    if (!(value > low_)) return 0;
    if (value >= high_) return bin_count - 1;
    return scale_ == Scale::linear ? clamp_to_bins(position(value)) : logarithmic_bin(value);
}

// The exact logarithm, which takes twice the time, is only asked where the quick one lies so close to the edge of a bin
// that it could be wrong.
int Distribution::logarithmic_bin(double value) const {
    constexpr double doubt = 1e-6;
    if (!std::isnormal(value)) return clamp_to_bins(position(value));
    const double estimate = bins_per_unit_ * (quick_log2(value) - log2_low_);
    const double fraction = estimate - static_cast<int>(estimate);
    return clamp_to_bins(fraction < doubt || fraction > 1 - doubt ? position(value) : estimate);
}

bool Distribution::has_range_of(const Distribution& other) const {
    return scale_ == other.scale_ && low_ == other.low_ && high_ == other.high_ && bins_.size() == other.bins_.size();
}

void Distribution::add(const Distribution& other) {
    if (!has_range_of(other)) throw Error(ErrorCode::internal, "Distributions over different ranges cannot be added.");
    min_ = std::min(min_, other.min_);
    max_ = std::max(max_, other.max_);
    count_ += other.count_;
    for (int k = 0; k < bin_count; ++k) bins_[k] += other.bins_[k];
}

double Distribution::percentile(double fraction) const {
    KERF_CHECK(fraction >= 0 && fraction <= 1);
    if (fraction <= 0) return min();
    if (!count_ || fraction >= 1) return max();
    const double rank = fraction * static_cast<double>(count_);
    std::int64_t below = 0;
    for (int k = 0; k < bin_count; ++k) {
        if (!bins_[k]) continue;
        const std::int64_t upto = below + bins_[k];
        if (static_cast<double>(upto) >= rank) {
            const double part_of_bin = (rank - static_cast<double>(below)) / static_cast<double>(bins_[k]);
            return std::clamp(value_at(k + part_of_bin), min_, max_);
        }
        below = upto;
    }
    return max();
}

Distribution::Histogram Distribution::histogram(int bins) const {
    if (bins < 1 || bin_count % bins)
        throw Error(ErrorCode::internal, "A histogram of " + std::to_string(bins) + " bins does not divide " +
                                             std::to_string(bin_count) + " fine bins.");
    return histogram(0, bin_count / bins, bins);
}

Distribution::Histogram Distribution::histogram(int first, int group, int groups) const {
    KERF_CHECK(first >= 0 && group > 0 && groups >= 0 && first + group * groups <= bin_count);
    Histogram histogram;
    for (int i = 0; i <= groups; ++i) histogram.edges.push_back(value_at(first + i * group));
    for (auto bin = bins_.begin() + first; bin != bins_.begin() + first + group * groups; bin += group)
        histogram.counts.push_back(std::accumulate(bin, bin + group, std::int64_t{0}));
    return histogram;
}

QualityDistributions::QualityDistributions(double length_scale) {
    KERF_CHECK(length_scale > 0);
    using enum Distribution::Scale;
    const double volume_scale = length_scale * length_scale * length_scale;
    measures = {Distribution(linear, 0, 180),
                Distribution(linear, 0, 180),
                Distribution(logarithmic, 0.5, 1e4),
                Distribution(logarithmic, 1, 1e4),
                Distribution(linear, 0, 1),
                Distribution(logarithmic, 1e-27 * volume_scale, volume_scale),
                Distribution(logarithmic, 1e-9 * length_scale, length_scale),
                Distribution(logarithmic, 1e-9 * length_scale, length_scale)};
}

void QualityDistributions::add(const TetQuality& quality) {
    const std::array<double, quality_measures.size()> values = {
        quality.min_dihedral_deg, quality.max_dihedral_deg, quality.radius_edge, quality.aspect, quality.shape,
        quality.volume,           quality.min_edge,         quality.max_edge};
    for (std::size_t i = 0; i < values.size(); ++i) measures[i].add(values[i]);
}

void QualityDistributions::add(const QualityDistributions& other) {
    if (measures.size() != other.measures.size())
        throw Error(ErrorCode::internal, "Quality distributions without a length scale cannot be added.");
    for (std::size_t i = 0; i < measures.size(); ++i) measures[i].add(other.measures[i]);
}

TriangleDistributions::TriangleDistributions()
    : measures(triangle_measures.size(), Distribution(Distribution::Scale::linear, 0, 180)) {}

void TriangleDistributions::add(const TriangleAngles& angles) {
    measures[0].add(angles.min_deg);
    measures[1].add(angles.max_deg);
}

void TriangleDistributions::add(const TriangleDistributions& other) {
    for (std::size_t i = 0; i < measures.size(); ++i) measures[i].add(other.measures[i]);
}

void PartQuality::add(const PartQuality& other) {
    all.add(other.all);
    interface.add(other.interface);
    interior.add(other.interior);
}

PartQuality measure_quality(const TetMesh& mesh, std::span<const char> on_interface, double length_scale) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    KERF_CHECK(on_interface.empty() || on_interface.size() == mesh.vertices.size());
    PartQuality quality(length_scale);
    const std::vector<Vec3>& p = mesh.vertices;
    for (const auto& [a, b, c, d] : mesh.tets) {
        const bool touches =
            !on_interface.empty() && (on_interface[a] || on_interface[b] || on_interface[c] || on_interface[d]);
        (touches ? quality.interface : quality.interior).add(tet_quality(p[a], p[b], p[c], p[d]));
    }
    quality.all.add(quality.interface);
    quality.all.add(quality.interior);
    return quality;
}

}  // namespace kerf

// Notation: corners a, b, c, d; u, v, w = b-a, c-a, d-a; D = det[u, v, w] = 6 V. N_i is the outward normal of the face
// opposite to corner i, as long as twice the area of the face. Every formula works on differences of corners, so that a
// tetrahedron far from the origin keeps its accuracy.
//
// Two faces i, j that meet in an edge of length l enclose the dihedral angle t with
//     cot t = -(N_i . N_j) / (D l),
// because |N_i x N_j| = D l. The cotangent falls monotonically from +inf to -inf over (0, 180) degrees, so the extreme
// angles are those of the extreme cotangents, and unlike the cosine it stays accurate for the flat angles of slivers.
//
// Two cells are measured at once, in the lanes of pairs (base/geometry/vector_pair.h). All is
// arithmetic, square roots and choices, the arc tangent, too: the same numbers come out on every machine, and for a
// cell alone.
#include "fill/mesh/quality.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/error.h"
#include "base/core/quick_log2.h"
#include "base/geometry/vector_pair.h"

namespace kerf {

namespace {

Pair square_root(Pair x) {
    const Eigen::Array2d root = Eigen::Array2d(x[0], x[1]).sqrt();  // both at once
    return Pair{root[0], root[1]};
}
Pair length_of(const VectorPair& a) { return square_root(a.squared_norm()); }

// The smallest and the largest of the given values, found without a branch.
struct Range {
    Pair min = both(std::numeric_limits<double>::infinity());
    Pair max = both(-std::numeric_limits<double>::infinity());
    void include(Pair value) {
        min = smallest(min, value);
        max = largest(max, value);
    }
};

// atan(r) for |r| <= tan(pi / 8): 1 + z g(z) times r with z = r^2, g interpolated at Chebyshev's points; to 5e-18.
Pair arc_tangent_near_zero(Pair r) {
    constexpr std::array<double, 11> g = {-0.333333333333333302,  0.199999999999955207,  -0.142857142846665421,
                                          0.111111110152562924,   -0.090909045781210852, 0.0769218319076065087,
                                          -0.0666451144646021898, 0.0585814890479512384, -0.0508544969603925853,
                                          0.0392316570850836866,  -0.0191768856365890519};
    const Pair z = r * r, z_sq = z * z;
    Pair even = both(g[10]), odd = both(g[9]);  // two rows of sums that need not wait for each other
    for (std::size_t i = 8; i > 0; i -= 2) {
        even = even * z_sq + g[i];
        odd = odd * z_sq + g[i - 1];
    }
    return r + r * z * (even * z_sq + g[0] + z * odd);
}

// Returns the angle with the cotangent x / y in degrees, atan2(y, x), for y >= 0 and not both 0.
Pair degrees_from_cotangent(Pair x, Pair y) {
    constexpr double pi = std::numbers::pi, tan_of_22_5_deg = 0.41421356237309503;
    const Pair across = absolute(x), low = smallest(across, y), high = largest(across, y);
    const auto beyond = low > tan_of_22_5_deg * high;  // then it is 45 degrees and atan of the rest
    const Pair rest = (beyond ? low - high : low) / (beyond ? low + high : high);
    Pair angle = arc_tangent_near_zero(rest) + (beyond ? both(pi / 4) : both(0));
    angle = y > across ? pi / 2 - angle : angle;
    angle = x < 0 ? pi - angle : angle;
    return angle * (180 / pi);
}

Pair circumradius(const VectorPair& u, const VectorPair& v, const VectorPair& w, Pair det) {
    const VectorPair centre_times_2d =
        u.squared_norm() * v.cross(w) + v.squared_norm() * w.cross(u) + w.squared_norm() * u.cross(v);
    return length_of(centre_times_2d) / (2 * det);
}

int clamp_to_bins(double position) { return std::clamp(static_cast<int>(position), 0, Distribution::bin_count - 1); }

}  // namespace

namespace {

// Computes the measures of the cells in the lanes, in the order of TetQuality. Inlined, so that measures that the
// caller does not ask for are not computed.
[[gnu::always_inline]] inline std::array<Pair, quality_measures.size()> measure(const VectorPair& a,
                                                                                const VectorPair& b,
                                                                                const VectorPair& c,
                                                                                const VectorPair& d) {
    const VectorPair u = b - a, v = c - a, w = d - a;
    // Edge k of this list is the one that faces first[k] and second[k] of `normals` share.
    const std::array<Pair, 6> lengths = {length_of(u),     length_of(v),     length_of(w),
                                         length_of(d - c), length_of(d - b), length_of(c - b)};
    const std::array<VectorPair, 4> normals = {(c - b).cross(d - b), w.cross(v), u.cross(w), v.cross(u)};
    constexpr std::array<std::size_t, 6> first = {2, 1, 1, 0, 0, 0}, second = {3, 3, 2, 1, 2, 3};

    const Pair signed_det = -u.dot(normals[1]);
    const Pair det = absolute(signed_det);
    Range edge, cotangent_times_det;
    Pair sum_of_cubes{}, sum_of_normals{};
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        edge.include(lengths[k]);
        cotangent_times_det.include(-normals[first[k]].dot(normals[second[k]]) / lengths[k]);
        sum_of_cubes += lengths[k] * lengths[k] * lengths[k];
    }
    for (const VectorPair& normal : normals) sum_of_normals += length_of(normal);

    // Two equal corners leave a rounding error in D.
    const auto is_flat = (det == 0) | (edge.min == 0);
    const auto unless_flat = [&](Pair value, double of_flat) { return is_flat ? both(of_flat) : value; };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Pair inradius = det / sum_of_normals;
    return {unless_flat(degrees_from_cotangent(cotangent_times_det.max, det), 0),
            unless_flat(degrees_from_cotangent(cotangent_times_det.min, det), 180),
            unless_flat(circumradius(u, v, w, det) / edge.min, infinity),
            unless_flat(edge.max / (2 * std::sqrt(6.0) * inradius), infinity),
            unless_flat(6 * std::numbers::sqrt2 * signed_det / sum_of_cubes, 0),
            unless_flat(signed_det / 6, 0),
            edge.min,
            edge.max};
}

}  // namespace

TetQuality tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const auto q = measure(VectorPair(a, a), VectorPair(b, b), VectorPair(c, c), VectorPair(d, d));
    return {q[0][0], q[1][0], q[2][0], q[3][0], q[4][0], q[5][0], q[6][0], q[7][0]};
}

// Calls take(first, count, measures) for all cells, with the measures of `count` of them, from `first` on, in the
// lanes.
template <class Take>
[[gnu::always_inline]] inline void measure_in_lanes(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells,
                                                    const Take& take) {
    for (std::size_t i = 0; i < cells.size(); i += 2) {
        const std::size_t next = std::min(i + 1, cells.size() - 1);
        const Tetrahedron &s = cells[i], &t = cells[next];
        const auto corner = [&](std::size_t k) { return VectorPair(points[s[k]], points[t[k]]); };
        take(i, next - i + 1, measure(corner(0), corner(1), corner(2), corner(3)));
    }
}

void measure_min_dihedrals(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells,
                           std::span<double> degrees) {
    KERF_CHECK(cells.size() == degrees.size());
    measure_in_lanes(points, cells, [&](std::size_t first, std::size_t count, const auto& q) {
        for (std::size_t lane = 0; lane < count; ++lane) degrees[first + lane] = q[0][lane];
    });
}

void measure_cells(const std::vector<Vec3>& points, std::span<const Tetrahedron> cells, std::span<TetQuality> quality) {
    KERF_CHECK(cells.size() == quality.size());
    measure_in_lanes(points, cells, [&](std::size_t first, std::size_t count, const auto& q) {
        for (std::size_t lane = 0; lane < count; ++lane)
            quality[first + lane] = {q[0][lane], q[1][lane], q[2][lane], q[3][lane],
                                     q[4][lane], q[5][lane], q[6][lane], q[7][lane]};
    });
}

TriangleAngles triangle_angles(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> sides = {b - a, c - b, a - c};
    const double twice_area = sides[0].cross(sides[1]).norm();
    std::array<double, 3> edge_sq, cotangent_times_area;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        edge_sq[i] = sides[i].squaredNorm();
        cotangent_times_area[i] = -sides[i].dot(sides[(i + 1) % sides.size()]);
    }
    if (twice_area == 0 || *std::min_element(edge_sq.begin(), edge_sq.end()) == 0) return {0, 180};
    const auto [least, most] = std::minmax_element(cotangent_times_area.begin(), cotangent_times_area.end());
    const Pair angles = degrees_from_cotangent(Pair{*most, *least}, both(twice_area));
    return {angles[0], angles[1]};
}

// The bins are made when the first value is counted, so that messages on many parts stay small.
Distribution::Distribution(Scale scale, double low, double high)
    : scale_(scale), low_(low), high_(high), log2_low_(low > 0 ? std::log2(low) : 0), bins_per_unit_(1) {
    KERF_CHECK(low < high && (scale == Scale::linear || low > 0));
    bins_per_unit_ = bin_count / position(high);
}

// Returns the position of a value on the axis of the bins: bin k covers [k, k + 1).
double Distribution::position(double value) const {
    return bins_per_unit_ * (scale_ == Scale::linear ? value - low_ : std::log2(value / low_));
}

// Inverse of position().
double Distribution::value_at(double position) const {
    const double units = position / bins_per_unit_;
    return scale_ == Scale::linear ? low_ + units : low_ * std::exp2(units);
}

void Distribution::add(double value, std::int64_t times) {
    KERF_CHECK(!std::isnan(value) && times > 0);
    if (bins_.empty()) [[unlikely]]
        bins_.resize(bin_count);
    min_ = std::min(min_, value);
    max_ = std::max(max_, value);
    count_ += times;
    bins_[bin_of(value)] += times;
}

int Distribution::bin_of(double value) const {
    if (!(value > low_)) return 0;
    if (value >= high_) return bin_count - 1;
    return scale_ == Scale::linear ? clamp_to_bins(position(value)) : logarithmic_bin(value);
}

// The exact logarithm, which takes much longer, is only asked where the quick one lies so close to the edge of a bin
// that it could be wrong.
int Distribution::logarithmic_bin(double value) const {
    constexpr double doubt = 1e-6;
    if (!std::isnormal(value)) return clamp_to_bins(position(value));
    const double estimate = bins_per_unit_ * (quick_log2(value) - log2_low_);
    const double fraction = estimate - static_cast<int>(estimate);
    return clamp_to_bins(fraction < doubt || fraction > 1 - doubt ? position(value) : estimate);
}

bool Distribution::has_range_of(const Distribution& other) const {
    return scale_ == other.scale_ && low_ == other.low_ && high_ == other.high_;
}

void Distribution::add(const Distribution& other) {
    if (!has_range_of(other)) throw Error(ErrorCode::internal, "Distributions over different ranges cannot be added.");
    min_ = std::min(min_, other.min_);
    max_ = std::max(max_, other.max_);
    count_ += other.count_;
    bins_.resize(std::max(bins_.size(), other.bins_.size()));
    for (std::size_t k = 0; k < other.bins_.size(); ++k) bins_[k] += other.bins_[k];
}

double Distribution::percentile(double fraction) const {
    KERF_CHECK(fraction >= 0 && fraction <= 1);
    if (fraction <= 0) return min();
    if (!count_ || fraction >= 1) return max();
    const double rank = fraction * count_;
    std::int64_t below = 0;
    for (int k = 0; k < bin_count; ++k) {
        if (!bins_[k]) continue;
        const std::int64_t upto = below + bins_[k];
        if (upto >= rank) {
            const double part_of_bin = (rank - below) / bins_[k];
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
    if (bins_.empty()) {
        histogram.counts.assign(groups, 0);
        return histogram;
    }
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

ForcedDistributions::ForcedDistributions()
    : forced(Distribution::Scale::linear, 0, 180), unforced(Distribution::Scale::linear, 0, 180) {}

void ForcedDistributions::add(const ForcedDistributions& other) {
    forced.add(other.forced);
    unforced.add(other.unforced);
}

void PartQuality::add(const PartQuality& other) {
    all.add(other.all);
    interface.add(other.interface);
    interior.add(other.interior);
    angles.add(other.angles);
}

namespace {

std::vector<char> vertices_on_interfaces(const BoundaryTriangles& boundary, std::size_t vertex_count) {
    std::vector<char> on_interface(vertex_count, 0);
    for (std::size_t f = 0; f < boundary.facets.size(); ++f)
        if (boundary.is_interface[f])
            for (const std::int32_t v : boundary.facets[f]) on_interface[v] = 1;
    return on_interface;
}

}  // namespace

PartQuality measure_quality(const TetMesh& mesh, const BoundaryTriangles& boundary, double length_scale) {
    KERF_CHECK(are_in_range(mesh.tets, mesh.vertices.size()));
    const std::vector<char> on_interface = vertices_on_interfaces(boundary, mesh.vertices.size());
    ForcedCells forced(mesh.vertices, boundary);
    PartQuality quality(length_scale);
    constexpr std::size_t at_once = 256;
    std::array<TetQuality, at_once> measured;
    for (std::size_t begin = 0; begin < mesh.tets.size(); begin += at_once) {
        const std::span<const Tetrahedron> cells =
            std::span(mesh.tets).subspan(begin, std::min(at_once, mesh.tets.size() - begin));
        measure_cells(mesh.vertices, cells, std::span(measured).first(cells.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const auto& [a, b, c, d] = cells[i];
            const bool touches = on_interface[a] || on_interface[b] || on_interface[c] || on_interface[d];
            (touches ? quality.interface : quality.interior).add(measured[i]);
            const double smallest = measured[i].min_dihedral_deg;
            const bool is_forced = forced.contains(cells[i], smallest);
            (is_forced ? quality.angles.forced : quality.angles.unforced).add(smallest);
        }
    }
    quality.all.add(quality.interface);
    quality.all.add(quality.interior);
    return quality;
}

}  // namespace kerf

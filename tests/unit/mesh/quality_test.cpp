#include "fill/mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "base/core/quick_log2.h"

namespace kerf {
namespace {

using Corners = std::array<Vec3, 4>;
constexpr double deg = 180 / std::numbers::pi;

TetQuality quality_of(const Corners& p) { return tet_quality(p[0], p[1], p[2], p[3]); }

Corners regular() { return {Vec3(1, 1, 1), Vec3(-1, 1, -1), Vec3(1, -1, -1), Vec3(-1, -1, 1)}; }

class Random {
 public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Vec3 point() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
    // Positively oriented, flattened along z by the factor.
    Corners tet(double flatness = 1) {
        Corners p = {point(), point(), point(), point()};
        for (Vec3& x : p) x.z() *= flatness;
        if ((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 0) std::swap(p[0], p[1]);
        return p;
    }
    Eigen::Quaterniond rotation() {
        return Eigen::Quaterniond(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)).normalized();
    }

 private:
    std::mt19937 engine_;
};

// By the textbook: the angle between the two faces at an edge, seen along the edge.
std::array<double, 2> extreme_dihedrals(const Corners& p) {
    std::array<double, 2> extremes = {180, 0};
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            const int k = i == 0 ? (j == 1 ? 2 : 1) : 0, l = 6 - i - j - k;
            const Vec3 edge = (p[j] - p[i]).normalized();
            const Vec3 s = edge.cross(p[k] - p[i]), t = edge.cross(p[l] - p[i]);
            const double angle = std::atan2(s.cross(t).norm(), s.dot(t)) * deg;
            extremes = {std::min(extremes[0], angle), std::max(extremes[1], angle)};
        }
    return extremes;
}

void expect_same(const TetQuality& a, const TetQuality& b, double rel) {
    EXPECT_NEAR(a.min_dihedral_deg, b.min_dihedral_deg, rel * 180);
    EXPECT_NEAR(a.max_dihedral_deg, b.max_dihedral_deg, rel * 180);
    EXPECT_NEAR(a.radius_edge, b.radius_edge, rel * b.radius_edge);
    EXPECT_NEAR(a.aspect, b.aspect, rel * b.aspect);
    EXPECT_NEAR(a.shape, b.shape, rel);
    EXPECT_NEAR(a.volume, b.volume, rel * b.max_edge * b.max_edge * b.max_edge);
    EXPECT_NEAR(a.min_edge, b.min_edge, rel * b.min_edge);
    EXPECT_NEAR(a.max_edge, b.max_edge, rel * b.max_edge);
}

TEST(TetQuality, OfTheRegularTetrahedron) {
    const TetQuality q = quality_of(regular());
    EXPECT_NEAR(q.min_dihedral_deg, std::acos(1.0 / 3) * deg, 1e-12);
    EXPECT_NEAR(q.max_dihedral_deg, std::acos(1.0 / 3) * deg, 1e-12);
    EXPECT_NEAR(q.radius_edge, std::sqrt(6.0) / 4, 1e-14);
    EXPECT_NEAR(q.aspect, 1, 1e-14);
    EXPECT_NEAR(q.shape, 1, 1e-14);
    EXPECT_NEAR(q.volume, 8.0 / 3, 1e-14);
    EXPECT_NEAR(q.min_edge, std::sqrt(8.0), 1e-14);
    EXPECT_NEAR(q.max_edge, std::sqrt(8.0), 1e-14);
}

TEST(TetQuality, OfTheCornerOfACube) {
    const TetQuality q = tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
    EXPECT_NEAR(q.min_dihedral_deg, std::atan(std::numbers::sqrt2) * deg, 1e-12);
    EXPECT_NEAR(q.max_dihedral_deg, 90, 1e-12);
    EXPECT_NEAR(q.radius_edge, std::sqrt(3.0) / 2, 1e-14);
    EXPECT_NEAR(q.aspect, std::numbers::sqrt2 * (3 + std::sqrt(3.0)) / (2 * std::sqrt(6.0)), 1e-14);
    EXPECT_NEAR(q.shape, std::numbers::sqrt2 / ((3 + 6 * std::numbers::sqrt2) / 6), 1e-14);
    EXPECT_NEAR(q.volume, 1.0 / 6, 1e-16);
}

TEST(TetQuality, AnglesAreThoseOfTheDefinitionEvenInSlivers) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const Corners p = random.tet(std::pow(10, random.number(-6, 0)));
        const auto [smallest, largest] = extreme_dihedrals(p);
        const TetQuality q = quality_of(p);
        EXPECT_NEAR(q.min_dihedral_deg, smallest, 1e-8 * smallest);
        EXPECT_NEAR(180 - q.max_dihedral_deg, 180 - largest, 1e-8 * (180 - largest) + 1e-12);
    }
}

TEST(TetQuality, CircumsphereAndInsphereHoldTheirDefinitions) {
    for (unsigned seed = 1; seed <= 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Corners p = Random(seed).tet();
        Eigen::Matrix3d rows;
        Vec3 rhs;
        double area = 0;
        for (int i = 0; i < 3; ++i) {
            rows.row(i) = 2 * (p[i + 1] - p[0]).transpose();
            rhs[i] = p[i + 1].squaredNorm() - p[0].squaredNorm();
        }
        for (const auto& face : tet_faces) area += (p[face[1]] - p[face[0]]).cross(p[face[2]] - p[face[0]]).norm() / 2;
        const Vec3 centre = rows.inverse() * rhs;
        const TetQuality q = quality_of(p);
        EXPECT_NEAR(q.radius_edge * q.min_edge, (p[0] - centre).norm(), 1e-7 * (p[0] - centre).norm());
        EXPECT_NEAR(q.max_edge / (2 * std::sqrt(6.0) * q.aspect), 3 * q.volume / area, 1e-12);
    }
}

TEST(TetQuality, DoesNotDependOnPlaceScaleAndNumbering) {
    constexpr std::array<std::array<int, 4>, 3> even = {{{1, 2, 0, 3}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const Corners p = random.tet();
        const TetQuality q = quality_of(p);
        if (q.shape < 1e-3) continue;
        Corners moved = p, scaled = p;
        const Eigen::Quaterniond rotation = random.rotation();
        for (Vec3& x : moved) x = rotation * x + Vec3(1e6, -2e6, 3e6);
        for (Vec3& x : scaled) x *= 1024;
        expect_same(quality_of(moved), q, 1e-4);  // coordinates of 1e6 carry 1e-10; D divides it by the height
        for (const auto& order : even)
            expect_same(tet_quality(p[order[0]], p[order[1]], p[order[2]], p[order[3]]), q, 1e-9);
        const TetQuality large = quality_of(scaled);
        EXPECT_EQ(large.min_dihedral_deg, q.min_dihedral_deg);
        EXPECT_EQ(large.radius_edge, q.radius_edge);
        EXPECT_EQ(large.shape, q.shape);
        EXPECT_EQ(large.volume, q.volume * 1024 * 1024 * 1024);
    }
}

TEST(TetQuality, KeepsEveryDigitFarFromTheOrigin) {
    const Vec3 far(1 << 20, -(1 << 21), 1 << 22);  // whole numbers, so that the shifted corners are exact
    const Corners p = regular();
    const TetQuality near_origin = quality_of(p);
    const TetQuality shifted = tet_quality(p[0] + far, p[1] + far, p[2] + far, p[3] + far);
    EXPECT_EQ(shifted.min_dihedral_deg, near_origin.min_dihedral_deg);
    EXPECT_EQ(shifted.radius_edge, near_origin.radius_edge);
    EXPECT_EQ(shifted.volume, near_origin.volume);
}

TEST(TetQuality, OfAnInvertedTetrahedronHasNegativeVolumeAndShape) {
    const Corners p = regular();
    const TetQuality q = tet_quality(p[1], p[0], p[2], p[3]);
    EXPECT_NEAR(q.volume, -8.0 / 3, 1e-14);
    EXPECT_NEAR(q.shape, -1, 1e-14);
    EXPECT_NEAR(q.min_dihedral_deg, std::acos(1.0 / 3) * deg, 1e-12);
    EXPECT_NEAR(q.aspect, 1, 1e-14);
}

TEST(TetQuality, OfAFlatTetrahedronIsTheWorst) {
    for (const Vec3& d : {Vec3(1, 1, 0), Vec3(0.25, 0.25, 0), Vec3(2, 0, 0), Vec3(0, 0, 0)}) {
        const TetQuality q = tet_quality(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), d);
        EXPECT_EQ(q.min_dihedral_deg, 0);
        EXPECT_EQ(q.max_dihedral_deg, 180);
        EXPECT_TRUE(std::isinf(q.radius_edge) && std::isinf(q.aspect));
        EXPECT_EQ(q.shape, 0);
        EXPECT_EQ(q.volume, 0);
    }
}

TEST(TetQuality, OfATetrahedronWithTwoEqualCornersIsFlat) {
    for (unsigned seed = 1; seed <= 100; ++seed)
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                SCOPED_TRACE("seed " + std::to_string(seed));
                Corners p = Random(seed).tet();
                p[i] = p[j];
                const TetQuality q = quality_of(p);
                EXPECT_EQ(q.volume, 0);
                EXPECT_EQ(q.min_edge, 0);
                EXPECT_EQ(q.max_dihedral_deg, 180);
                EXPECT_TRUE(std::isinf(q.radius_edge));
            }
}

// However many there are at once, and whatever is beside a cell.
TEST(TetQuality, OfManyCellsIsThatOfEach) {
    for (unsigned seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        std::vector<Vec3> points;
        std::vector<Tetrahedron> cells;
        for (unsigned t = 0; t < seed; ++t) {
            const auto first = static_cast<std::int32_t>(points.size());
            const Corners p = random.tet(t % 3 == 0 ? 1e-9 : 1);
            points.insert(points.end(), p.begin(), p.end());
            cells.push_back({first, first + 1, first + 2, first + (t % 7 == 6 ? 1 : 3)});
        }
        std::vector<TetQuality> quality(cells.size());
        measure_cells(points, cells, quality);
        std::vector<double> min_dihedrals(cells.size());
        measure_min_dihedrals(points, cells, min_dihedrals);
        for (std::size_t t = 0; t < cells.size(); ++t) {
            const auto& [a, b, c, d] = cells[t];
            const TetQuality alone = tet_quality(points[a], points[b], points[c], points[d]);
            EXPECT_EQ(std::memcmp(&quality[t], &alone, sizeof alone), 0) << t;
            EXPECT_EQ(min_dihedrals[t], alone.min_dihedral_deg);
        }
    }
}

// From needles to flat triangles, each angle to the last digits but one.
TEST(TriangleAngles, AreAccurateHoweverSmallOrLarge) {
    Random random(3);
    for (int i = 0; i < 20'000; ++i) {
        const double height = std::pow(10, random.number(-12, 0)), angle = std::atan(height) * deg;
        const TriangleAngles right = triangle_angles(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, height, 0));
        EXPECT_NEAR(right.min_deg, angle, 1e-14 * angle);
        EXPECT_EQ(right.max_deg, 90);
        const TriangleAngles blunt = triangle_angles(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(-1, height, 0));
        EXPECT_NEAR(blunt.max_deg, 180 - angle, 1e-13);
    }
}

TEST(QuickLogarithm, IsThatOfTheLibrary) {
    Random random(5);
    for (int i = 0; i < 100'000; ++i) {
        const double value = std::pow(10, random.number(-300, 300));
        EXPECT_NEAR(quick_log2(value), std::log2(value), 1e-10);
    }
}

// The widest bin that a value of these tests can fall into.
double resolution(Distribution::Scale scale, double value) {
    return scale == Distribution::Scale::linear ? 180.0 / 1440 : value * (std::pow(1e4, 1.0 / 1440) - 1);
}

Distribution make(Distribution::Scale scale) {
    return scale == Distribution::Scale::linear ? Distribution(scale, 0, 180) : Distribution(scale, 1, 1e4);
}

std::vector<double> values_for(Distribution::Scale scale, Random& random, std::size_t count) {
    std::vector<double> values(count);
    for (double& value : values)
        value = scale == Distribution::Scale::linear ? random.number(0, 180) : std::pow(10, random.number(0, 4));
    return values;
}

constexpr std::array<Distribution::Scale, 2> scales = {Distribution::Scale::linear, Distribution::Scale::logarithmic};

TEST(Distribution, AValueCountsSeveralTimes) {
    Distribution one(Distribution::Scale::linear, 0, 180), all = one;
    for (int i = 0; i < 7; ++i) one.add(60);
    all.add(60, 7);
    one.add(20);
    all.add(20);
    EXPECT_EQ(all.count(), 8);
    EXPECT_EQ(to_bytes(all), to_bytes(one));
}

// Of many parts nothing is known yet, and reports of all of them are told to every rank.
TEST(Distribution, TakesNoRoomUntilItCounts) {
    for (const Distribution::Scale scale : scales) {
        const Distribution empty = make(scale);
        EXPECT_LT(to_bytes(empty).size(), 100u);
        EXPECT_EQ(empty.histogram(36).counts, std::vector<std::int64_t>(36, 0));
        Distribution counted = empty, sum = empty;
        counted.add(2.5);
        const Bytes before = to_bytes(counted);
        counted.add(empty);
        EXPECT_EQ(to_bytes(counted), before);
        sum.add(counted);
        EXPECT_EQ(to_bytes(sum), before);
        EXPECT_TRUE(from_bytes<Distribution>(to_bytes(empty)).has_range_of(counted));
        EXPECT_THROW(sum.add(Distribution(scale, 1, 2)), Error);
    }
}

TEST(Distribution, PercentilesAreThoseOfTheSortedValues) {
    for (unsigned seed = 1; seed <= 50; ++seed)
        for (const auto scale : scales) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            std::vector<double> values = values_for(scale, random, 1 + 40 * seed);
            Distribution distribution = make(scale);
            for (const double value : values) distribution.add(value);
            std::sort(values.begin(), values.end());
            EXPECT_EQ(distribution.count(), static_cast<std::int64_t>(values.size()));
            EXPECT_EQ(distribution.percentile(0), values.front());
            EXPECT_EQ(distribution.percentile(1), values.back());
            double previous = values.front();
            for (const double fraction : {0.001, 0.01, 0.05, 0.25, 0.5, 0.95, 0.999}) {
                const double rank = fraction * static_cast<double>(values.size());
                const double expected = values[static_cast<std::size_t>(std::ceil(rank)) - 1];
                const double found = distribution.percentile(fraction);
                EXPECT_NEAR(found, expected, 1.01 * resolution(scale, expected)) << fraction;
                EXPECT_GE(found, previous);
                previous = found;
            }
        }
}

TEST(Distribution, SumOverPartsIsThatOfTheWholeInAnyOrder) {
    for (unsigned seed = 1; seed <= 20; ++seed)
        for (const auto scale : scales) {
            SCOPED_TRACE("seed " + std::to_string(seed));
            Random random(seed);
            std::vector<Distribution> parts(5, make(scale));
            Distribution whole = make(scale), forward = make(scale), backward = make(scale);
            for (const double value : values_for(scale, random, 997)) {
                whole.add(value);
                parts[static_cast<std::size_t>(random.number(0, 3.999))].add(value);  // the last part stays empty
            }
            for (std::size_t i = 0; i < parts.size(); ++i) {
                forward.add(parts[i]);
                backward.add(parts[parts.size() - 1 - i]);
            }
            EXPECT_EQ(to_bytes(forward), to_bytes(whole));
            EXPECT_EQ(to_bytes(backward), to_bytes(whole));
        }
}

TEST(Distribution, HistogramCountsBetweenItsEdges) {
    for (const auto scale : scales)
        for (const int bins : {1, 36, 72, 90, 1440}) {
            SCOPED_TRACE("bins " + std::to_string(bins));
            Random random(7);
            const std::vector<double> values = values_for(scale, random, 2000);
            Distribution distribution = make(scale);
            for (const double value : values) distribution.add(value);
            const Distribution::Histogram histogram = distribution.histogram(bins);
            ASSERT_EQ(histogram.counts.size(), static_cast<std::size_t>(bins));
            ASSERT_EQ(histogram.edges.size(), histogram.counts.size() + 1);
            EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0}), 2000);
            for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
                const auto expected = std::count_if(values.begin(), values.end(), [&](double value) {
                    return histogram.edges[i] <= value && value < histogram.edges[i + 1];
                });
                EXPECT_EQ(histogram.counts[i], expected) << "bin " << i;
            }
        }
}

TEST(Distribution, CountsValuesBeyondItsRangeInTheLastBins) {
    Distribution distribution(Distribution::Scale::logarithmic, 1, 1e4);
    for (const double value : {-3.0, 0.0, 0.5, 2e4, HUGE_VAL}) distribution.add(value);
    const Distribution::Histogram histogram = distribution.histogram(36);
    EXPECT_EQ(histogram.counts.front(), 3);
    EXPECT_EQ(histogram.counts.back(), 2);
    EXPECT_EQ(distribution.min(), -3);
    EXPECT_EQ(distribution.max(), HUGE_VAL);
    EXPECT_NEAR(distribution.percentile(0.5), 1, 0.01);
}

TEST(Distribution, OfNothingIsZero) {
    const Distribution distribution(Distribution::Scale::linear, 0, 1);
    EXPECT_EQ(distribution.count(), 0);
    for (const double fraction : {0.0, 0.5, 1.0}) EXPECT_EQ(distribution.percentile(fraction), 0);
    EXPECT_EQ(distribution.min(), 0);
    EXPECT_EQ(distribution.max(), 0);
}

TEST(Distribution, RefusesOtherRangesAndUnevenBins) {
    Distribution angles(Distribution::Scale::linear, 0, 180);
    EXPECT_THROW(angles.add(Distribution(Distribution::Scale::linear, 0, 1)), Error);
    EXPECT_THROW(angles.add(Distribution()), Error);
    EXPECT_THROW(angles.histogram(7), Error);
    EXPECT_THROW(angles.histogram(0), Error);
}

TEST(QualityDistributions, HoldTheMeasuresInTheOrderOfTheirNames) {
    QualityDistributions distributions(10);
    const TetQuality q = quality_of(regular());
    distributions.add(q);
    ASSERT_EQ(distributions.measures.size(), quality_measures.size());
    const std::array<double, 8> expected = {q.min_dihedral_deg, q.max_dihedral_deg, q.radius_edge, q.aspect, q.shape,
                                            q.volume,           q.min_edge,         q.max_edge};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        SCOPED_TRACE(quality_measures[i].name);
        EXPECT_EQ(distributions.measures[i].max(), expected[i]);
        EXPECT_EQ(distributions.measures[i].count(), 1);
    }
}

TEST(QualityDistributions, ScaleWithTheBody) {
    for (const double scale : {1e-6, 1.0, 1e9}) {
        QualityDistributions distributions(scale * 4);
        Random random(11);
        for (int i = 0; i < 500; ++i) {
            Corners p = random.tet();
            for (Vec3& x : p) x *= scale;
            distributions.add(quality_of(p));
        }
        const Distribution& volume = distributions.measures[5];
        EXPECT_NEAR(volume.percentile(0.5) / (scale * scale * scale), 0.1, 0.05);
        EXPECT_EQ(volume.histogram(1440).counts.front(), 0);
        EXPECT_EQ(volume.histogram(1440).counts.back(), 0);
    }
}

TEST(PartQuality, AddsAndTravels) {
    PartQuality part(2.0), sum(2.0);
    part.all.add(quality_of(regular()));
    part.interface.add(quality_of(regular()));
    part.angles.forced.add(10);
    part.angles.unforced.add(20);
    sum.add(part);
    sum.add(from_bytes<PartQuality>(to_bytes(part)));
    EXPECT_EQ(sum.all.measures[0].count(), 2);
    EXPECT_EQ(sum.interface.measures[0].count(), 2);
    EXPECT_EQ(sum.interior.measures[0].count(), 0);
    EXPECT_EQ(sum.angles.forced.count(), 2);
    EXPECT_EQ(sum.angles.unforced.min(), 20);
    EXPECT_EQ(sum.all.measures[4].min(), part.all.measures[4].min());
}

}  // namespace
}  // namespace kerf

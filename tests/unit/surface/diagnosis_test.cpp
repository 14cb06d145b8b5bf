#include "surface/diagnosis/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "support/damage.h"
#include "support/shapes.h"

namespace kerf {
namespace {

using test::box;
using test::insert_facet;
using test::join;
using test::remove_facet;
using test::tetrahedron;
using test::translated;
using Counts = std::vector<std::pair<DefectKind, std::int64_t>>;

// The kinds that were found, in the order of the enumeration.
Counts counts(const Diagnosis& diagnosis) {
    Counts found;
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (diagnosis.counts[k] > 0) found.emplace_back(static_cast<DefectKind>(k), diagnosis.counts[k]);
    return found;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

void add_facet(Soup& soup, const Triangle& t) { insert_facet(soup, static_cast<std::int32_t>(soup.facets.size()), t); }

TEST(Diagnose, IsOrderedByKindThenFacet) {
    Soup soup = join(test::icosphere(1), test::torus(5, 1, 9, 6));
    for (const std::int32_t f : {150, 100, 40, 7}) remove_facet(soup, f);
    add_facet(soup, soup.facets[60]);
    add_facet(soup, {0, 0, 1});
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(
        counts(diagnosis),
        (Counts{{DefectKind::degenerate_facet, 1}, {DefectKind::duplicate_facet, 1}, {DefectKind::open_edge, 4}}));
    EXPECT_TRUE(std::is_sorted(diagnosis.defects.begin(), diagnosis.defects.end(), [](auto& a, auto& b) {
        return std::pair(a.kind, a.facets[0]) < std::pair(b.kind, b.facets[0]);
    }));
}

TEST(Diagnose, EmptySurface) {
    const Diagnosis diagnosis = diagnose({});
    EXPECT_EQ(counts(diagnosis), (Counts{{DefectKind::empty, 1}}));
    EXPECT_FALSE(diagnosis.clean());
    EXPECT_TRUE(contains(diagnosis.summary({}), "no facets")) << diagnosis.summary({});
}

TEST(Diagnose, NonFiniteCoordinatesHideNoOtherDefect) {
    for (double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        Soup soup = box(Vec3::Zero(), Vec3::Ones(), 3);
        soup.vertices[3].y() = bad;
        remove_facet(soup, 50);
        const Diagnosis diagnosis = diagnose(soup);
        EXPECT_EQ(counts(diagnosis), (Counts{{DefectKind::non_finite, 1}, {DefectKind::open_edge, 1}}));
        EXPECT_EQ(diagnosis.defects[0].vertices, std::vector<std::int32_t>{3});
        EXPECT_EQ(diagnosis.defects[0].facets, test::facets_with(soup, {3}));
        EXPECT_TRUE(diagnosis.defects[0].where.allFinite());
    }
}

TEST(Diagnose, CoordinatesWhoseProductsOverflowOrVanish) {
    for (const double scale : {1e-60, 1e60}) {
        Soup soup = box();
        for (Vec3& p : soup.vertices) p *= scale;
        EXPECT_EQ(diagnose(soup).count(DefectKind::absurd_magnitude), 1) << scale;
    }
    for (const double scale : {1e-40, 1e40}) {
        Soup soup = box();
        for (Vec3& p : soup.vertices) p *= scale;
        EXPECT_EQ(counts(diagnose(soup)), Counts()) << scale;
    }
}

TEST(Diagnose, FlatSurfaceInATiltedPlane) {
    Soup soup = tetrahedron();
    for (Vec3& p : soup.vertices) p = Vec3(p.x() + 2 * p.z(), p.y() - p.z(), p.x() + p.y() + p.z());
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(diagnosis.count(DefectKind::flat), 1);
    EXPECT_FALSE(diagnosis.clean());
    EXPECT_TRUE(contains(diagnosis.summary(soup), "one plane")) << diagnosis.summary(soup);
    soup.vertices[3].z() += 1e-15;
    EXPECT_EQ(diagnose(soup).count(DefectKind::flat), 0);
}

TEST(Diagnose, OpenSheetIsFlatAndHasARim) {
    Soup soup = box();
    soup.facets = {soup.facets[0], soup.facets[1]};
    soup.patch.resize(2);
    drop_unused_vertices(soup);
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(counts(diagnosis), (Counts{{DefectKind::flat, 1}, {DefectKind::open_edge, 1}}));
    EXPECT_EQ(diagnosis.defects[1].measure, 4);
}

TEST(Diagnose, TwoBoxesThatShareAnEdge) {
    Soup soup = join(box(), box(Vec3(1, 1, 0), Vec3(2, 2, 1)));
    weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(counts(diagnosis), (Counts{{DefectKind::non_manifold_edge, 1}}));
    EXPECT_EQ(diagnosis.defects[0].facets.size(), 4u);
    EXPECT_EQ(diagnosis.defects[0].where, Vec3(1, 1, 0.5));
}

TEST(Diagnose, TwoBoxesThatShareAVertexHoweverTheyAreOriented) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        Soup soup = join(box(), box(Vec3(1, 1, 1), Vec3(2, 2, 2)));
        weld_exactly(soup);
        std::mt19937 random(seed);
        for (Triangle& t : soup.facets)
            if (random() % 2) std::swap(t[1], t[2]);
        const Diagnosis diagnosis = diagnose(soup);
        EXPECT_EQ(diagnosis.count(DefectKind::non_manifold_vertex), 1);
        EXPECT_FALSE(diagnosis.clean());
        EXPECT_EQ(diagnosis.defects[0].where, Vec3(1, 1, 1));
        EXPECT_TRUE(contains(diagnosis.summary(soup), "1 non-manifold vertex, at")) << diagnosis.summary(soup);
    }
}

// Two boxes share a vertex, where a facet of one or both is missing. What stays pinched when holes are closed is named.
TEST(Diagnose, APinchedVertexIsNamedBesideOtherDefects) {
    const std::vector<Soup> boxes = {box(), box(Vec3(1, 1, 1), Vec3(2, 2, 2))};
    for (const bool first_open : {false, true})
        for (const bool second_open : {false, true}) {
            SCOPED_TRACE(testing::Message() << first_open << second_open);
            Soup soup = join(boxes[0], boxes[1]);
            weld_exactly(soup);
            const auto corner = static_cast<std::int32_t>(
                std::find(soup.vertices.begin(), soup.vertices.end(), Vec3(1, 1, 1)) - soup.vertices.begin());
            const std::vector<std::int32_t> around = test::facets_with(soup, {corner});
            if (second_open) remove_facet(soup, around.back());
            if (first_open) remove_facet(soup, around.front());
            const Diagnosis diagnosis = diagnose(soup);
            EXPECT_EQ(diagnosis.count(DefectKind::open_edge), int{first_open} + int{second_open});
            ASSERT_EQ(diagnosis.count(DefectKind::non_manifold_vertex), first_open && second_open ? 0 : 1);
            for (const Defect& defect : diagnosis.defects) {
                if (defect.kind != DefectKind::non_manifold_vertex) continue;
                EXPECT_EQ(defect.vertices, std::vector<std::int32_t>{corner});
                EXPECT_EQ(defect.facets, test::facets_with(soup, {corner}));
            }
        }
    // The ends of an edge of four facets are no defects of their own, unless a third body touches one.
    Soup edge = join(boxes[0], box(Vec3(1, 1, 0), Vec3(2, 2, 1)));
    Soup above = tetrahedron();
    for (Vec3& p : above.vertices)
        p = Vec3(1 + 0.1 * (p.x() - p.y()), 1 + 0.1 * (p.y() - p.z()), 1 + p.x() + p.y() + p.z());
    Soup third = join(edge, above);
    weld_exactly(edge);
    weld_exactly(third);
    EXPECT_EQ(diagnose(edge).count(DefectKind::non_manifold_vertex), 0);
    EXPECT_EQ(diagnose(third).count(DefectKind::non_manifold_vertex), 1);
}

TEST(Diagnose, HolesThatMeetAtAVertexAreNoPinch) {
    Soup soup = box(Vec3::Zero(), Vec3::Ones(), 4);
    const auto middle = static_cast<std::int32_t>(
        std::find(soup.vertices.begin(), soup.vertices.end(), Vec3(0.5, 0.5, 1)) - soup.vertices.begin());
    const std::vector<std::int32_t> around = test::facets_with(soup, {middle});
    ASSERT_EQ(around.size(), 6u);
    const Triangle& first = soup.facets[around.front()];
    const auto shares_the_middle_only = [&](std::int32_t f) {
        return std::count_if(first.begin(), first.end(), [&](std::int32_t v) {
                   return std::count(soup.facets[f].begin(), soup.facets[f].end(), v) > 0;
               }) == 1;
    };
    const auto other = std::find_if(around.begin(), around.end(), shares_the_middle_only);
    ASSERT_NE(other, around.end());
    remove_facet(soup, *other);
    remove_facet(soup, around.front());
    EXPECT_EQ(counts(diagnose(soup)), (Counts{{DefectKind::open_edge, 2}}));
}

// A band of n squares that is closed after half a turn.
Soup moebius_strip(int n) {
    Soup soup;
    for (int i = 0; i < n; ++i)
        for (const double s : {-0.3, 0.3}) {
            const double u = 2 * std::numbers::pi * i / n, r = 1 + s * std::cos(u / 2);
            soup.vertices.emplace_back(r * std::cos(u), r * std::sin(u), s * std::sin(u / 2));
        }
    for (std::int32_t i = 0; i < n; ++i) {
        const std::int32_t a = 2 * i, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
        soup.facets.insert(soup.facets.end(), {{a, c, d}, {a, d, a + 1}});
    }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"strip"};
    return soup;
}

TEST(Diagnose, MoebiusStripIsOneSidedAndOpen) {
    for (const int n : {8, 15, 40}) {
        SCOPED_TRACE(n);
        const Soup soup = moebius_strip(n);
        const Diagnosis diagnosis = diagnose(soup);
        EXPECT_EQ(diagnosis.count(DefectKind::one_sided), 1);
        EXPECT_EQ(diagnosis.count(DefectKind::inconsistent_orientation), 0);
        EXPECT_EQ(diagnosis.count(DefectKind::self_intersection), 0);
        std::size_t edges = 0;
        for (const Defect& defect : diagnosis.defects) {
            EXPECT_EQ(defect.severity, Severity::error);
            if (defect.kind == DefectKind::open_edge) edges += defect.facets.size();
        }
        EXPECT_EQ(edges, 2u * static_cast<std::size_t>(n));
    }
}

// A figure of eight that makes half a turn on its way around the axis: closed, and one-sided.
TEST(Diagnose, KleinBottleIsOneSidedAndMeetsItself) {
    constexpr int n = 24, m = 12;
    Soup soup;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * (j + 0.3) / m;
            const double r = 3 + std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
            soup.vertices.emplace_back(r * std::cos(u), r * std::sin(u),
                                       std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v));
        }
    const auto at = [&](int i, int j) { return i < n ? i * m + j % m : (m - j % m) % m; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j)
            soup.facets.insert(soup.facets.end(), {{at(i, j), at(i + 1, j), at(i + 1, j + 1)},
                                                   {at(i, j), at(i + 1, j + 1), at(i, j + 1)}});
    soup.patch.assign(soup.facets.size(), 0);
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(diagnosis.count(DefectKind::one_sided), 1);
    EXPECT_EQ(diagnosis.count(DefectKind::open_edge), 0);
    EXPECT_GT(diagnosis.count(DefectKind::self_intersection), 0);
}

TEST(Diagnose, ListsAtMostTenThousandSelfIntersections) {
    const Soup sphere = test::icosphere(3);  // 1280 facets, each of which meets 13 of an equal one
    EXPECT_EQ(diagnose(join(sphere, sphere)).count(DefectKind::self_intersection), 10'000);
}

TEST(Diagnose, ShellInsideOfAnotherIsAVoidByParityOrByAHolePoint) {
    Soup soup = join(box(Vec3::Zero(), Vec3::Constant(9), 2), box(Vec3::Constant(3), Vec3::Constant(6)));
    EXPECT_EQ(counts(diagnose(soup)), (Counts{{DefectKind::ambiguous_shell, 1}}));
    EXPECT_FALSE(diagnose(soup).clean());
    EXPECT_TRUE(diagnose(soup, {.voids = Voids::parity}).clean());
    soup.holes = {Vec3(4, 4, 4)};
    EXPECT_EQ(counts(diagnose(soup)), Counts());
    soup.holes = {Vec3(1, 1, 1)};
    EXPECT_FALSE(diagnose(soup).clean()) << "the point lies in the material";
}

// At 1e15, eight units in the last place are 1.
TEST(Diagnose, EdgesNearTheRoundingLimitAreShort) {
    const Soup soup = translated(box(Vec3::Zero(), Vec3(100, 100, 1)), Vec3(1e15, 0, 0));
    const Diagnosis diagnosis = diagnose(soup, {.needle_angle_deg = 0});
    EXPECT_TRUE(diagnosis.clean());
    ASSERT_EQ(counts(diagnosis), (Counts{{DefectKind::short_edge, 4}}));
    for (const Defect& defect : diagnosis.defects) {
        EXPECT_EQ(defect.severity, Severity::warning);
        EXPECT_EQ(defect.measure, 1);
        const Vec3 edge = soup.vertices[defect.vertices[1]] - soup.vertices[defect.vertices[0]];
        EXPECT_EQ(edge.cwiseAbs(), Vec3::UnitZ());
    }
    EXPECT_EQ(counts(diagnose(translated(soup, Vec3(-1e15, 0, 0)), {.needle_angle_deg = 0})), Counts());
}

TEST(Diagnose, NeedlesAreTheFacetsBelowTheAngleTheWorstFirst) {
    const Soup soup = test::prism(12, 1, 25);
    EXPECT_EQ(counts(diagnose(soup)), Counts());
    const Diagnosis diagnosis = diagnose(soup, {.needle_angle_deg = 2});
    EXPECT_TRUE(diagnosis.clean());
    EXPECT_EQ(counts(diagnosis), (Counts{{DefectKind::needle, 24}}));
    const double angle = std::atan(2 * std::sin(std::numbers::pi / 12) / 25) * 180 / std::numbers::pi;
    for (const Defect& defect : diagnosis.defects) EXPECT_NEAR(defect.measure, angle, 1e-9);
}

TEST(Diagnose, ListsTheThousandWorstNeedlesAndCountsAll) {
    Soup soup = test::icosphere(3);
    for (Vec3& p : soup.vertices) p.z() *= 1e-3;
    const Diagnosis diagnosis = diagnose(soup, {.needle_angle_deg = 61});
    EXPECT_EQ(diagnosis.count(DefectKind::needle), 1280);
    ASSERT_EQ(diagnosis.defects.size(), 1000u);
    const auto worst = std::max_element(diagnosis.defects.begin(), diagnosis.defects.end(),
                                        [](const Defect& a, const Defect& b) { return a.measure < b.measure; });
    EXPECT_LT(diagnose(soup, {.needle_angle_deg = worst->measure}).count(DefectKind::needle), 1000);
    EXPECT_GE(diagnose(soup, {.needle_angle_deg = worst->measure * 1.000001}).count(DefectKind::needle), 1000);
}

TEST(Diagnose, SummaryNamesNumberPlaceAndRemedy) {
    Soup soup = box();
    remove_facet(soup, 11);
    const std::string summary = diagnose(soup).summary(soup);
    EXPECT_TRUE(contains(summary, "1 open edge loop, at facets")) << summary;
    EXPECT_TRUE(contains(summary, "close the holes")) << summary;
    EXPECT_TRUE(contains(diagnose(box()).summary(box()), "closed, manifold")) << diagnose(box()).summary(box());
}

}  // namespace
}  // namespace kerf

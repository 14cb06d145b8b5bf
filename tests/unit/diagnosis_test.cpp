#include "surface/diagnosis.h"

#include <algorithm>
#include <limits>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

using test::box;
using test::join;
using test::tetrahedron;
using test::translated;

constexpr DefectKind all_kinds[] = {DefectKind::empty,
                                    DefectKind::non_finite,
                                    DefectKind::flat,
                                    DefectKind::degenerate_facet,
                                    DefectKind::duplicate_facet,
                                    DefectKind::open_edge,
                                    DefectKind::non_manifold_edge,
                                    DefectKind::non_manifold_vertex,
                                    DefectKind::self_intersection};

std::vector<Soup> closed_shapes() {
    return {tetrahedron(),           box(Vec3(0, 0, 0), Vec3(1, 2, 3), 3),
            test::icosphere(2),      test::uv_sphere(7, 9),
            test::torus(3, 1, 9, 6), test::nested_boxes(3, 2)};
}

void remove_facet(Soup& soup, std::size_t f) {
    soup.facets.erase(soup.facets.begin() + static_cast<std::ptrdiff_t>(f));
    soup.patch.erase(soup.patch.begin() + static_cast<std::ptrdiff_t>(f));
}

void add_facet(Soup& soup, const Triangle& t) {
    soup.facets.push_back(t);
    soup.patch.push_back(0);
}

// Expects exactly these numbers of defects; kinds that are not named must not occur.
void expect_counts(const Diagnosis& diagnosis, const std::vector<std::pair<DefectKind, std::int64_t>>& expected) {
    for (DefectKind kind : all_kinds) {
        const auto found = std::find_if(expected.begin(), expected.end(), [&](auto& e) { return e.first == kind; });
        EXPECT_EQ(diagnosis.count(kind), found == expected.end() ? 0 : found->second) << name(kind);
    }
    EXPECT_EQ(diagnosis.clean(), expected.empty());
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Diagnose, FindsNothingOnClosedSurfacesHoweverTheyAreOriented) {
    for (const Soup& shape : closed_shapes())
        for (unsigned seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            std::mt19937 random(seed);
            Soup soup = shape;
            for (Triangle& t : soup.facets)
                if (random() % 2) std::swap(t[1], t[2]);
            EXPECT_TRUE(diagnose(soup).clean()) << diagnose(soup).summary();
        }
}

TEST(Diagnose, FindsTheThreeEdgesOfEveryMissingFacet) {
    for (const Soup& shape : closed_shapes())
        for (unsigned seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(shape.patch_names.front() + ", seed " + std::to_string(seed));
            Soup soup = shape;
            const std::size_t f = std::mt19937(seed)() % soup.facets.size();
            const Triangle missing = soup.facets[f];
            remove_facet(soup, f);
            const Diagnosis diagnosis = diagnose(soup);
            expect_counts(diagnosis, {{DefectKind::open_edge, 3}});
            for (const Defect& defect : diagnosis.defects) {
                ASSERT_EQ(defect.facets.size(), 1u);
                ASSERT_EQ(defect.vertices.size(), 2u);
                for (std::int32_t v : defect.vertices)
                    EXPECT_NE(std::find(missing.begin(), missing.end(), v), missing.end());
                EXPECT_EQ(defect.where, (soup.vertices[defect.vertices[0]] + soup.vertices[defect.vertices[1]]) / 2);
            }
        }
}

TEST(Diagnose, FindsEveryDuplicateInAnyOrderOfItsVertices) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = test::icosphere(1);
        const auto f = static_cast<std::int32_t>(random() % soup.facets.size());
        Triangle copy = soup.facets[f];
        std::shuffle(copy.begin(), copy.end(), random);
        add_facet(soup, copy);
        const Diagnosis diagnosis = diagnose(soup);
        expect_counts(diagnosis, {{DefectKind::duplicate_facet, 1}, {DefectKind::non_manifold_edge, 3}});
        EXPECT_EQ(diagnosis.defects[0].facets, (std::vector<std::int32_t>{f, 80}));
    }
}

TEST(Diagnose, IsOrderedByKindThenFacet) {
    Soup soup = join(test::icosphere(1), test::torus(5, 1, 9, 6));
    for (std::size_t f : {150, 100, 40, 7}) remove_facet(soup, f);
    add_facet(soup, soup.facets[60]);
    add_facet(soup, {0, 0, 1});
    const Diagnosis diagnosis = diagnose(soup);
    expect_counts(diagnosis, {{DefectKind::degenerate_facet, 1},
                              {DefectKind::duplicate_facet, 1},
                              {DefectKind::open_edge, 12},
                              {DefectKind::non_manifold_edge, 3}});
    EXPECT_TRUE(std::is_sorted(diagnosis.defects.begin(), diagnosis.defects.end(), [](auto& a, auto& b) {
        return std::pair(a.kind, a.facets[0]) < std::pair(b.kind, b.facets[0]);
    }));
}

TEST(Diagnose, EmptySurface) {
    const Diagnosis diagnosis = diagnose({});
    expect_counts(diagnosis, {{DefectKind::empty, 1}});
    EXPECT_TRUE(contains(diagnosis.summary(), "no facets")) << diagnosis.summary();
}

TEST(Diagnose, NonFiniteCoordinatesEndTheSearch) {
    for (double bad : {std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::infinity()}) {
        Soup soup = box();
        soup.vertices[3].y() = bad;
        remove_facet(soup, 0);
        const Diagnosis diagnosis = diagnose(soup);
        expect_counts(diagnosis, {{DefectKind::non_finite, 1}});
        EXPECT_EQ(diagnosis.defects[0].vertices, std::vector<std::int32_t>{3});
        EXPECT_FALSE(diagnosis.defects[0].facets.empty());
        EXPECT_TRUE(diagnosis.defects[0].where.allFinite());
    }
}

TEST(Diagnose, FlatSurfaceInATiltedPlane) {
    Soup soup = tetrahedron();
    for (Vec3& p : soup.vertices) p = Vec3(p.x() + 2 * p.z(), p.y() - p.z(), p.x() + p.y() + p.z());
    EXPECT_EQ(diagnose(soup).count(DefectKind::flat), 1);
    soup.vertices[3].z() += 1e-15;
    EXPECT_EQ(diagnose(soup).count(DefectKind::flat), 0);
}

TEST(Diagnose, CollinearCornersAndRepeatedVertices) {
    Soup soup = box(Vec3(0, 0, 0), Vec3(1, 1, 1), {2, 1, 1});
    const auto middle = std::find(soup.vertices.begin(), soup.vertices.end(), Vec3(0.5, 0, 0));
    ASSERT_NE(middle, soup.vertices.end());
    const auto vertex = [&](const Vec3& p) {
        return static_cast<std::int32_t>(std::find(soup.vertices.begin(), soup.vertices.end(), p) -
                                         soup.vertices.begin());
    };
    const auto first = static_cast<std::int32_t>(soup.facets.size());
    add_facet(soup, {vertex(Vec3(0, 0, 0)), vertex(Vec3(1, 0, 0)), vertex(Vec3(0.5, 0, 0))});
    add_facet(soup, {4, 5, 4});
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_EQ(diagnosis.count(DefectKind::degenerate_facet), 2);
    EXPECT_EQ(diagnosis.defects[0].facets, std::vector<std::int32_t>{first});
    EXPECT_EQ(diagnosis.defects[1].facets, std::vector<std::int32_t>{first + 1});
}

TEST(Diagnose, TwoBoxesThatShareAnEdge) {
    Soup soup = join(box(), box(Vec3(1, 1, 0), Vec3(2, 2, 1)));
    weld_exactly(soup);
    const Diagnosis diagnosis = diagnose(soup);
    expect_counts(diagnosis, {{DefectKind::non_manifold_edge, 1}});
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
        expect_counts(diagnosis, {{DefectKind::non_manifold_vertex, 1}});
        EXPECT_EQ(diagnosis.defects[0].where, Vec3(1, 1, 1));
        EXPECT_TRUE(contains(diagnosis.summary(), "1 non-manifold vertex, at")) << diagnosis.summary();
    }
}

TEST(Diagnose, SelfIntersectionsOnlyOnAClosedManifold) {
    Soup soup = join(box(), translated(box(), Vec3(0.5, 0.4, 0.3)));
    const Diagnosis diagnosis = diagnose(soup);
    EXPECT_GT(diagnosis.count(DefectKind::self_intersection), 0);
    EXPECT_EQ(diagnosis.count(DefectKind::self_intersection), static_cast<std::int64_t>(diagnosis.defects.size()));
    for (const Defect& defect : diagnosis.defects) {
        EXPECT_LT(defect.facets[0], 12);
        EXPECT_GE(defect.facets[1], 12);
    }
    remove_facet(soup, 5);
    expect_counts(diagnose(soup), {{DefectKind::open_edge, 3}});
}

TEST(Diagnose, ListsAtMostAThousandSelfIntersections) {
    const Soup sphere = test::icosphere(3);
    EXPECT_EQ(diagnose(join(sphere, sphere)).count(DefectKind::self_intersection), 1000);
}

TEST(Diagnose, SummaryNamesNumberPlaceAndRemedy) {
    Soup soup = box();
    remove_facet(soup, 11);
    const Defect first = diagnose(soup).defects.front();
    const std::string summary = diagnose(soup).summary();
    EXPECT_TRUE(contains(summary, "3 open edges, the first at facet " + std::to_string(first.facets[0]))) << summary;
    EXPECT_TRUE(contains(summary, "close the holes")) << summary;
    EXPECT_TRUE(contains(diagnose(box()).summary(), "closed, manifold")) << diagnose(box()).summary();
}

}  // namespace
}  // namespace kerf

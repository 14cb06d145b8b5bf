// What is found on threads is what one finds, and what the definitions say; on surfaces of several ranges of facets.
#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "base/core/threads.h"
#include "base/geometry/union_find.h"
#include "support/damage.h"
#include "support/shapes.h"
#include "surface/complex/manifold_defects.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/diagnosis/orientation.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

void turn_over(Triangle& t) { std::swap(t[1], t[2]); }

// Vertices and facets in another order.
Soup shuffled(Soup soup, std::mt19937& random) {
    std::vector<std::int32_t> number(soup.vertices.size());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random);
    const std::vector<Vec3> vertices = soup.vertices;
    for (std::size_t v = 0; v < vertices.size(); ++v) soup.vertices[number[v]] = vertices[v];
    for (Triangle& t : soup.facets)
        for (std::int32_t& v : t) v = number[v];
    std::shuffle(soup.facets.begin(), soup.facets.end(), random);
    return soup;
}

// As files have it, and in no order.
std::vector<Soup> make_large_surfaces() {
    std::mt19937 random(5);
    Soup several = test::join(test::icosphere(6), test::translated(test::torus(3, 1, 200, 100), Vec3(0, 0, 9)));
    for (std::size_t f = 0; f < several.facets.size(); f += 1 + random() % 20'000) turn_over(several.facets[f]);
    for (int copies = 0; copies < 3; ++copies) several.facets.push_back(several.facets[random() % 100'000]);
    several.facets.erase(several.facets.begin() + 1000, several.facets.begin() + 1010);
    several.patch.resize(several.facets.size());
    const Soup whole = test::torus(3, 1, 400, 200);
    return {whole, shuffled(whole, random), several, shuffled(several, random)};
}

const std::vector<Soup>& large_surfaces() {
    static const std::vector<Soup> surfaces = make_large_surfaces();
    return surfaces;
}

class OnThreads : public testing::TestWithParam<int> {
 protected:
    OnThreads() { set_thread_limit(GetParam()); }
    ~OnThreads() override { set_thread_limit(static_cast<int>(std::thread::hardware_concurrency())); }
};
INSTANTIATE_TEST_SUITE_P(Limit, OnThreads, testing::Values(1, 2, 7));

TEST_P(OnThreads, PartnersAreThoseOfEdgesOfTwo) {
    for (const Soup& soup : large_surfaces()) {
        std::vector<std::int32_t> expected(3 * soup.facets.size(), -1);
        EdgeCorners(soup.facets).for_each_edge([&](std::int32_t, std::span<const EdgeCorners::Corner> corners) {
            if (corners.size() != 2) return;
            expected[corners[0].corner] = corners[1].corner;
            expected[corners[1].corner] = corners[0].corner;
        });
        EXPECT_TRUE(edge_partners(soup.facets) == expected);
    }
}

TEST_P(OnThreads, ShellsAreWhatPartnersConnect) {
    for (const Soup& soup : large_surfaces()) {
        const std::vector<std::int32_t> partner = edge_partners(soup.facets);
        UnionFind sets(soup.facets.size());
        for (std::size_t c = 0; c < partner.size(); ++c)
            if (partner[c] >= 0) sets.join(static_cast<std::int32_t>(c / 3), partner[c] / 3);
        const Components expected = sets.take();
        const FacetShells shells = find_facet_shells(soup.facets, partner);
        EXPECT_EQ(shells.shell_count, expected.count);
        EXPECT_TRUE(shells.shell == expected.of);
        EXPECT_TRUE(shells.contradictions.empty());

        std::vector<Triangle> facets = soup.facets;  // all agree now, and each that is turned is a minority
        turn_facets(facets, shells.turned);
        EXPECT_TRUE(find_facet_shells(facets, edge_partners(facets)).turned.empty());
        const std::vector<std::int32_t> some = {7, 5000, 70'000};
        turn_facets(facets, some);
        const FacetShells again = find_facet_shells(facets, edge_partners(facets));
        EXPECT_TRUE(again.turned == some);
        EXPECT_TRUE(again.shell == expected.of);
    }
}

TEST_P(OnThreads, BoxesInABoxHaveTheirPlaces) {
    Soup soup = test::box(Vec3(-1, -1, -1), Vec3(8, 8, 8), 30);
    for (int i = 0; i < 343; ++i) {
        const Vec3 low(i % 7, i / 7 % 7, i / 49);
        Soup box = test::box(low, low + Vec3(0.8, 0.8, 0.8), 1 + i % 5);
        if (i % 3 == 0)
            box = test::join(test::inside_out(box), test::box(low + Vec3(.2, .2, .2), low + Vec3(.6, .6, .6), 1));
        soup = test::join(soup, i % 2 ? test::inside_out(box) : box);
    }
    const ConsistentFacets consistent = make_consistent(soup.facets);
    const std::vector<ShellPlace> places = locate_shells(soup.vertices, consistent);
    ASSERT_EQ(places.size(), 1U + 343 + 115);
    std::size_t shell = 1;
    for (int i = 0; i < 343; ++i) {
        const auto own = static_cast<std::int32_t>(shell);
        EXPECT_EQ(places[shell].parent, 0);
        EXPECT_EQ(places[shell].depth, 1);
        EXPECT_EQ(places[shell++].outward, (i % 3 == 0) == (i % 2 == 1));
        if (i % 3 > 0) continue;
        EXPECT_EQ(places[shell].parent, own);
        EXPECT_EQ(places[shell].depth, 2);
        EXPECT_EQ(places[shell++].outward, i % 2 == 0);
    }
}

std::string text_of(const Diagnosis& diagnosis, const Soup& soup) {
    std::string text;
    for (const Defect& defect : diagnosis.defects) {
        text += std::string(name(defect.kind)) + ' ' + name(defect.severity) + ' ' + place(defect, soup);
        text += testing::PrintToString(defect.facets) + testing::PrintToString(defect.vertices);
        text += ' ' + std::to_string(defect.measure) + '\n';
    }
    return text;
}

TEST_P(OnThreads, DiagnosisIsThatOfOne) {
    std::string all;
    for (const test::Damage& damage : test::all_damages())
        for (unsigned seed = 1; seed <= 3; ++seed) {
            std::mt19937 random(seed);
            const Soup soup = damage.apply(test::on_a_grid(test::icosphere(3)), random).soup;
            const std::string own = text_of(diagnose(soup), soup);
            set_thread_limit(1);
            EXPECT_EQ(own, text_of(diagnose(soup), soup)) << damage.name;
            set_thread_limit(GetParam());
            all += own;
        }
    EXPECT_FALSE(all.empty());
}

TEST_P(OnThreads, OrientationOfADiagnosisIsThatOfOrient) {
    int known = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = test::nested_boxes(1 + static_cast<int>(seed % 4), 2);
        soup = test::join(soup, test::translated(test::torus(3, 1, 12, 8), Vec3(50, 0, 0)));
        const unsigned share = 2 + random() % 30;
        for (Triangle& t : soup.facets)
            if (random() % share == 0) turn_over(t);
        if (seed % 5 == 0) soup = test::inside_out(soup);
        const Diagnosis diagnosis = diagnose(soup, {Voids::parity, 1});
        ASSERT_TRUE(diagnosis.orientation);
        Soup expected = soup;
        const OrientationReport report = orient(expected);
        turn_facets(soup.facets, diagnosis.orientation->turned);
        EXPECT_TRUE(soup.facets == expected.facets);
        EXPECT_EQ(diagnosis.orientation->report.facets_flipped, report.facets_flipped);
        EXPECT_EQ(diagnosis.orientation->report.shells_flipped, report.shells_flipped);
        EXPECT_EQ(diagnosis.orientation->report.shells, report.shells);
        known += report.shells_flipped > 0;
    }
    EXPECT_GT(known, 5);
}

TEST(ManifoldDefects, AreThoseOfTheDefinition) {
    using Kind = ManifoldDefect::Kind;
    std::array<int, 4> counts = {};
    for (unsigned seed = 1; seed <= 1000; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        Soup soup = seed % 2 ? test::icosphere(1) : test::torus(3, 1, 6, 5);
        for (std::size_t change = random() % 4; change > 0; --change) {
            Triangle& t = soup.facets[random() % soup.facets.size()];
            const auto v = static_cast<std::int32_t>(random() % soup.vertices.size());
            if (random() % 3 == 0) turn_over(t);
            if (random() % 3 == 0) t = soup.facets.back();
            if (random() % 3 == 0 && std::count(t.begin(), t.end(), v) == 0) t[0] = v;
            if (random() % 3 == 0) soup.facets.pop_back();
        }
        std::map<UndirectedEdge, std::vector<std::int32_t>> at;
        for (std::int32_t c = 0; c < static_cast<std::int32_t>(3 * soup.facets.size()); ++c)
            at[undirected(start_vertex(soup.facets, c), start_vertex(soup.facets, next_corner(c)))].push_back(c);
        std::vector<std::pair<UndirectedEdge, Kind>> expected, found;
        for (const auto& [edge, corners] : at)
            if (corners.size() != 2)
                expected.emplace_back(edge, corners.size() == 1 ? Kind::open_edge : Kind::non_manifold_edge);
            else if (start_vertex(soup.facets, corners[0]) == start_vertex(soup.facets, corners[1]))
                expected.emplace_back(edge, Kind::edge_orientation);
        for (const ManifoldDefect& defect : find_manifold_defects(soup.vertices.size(), soup.facets)) {
            ++counts[static_cast<std::size_t>(defect.kind)];
            if (defect.kind != Kind::non_manifold_vertex)
                found.emplace_back(UndirectedEdge{defect.vertices[0], defect.vertices[1]}, defect.kind);
        }
        EXPECT_TRUE(found == expected);
    }
    for (const int count : counts) EXPECT_GT(count, 20);
}

}  // namespace
}  // namespace kerf

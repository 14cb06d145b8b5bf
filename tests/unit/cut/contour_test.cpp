// Band, labels and contour: the way from a plane to closed loops of surface edges.
#include "cut/cut/inside/contour.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "cut/cut/inside/labels.h"
#include "cut/cut/inside/plane.h"
#include "support/assets.h"
#include "support/shapes.h"

namespace kerf {
namespace {

double length(const Surface& surface, const std::vector<SurfaceEdge>& edges) {
    double sum = 0;
    for (const auto& [a, b] : edges) sum += (surface.point(b) - surface.point(a)).norm();
    return sum;
}

// Closed: as many edges leave every vertex as arrive.
bool closed(const std::vector<SurfaceEdge>& edges) {
    std::map<Vertex, int> balance;
    for (const auto& [from, to] : edges) ++balance[from], --balance[to];
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

// Contour edges seen from the facets, without the band: below lies on the left.
std::set<SurfaceEdge> boundary_of_labels(const Surface& surface, const Array<Facet, Side>& side) {
    std::set<SurfaceEdge> edges;
    for (const Facet f : surface.facets()) {
        if (side[f] != Side::below) continue;
        const auto t = surface.corners(f);
        const auto across = surface.neighbours(f);
        for (int i = 0; i < 3; ++i)
            if (side[across[i]] == Side::above) edges.insert({t[i], t[(i + 1) % 3]});
    }
    return edges;
}

class Contours : public testing::TestWithParam<std::string> {
 protected:
    Contours() : surface_(test::asset_surface(GetParam())) {
        const MassProperties mass = mass_properties(surface_);
        for (const Vec3& direction : cut_directions(surface_, mass, {}))
            for (const double fraction : {0.31, 0.5})
                planes_.push_back(PlaneSequence(surface_, mass, direction, 0, fraction, {}).at(0)->plane);
    }
    Array<Facet, Side> minimum_cut(const Band& band) const {
        Array<Facet, Side> side = band.majority;
        std::int64_t unlimited = std::numeric_limits<std::int64_t>::max();
        EXPECT_TRUE(minimum_cut_labels(surface_, band, std::vector<double>(band.facets.size(), 1), side, unlimited));
        return side;
    }

    Surface surface_;
    std::vector<Plane> planes_;
};
INSTANTIATE_TEST_SUITE_P(Assets, Contours, testing::ValuesIn(test::asset_names()),
                         [](const auto& param) { return param.param; });

TEST_P(Contours, BandHoldsWhatThePlaneMeets) {
    for (const Plane& plane : planes_) {
        const Band band = make_band(surface_, plane);
        EXPECT_EQ(band.edge_length, crossing_edge_length(surface_, plane));
        EXPECT_TRUE(std::is_sorted(band.facets.begin(), band.facets.end()));
        std::int64_t wrong = 0;
        for (const Facet f : surface_.facets()) {
            int below = 0;
            for (const Vertex v : surface_.corners(f)) below += plane.distance(surface_.point(v)) < 0;
            const bool near = std::abs(band.facet_distance(surface_, f)) < 3 * band.edge_length;
            const std::int32_t i = band.index_of[f];
            if (below % 3 != 0 || near) wrong += i < 0;
            if (i >= 0) wrong += band.facets[i] != f || band.half_edges[i] != surface_.half_edges(f);
        }
        EXPECT_EQ(wrong, 0);
    }
}

TEST_P(Contours, EdgesAreTheBoundaryOfTheLabels) {
    for (const Plane& plane : planes_) {
        const Band band = make_band(surface_, plane);
        for (const Array<Facet, Side>& side : {band.majority, minimum_cut(band)}) {
            const std::vector<SurfaceEdge> edges = contour_edges(surface_, band, side);
            const std::set<SurfaceEdge> expected = boundary_of_labels(surface_, side);
            EXPECT_EQ(edges.size(), expected.size());
            EXPECT_TRUE(std::set(edges.begin(), edges.end()) == expected);
            EXPECT_TRUE(closed(edges));
        }
    }
}

TEST_P(Contours, CleaningLeavesSimpleLoopsWithoutEars) {
    for (const Plane& plane : planes_) {
        const Band band = make_band(surface_, plane);
        Array<Facet, Side> side = minimum_cut(band);
        const Array<Facet, Side> before = side;
        ContourStages stages;
        clean_labels(surface_, band, side, &stages);
        for (const Facet f : surface_.facets())
            ASSERT_TRUE(band.index_of[f] >= 0 || side[f] == before[f])
                << "facet " << f.value() << " beyond the band was turned";
        EXPECT_TRUE(closed(stages.closed_loops));
        EXPECT_TRUE(closed(stages.multiple_paths_removed));

        const std::vector<SurfaceEdge> edges = contour_edges(surface_, band, side);
        std::map<Vertex, int> degree;
        for (const auto& [a, b] : edges) ++degree[a], ++degree[b];
        for (const auto& [vertex, n] : degree) EXPECT_EQ(n, 2) << "at vertex " << vertex.value();
        std::int64_t ears = 0;
        for (const Facet f : band.facets) {
            const auto across = surface_.neighbours(f);
            ears += std::count_if(across.begin(), across.end(), [&](Facet n) { return side[n] != side[f]; }) > 1;
        }
        EXPECT_EQ(ears, 0);

        const ContourLoops contour = trace_loops(surface_, edges);
        EXPECT_TRUE(contour.pinched.empty());
        std::set<SurfaceEdge> traced;
        for (const auto& loop : contour.loops)
            for (std::size_t i = 0; i < loop.size(); ++i) traced.insert({loop[i], loop[(i + 1) % loop.size()]});
        EXPECT_TRUE(traced == std::set(edges.begin(), edges.end()));

        Array<Facet, Side> again = side;
        clean_labels(surface_, band, again, nullptr);
        EXPECT_TRUE(again == side) << "cleaning what is clean";
    }
}

TEST_P(Contours, MinimumCutIsShorterThanTheMajority) {
    double majority = 0, minimum = 0;
    for (const Plane& plane : planes_) {
        const Band band = make_band(surface_, plane);
        majority += length(surface_, contour_edges(surface_, band, band.majority));
        minimum += length(surface_, contour_edges(surface_, band, minimum_cut(band)));
    }
    EXPECT_LT(minimum, majority);
}

TEST_P(Contours, PenaltyPushesTheContourAway) {
    const Band band = make_band(surface_, planes_[1]);
    Array<Facet, Side> side = minimum_cut(band);
    const std::vector<SurfaceEdge> edges = contour_edges(surface_, band, side);
    // The shortest edge: on graded surfaces the facets at a long one may span the band.
    const SurfaceEdge hit = *std::min_element(
        edges.begin(), edges.end(),
        [&](const SurfaceEdge& a, const SurfaceEdge& b) { return length(surface_, {a}) < length(surface_, {b}); });
    std::vector<double> penalty(band.facets.size(), 1);
    for (std::size_t i = 0; i < band.facets.size(); ++i)
        for (const Vertex v : surface_.corners(band.facets[i]))
            if (v == hit[0] || v == hit[1]) penalty[i] = 1e4;
    const auto expensive_edges = [&] {
        std::int64_t count = 0;
        for (std::size_t i = 0; i < band.facets.size(); ++i)
            for (const Facet n : surface_.neighbours(band.facets[i]))
                count += penalty[i] > 1 && side[n] != side[band.facets[i]];
        return count;
    };
    const std::int64_t before = expensive_edges();
    std::int64_t budget = std::numeric_limits<std::int64_t>::max();
    ASSERT_TRUE(minimum_cut_labels(surface_, band, penalty, side, budget));
    EXPECT_LT(budget, std::numeric_limits<std::int64_t>::max());
    std::int64_t none = 3;
    const Array<Facet, Side> labels = side;
    EXPECT_FALSE(minimum_cut_labels(surface_, band, penalty, side, none));
    EXPECT_LE(none, 0);
    EXPECT_EQ(side, labels);
    EXPECT_LT(expensive_edges(), before);
}

TEST(Band, SectionAreaIsExact) {
    const Surface cube = test::to_surface(test::box(Vec3::Zero(), Vec3(2, 3, 4), 5));
    EXPECT_NEAR(make_band(cube, Plane(Vec3(1, 1, 1.7), Vec3::UnitZ())).section_area, 6, 1e-12);
    EXPECT_NEAR(make_band(cube, Plane(Vec3(1, 1, 1), -Vec3::UnitX())).section_area, 12, 1e-12);
    const Surface hollow = test::to_surface(test::nested_boxes(2, 4));
    EXPECT_NEAR(make_band(hollow, Plane(Vec3(0, 0, 0.1), Vec3::UnitZ())).section_area, 8, 1e-12);
    EXPECT_NEAR(make_band(hollow, Plane(Vec3(0, 0, 1.1), Vec3::UnitZ())).section_area, 9, 1e-12);
    const Surface sphere = test::to_surface(test::icosphere(5, 2));
    EXPECT_NEAR(make_band(sphere, Plane(Vec3::Zero(), Vec3(1, 2, 3).normalized())).section_area, 4 * std::numbers::pi,
                0.02);
}

TEST(Band, PlaneBesideTheBodyMeetsNothing) {
    const Surface cube = test::to_surface(test::box());
    const Band band = make_band(cube, Plane(Vec3(0, 0, 2), Vec3::UnitZ()));
    EXPECT_EQ(band.edge_length, 0);
    EXPECT_EQ(band.section_area, 0);
    EXPECT_TRUE(crossed_edges(cube, band).empty());
}

TEST(Band, CrossedEdgesRunUpwards) {
    const Surface sphere = test::to_surface(test::icosphere(3));
    const Plane plane(Vec3(0.1, 0, 0), Vec3(1, 2, 3).normalized());
    const std::vector<SurfaceEdge> edges = crossed_edges(sphere, make_band(sphere, plane));
    std::int64_t crossing = 0;
    for (const Facet f : sphere.facets()) {
        const auto t = sphere.corners(f);
        for (int i = 0; i < 3; ++i)
            crossing += plane.distance(sphere.point(t[i])) < 0 && plane.distance(sphere.point(t[(i + 1) % 3])) >= 0;
    }
    EXPECT_EQ(edges.size(), static_cast<std::size_t>(crossing));
    for (const auto& [below, above] : edges) {
        EXPECT_LT(plane.distance(sphere.point(below)), 0);
        EXPECT_GE(plane.distance(sphere.point(above)), 0);
    }
}

TEST(Contour, PinchedVertexIsNamed) {
    std::vector<SurfaceEdge> figure_eight;
    for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {2, 0}, {0, 3}, {3, 4}, {4, 0}})
        figure_eight.push_back({Vertex(from), Vertex(to)});
    EXPECT_EQ(trace_loops(test::to_surface(test::icosphere(1)), figure_eight).pinched, std::vector{Vertex(0)});
}

TEST(Contour, LoopsOfAHollowBodyAreTwo) {
    const Surface body = test::to_surface(test::nested_boxes(2, 8));
    const Band band = make_band(body, Plane(Vec3(0, 0, 0.03), Vec3::UnitZ()));
    Array<Facet, Side> side = band.majority;
    clean_labels(body, band, side, nullptr);
    EXPECT_EQ(trace_loops(body, contour_edges(body, band, side)).loops.size(), 2u);
}

TEST(Contour, IslandIsAbsorbedButAWholeShellIsNot) {
    const Surface body = test::to_surface(test::join(test::box(Vec3(0, 0, 0), Vec3(1, 1, 1), 10),
                                                     test::box(Vec3(2, 0, 0.45), Vec3(2.05, 0.05, 0.49), 1)));
    const Band band = make_band(body, Plane(Vec3(0, 0, 0.52), Vec3::UnitZ()));
    Array<Facet, Side> side = band.majority, clean = side;
    clean_labels(body, band, clean, nullptr);
    Array<Facet, Side> spotted = clean;
    Facet island = Facet::none();
    for (const Facet f : band.facets) {
        const auto across = body.neighbours(f);
        if (std::all_of(across.begin(), across.end(), [&](Facet n) { return clean[n] == clean[f]; }) &&
            f.value() < 12 * 100)
            island = f;
    }
    ASSERT_TRUE(island.is_valid());
    spotted[island] = other(spotted[island]);
    clean_labels(body, band, spotted, nullptr);
    EXPECT_TRUE(spotted == clean);
    EXPECT_EQ(clean[body.facet_count() - 1], Side::below) << "the small box lies below the plane as a whole";
}

}  // namespace
}  // namespace kerf

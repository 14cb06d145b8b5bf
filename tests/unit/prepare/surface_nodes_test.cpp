#include "run/prepare/surface_nodes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "run/prepare/inside/surface_places.h"
#include "support/shapes.h"

namespace kerf {
namespace {

RunRequest of_second_order() {
    RunRequest options;
    options.order = 2;
    return options;
}

Input read_soup(const Soup& soup) { return make_input(soup.vertices, soup.facets, soup.patch, soup.patch_names); }

// A ball in two halves, which are patches.
Input halves(int subdivisions) {
    Soup soup = test::icosphere(subdivisions);
    soup.patch_names = {"low", "high"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto& [a, b, c] = soup.facets[f];
        soup.patch[f] = (soup.vertices[a] + soup.vertices[b] + soup.vertices[c]).x() > 0;
    }
    return read_soup(soup);
}

// As if the second had been made of the first by remeshing.
SurfaceNodes nodes_of(const Input& file, Input& surface) {
    surface.remeshed.emplace();
    return make_surface_nodes(surface, surface_behind(file, of_second_order()), of_second_order());
}

TEST(SurfaceNodes, OfACoarseBallLieOnTheFineOne) {
    const Input fine = read_soup(test::icosphere(5));
    Input coarse = read_soup(test::icosphere(2));
    const SurfaceNodes nodes = nodes_of(fine, coarse);
    EXPECT_EQ(nodes.surface_edges, 480);
    ASSERT_EQ(nodes.edges.size(), 480);
    EXPECT_TRUE(std::is_sorted(nodes.edges.begin(), nodes.edges.end()));
    const double sagitta = 4e-4;  // of the fine one
    for (std::size_t e = 0; e < nodes.edges.size(); ++e) {
        EXPECT_NEAR(nodes.points[e].norm(), 1, sagitta);
        EXPECT_EQ(nodes.find(nodes.edges[e]), &nodes.points[e]);
    }
    EXPECT_EQ(nodes.find({0, 0}), nullptr);
}

TEST(SurfaceNodes, OfBordersLieOnTheBordersOfTheFile) {
    const Input fine = halves(4);
    Input coarse = halves(2);
    const PlacedSurface file(fine.complex.arrays()), surface(coarse.complex.arrays());
    const SurfaceNodes nodes = nodes_of(fine, coarse);
    int borders = 0;
    for (const PlacedEdge& edge : surface.edges) {
        const Vec3* node = nodes.find(edge.ends);
        if (!edge.is_border || !node) continue;
        ++borders;
        double least = 1;
        for (const PlacedEdge& line : file.edges) {
            if (!line.is_border) continue;
            const Vec3 &a = file.points[line.ends[0]], along = file.points[line.ends[1]] - a;
            const double t = std::clamp(along.dot(*node - a) / along.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (a + t * along - *node).norm());
        }
        EXPECT_LT(least, 1e-12);
    }
    EXPECT_GT(borders, 4);
}

TEST(SurfaceNodes, OfWhatIsFlatOrKeptAreInTheMiddle) {
    const Input fine = read_soup(test::box(Vec3::Zero(), Vec3::Ones(), 6));
    Input coarse = read_soup(test::box(Vec3::Zero(), Vec3::Ones(), 2));
    const SurfaceNodes flat = nodes_of(fine, coarse);
    EXPECT_TRUE(flat.edges.empty());
    EXPECT_EQ(flat.surface_edges, 72);
    const Input ball = read_soup(test::icosphere(2));
    Input same = read_soup(test::icosphere(2));
    EXPECT_TRUE(nodes_of(ball, same).edges.empty());
}

TEST(SurfaceNodes, AreOnlyMadeWhereTheyAreAskedForAndTheSurfaceIsNotTheFile) {
    const Input fine = read_soup(test::icosphere(3));
    Input coarse = read_soup(test::icosphere(2));
    RunRequest straight = of_second_order(), first;
    straight.curving = Curving::straight;
    for (const RunRequest& options : {straight, first}) {
        EXPECT_TRUE(surface_behind(fine, options).facets.empty());
        EXPECT_TRUE(make_surface_nodes(coarse, fine.complex.arrays(), options).edges.empty());
    }
    EXPECT_TRUE(make_surface_nodes(coarse, fine.complex.arrays(), of_second_order()).edges.empty())
        << "nothing was remeshed";
}

}  // namespace
}  // namespace kerf

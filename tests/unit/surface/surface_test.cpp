#include "surface/complex/surface.h"

#include <algorithm>
#include <random>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "support/shapes.h"

namespace kerf {
namespace {

using test::to_arrays;

// With facets and corners in random order, so that nothing depends on how the shapes are made.
Soup shuffled(Soup soup, unsigned seed) {
    std::mt19937 random(seed);
    std::shuffle(soup.facets.begin(), soup.facets.end(), random);
    for (Triangle& t : soup.facets) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    return soup;
}

class SurfaceLaws : public testing::TestWithParam<int> {
 protected:
    SurfaceLaws() : soup_(shuffled(shapes()[GetParam()], 1)), surface_(to_arrays(soup_)) {}

    static std::vector<Soup> shapes() {
        return {test::tetrahedron(),   test::box(Vec3(0, 0, 0), Vec3(1, 2, 3), {2, 3, 4}),
                test::icosphere(2),    test::torus(3, 1, 12, 7),
                test::uv_sphere(6, 8), test::nested_boxes(3, 2)};
    }

    Soup soup_;
    Surface surface_;
};
INSTANTIATE_TEST_SUITE_P(Shapes, SurfaceLaws, testing::Range(0, 6));

TEST_P(SurfaceLaws, KeepsNumbersCoordinatesKeysAndPatches) {
    SurfaceArrays arrays = to_arrays(soup_);
    for (std::size_t v = 0; v < arrays.vertex_key.size(); ++v)
        arrays.vertex_key[v] = make_key(NodeId(3), 7 * static_cast<std::int32_t>(v));
    for (std::size_t f = 0; f < arrays.facet_key.size(); ++f) {
        arrays.facet_key[f] = make_key(NodeId(5), 9 * static_cast<std::int32_t>(f));
        arrays.patch[f] = static_cast<std::int32_t>(f % 3) - 1;
    }
    const Surface surface(arrays);
    const SurfaceArrays back = surface.arrays();
    EXPECT_EQ(back.vertices, arrays.vertices);
    EXPECT_EQ(back.facets, arrays.facets);
    EXPECT_EQ(back.vertex_key, arrays.vertex_key);
    EXPECT_EQ(back.facet_key, arrays.facet_key);
    EXPECT_EQ(back.patch, arrays.patch);
}

TEST_P(SurfaceLaws, HalfEdgesFormTrianglesAndPairs) {
    Array<HalfEdge, int> seen(3 * soup_.facets.size(), 0);
    for (const Facet f : surface_.facets()) {
        EXPECT_EQ(surface_.triangle(f), soup_.facets[f.value()]);
        const auto corners = surface_.corners(f);
        const auto h = surface_.half_edges(f);
        for (int i = 0; i < 3; ++i) {
            EXPECT_EQ(corners[i], Vertex(soup_.facets[f.value()][i]));
            ASSERT_LT(static_cast<std::size_t>(h[i].value()), seen.size());
            ++seen[h[i]];
            EXPECT_EQ(surface_.from_vertex(h[i]), corners[i]);
            EXPECT_EQ(surface_.to_vertex(h[i]), corners[(i + 1) % 3]);
            EXPECT_EQ(surface_.next(h[i]), h[(i + 1) % 3]);
            EXPECT_EQ(surface_.facet_of(h[i]), f);
            const HalfEdge other = Surface::opposite(h[i]);
            EXPECT_NE(other, h[i]);
            EXPECT_EQ(Surface::opposite(other), h[i]);
            EXPECT_EQ(Surface::edge_of(other), Surface::edge_of(h[i]));
            EXPECT_EQ(surface_.from_vertex(other), surface_.to_vertex(h[i]));
            EXPECT_EQ(surface_.to_vertex(other), surface_.from_vertex(h[i]));
            EXPECT_EQ(surface_.neighbours(f)[i], surface_.facet_of(other));
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(seen.size()));
}

TEST_P(SurfaceLaws, RotationVisitsEveryFacetOfAVertexOnce) {
    Array<Vertex, std::set<Facet>> expected(soup_.vertices.size());
    for (const Facet f : surface_.facets())
        for (const Vertex v : surface_.corners(f)) expected[v].insert(f);
    for (const Vertex v : surface_.vertices()) {
        std::set<Facet> visited;
        HalfEdge first = HalfEdge::none(), before = HalfEdge::none();
        for (const HalfEdge h : surface_.around(v)) {
            EXPECT_EQ(surface_.from_vertex(h), v);
            ASSERT_TRUE(visited.insert(surface_.facet_of(h)).second) << "vertex " << v.value();
            EXPECT_TRUE(!before.is_valid() || h == surface_.next(Surface::opposite(before)));
            if (!first.is_valid()) first = h;
            before = h;
        }
        EXPECT_EQ(first, surface_.next(Surface::opposite(before))) << "vertex " << v.value();
        EXPECT_EQ(surface_.facet_of(first), *expected[v].rbegin()) << "starts in the last facet";
        EXPECT_EQ(visited, expected[v]);
    }
}

TEST_P(SurfaceLaws, FindsTheHalfEdgesBetweenVertices) {
    for (const Vertex v : surface_.vertices()) {
        std::set<Vertex> ends;
        for (const HalfEdge h : surface_.around(v)) {
            ends.insert(surface_.to_vertex(h));
            EXPECT_EQ(surface_.find_half_edge(v, surface_.to_vertex(h)), h);
        }
        for (const Vertex w : surface_.vertices())
            EXPECT_EQ(surface_.find_half_edge(v, w).is_valid(), ends.contains(w)) << v.value() << " " << w.value();
        EXPECT_EQ(surface_.find_half_edge(v, v), HalfEdge::none());
    }
}

TEST_P(SurfaceLaws, RangesHaveEveryThingOnce) {
    const auto expect_all = [](const auto& range, std::size_t count) {
        std::int32_t next = 0;
        for (const auto id : range) EXPECT_EQ(id.value(), next++);
        EXPECT_EQ(next, static_cast<std::int32_t>(count));
    };
    expect_all(surface_.vertices(), soup_.vertices.size());
    expect_all(surface_.facets(), soup_.facets.size());
    expect_all(surface_.edges(), 3 * soup_.facets.size() / 2);
    expect_all(Surface().vertices(), 0);
    for (const Edge e : surface_.edges()) EXPECT_EQ(Surface::edge_of(Surface::first_half_edge(e)), e);
    EXPECT_FALSE(surface_.has_vertex(Vertex::none()));
    EXPECT_TRUE(surface_.has_vertex(Vertex(soup_.vertices.size() - 1)));
    EXPECT_FALSE(surface_.has_vertex(Vertex(soup_.vertices.size())));
}

TEST_P(SurfaceLaws, DoesNotChangeOnTheWayThroughBytes) {
    const SurfaceArrays arrays = surface_.arrays();
    const SurfaceArrays back = from_bytes<SurfaceArrays>(to_bytes(arrays));
    EXPECT_EQ(back.vertices, arrays.vertices);
    EXPECT_EQ(back.facets, arrays.facets);
    EXPECT_EQ(back.vertex_key, arrays.vertex_key);
    EXPECT_EQ(back.facet_key, arrays.facet_key);
    EXPECT_EQ(back.patch, arrays.patch);
    EXPECT_EQ(to_bytes(back), to_bytes(arrays));
}

TEST_P(SurfaceLaws, EveryTurnedFacetBreaksItsThreeEdges) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(seed);
        Soup soup = soup_;
        const std::size_t f = std::mt19937(seed)() % soup.facets.size();
        std::swap(soup.facets[f][0], soup.facets[f][1]);
        const auto defects = find_manifold_defects(soup.vertices.size(), soup.facets);
        ASSERT_EQ(defects.size(), 3u);
        for (const ManifoldDefect& defect : defects) {
            EXPECT_EQ(defect.kind, ManifoldDefect::Kind::edge_orientation);
            EXPECT_EQ(std::count(defect.facets.begin(), defect.facets.end(), static_cast<std::int32_t>(f)), 1);
        }
        EXPECT_THROW(Surface(to_arrays(soup)), Error);
    }
}

TEST(FindManifoldDefects, FindsOpenEdgesAndPinchedVertices) {
    Soup soup = test::join(test::box(), test::box(Vec3(1, 1, 1), Vec3(2, 2, 2)));
    weld_exactly(soup);
    const auto pinched = find_manifold_defects(soup.vertices.size(), soup.facets);
    ASSERT_EQ(pinched.size(), 1u);
    EXPECT_EQ(pinched[0].kind, ManifoldDefect::Kind::non_manifold_vertex);
    EXPECT_EQ(soup.vertices[pinched[0].vertices[0]], Vec3(1, 1, 1));

    Soup open = test::icosphere(1);
    open.facets.pop_back();
    const auto edges = find_manifold_defects(open.vertices.size(), open.facets);
    ASSERT_EQ(edges.size(), 3u);
    for (const ManifoldDefect& defect : edges) EXPECT_EQ(defect.kind, ManifoldDefect::Kind::open_edge);
}

TEST(FindManifoldDefects, AllowsVerticesWithoutFacets) {
    Soup soup = test::box();
    soup.vertices.emplace_back(5, 5, 5);
    EXPECT_TRUE(find_manifold_defects(soup.vertices.size(), soup.facets).empty());
    EXPECT_EQ(Surface(to_arrays(soup)).point(Vertex(8)), Vec3(5, 5, 5));
}

TEST(SurfaceConstructor, NamesTheFirstDefect) {
    Soup soup = test::tetrahedron();
    drop_facets(soup, {0, 0, 0, 1});
    try {
        Surface surface(to_arrays(soup));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::internal);
        EXPECT_NE(std::string(error.what()).find("open edge at vertex 1"), std::string::npos) << error.what();
    }
}

TEST(FindShells, NumbersComponentsBySmallestFacet) {
    const Soup soup = test::join(test::tetrahedron(), test::join(test::torus(3, 1, 8, 5), test::box()));
    const Components shells = find_shells(Surface(to_arrays(soup)));
    EXPECT_EQ(shells.count, 3);
    for (std::int32_t f = 0; f < 96; ++f) EXPECT_EQ(shells.of[f], f < 4 ? 0 : f < 84 ? 1 : 2) << f;

    const Soup mixed = shuffled(soup, 3);
    const Components found = find_shells(Surface(to_arrays(mixed)));
    EXPECT_EQ(found.count, 3);
    std::int32_t next = 0;  // a new number is always the next one
    for (std::int32_t shell : found.of) {
        ASSERT_LE(shell, next);
        next = std::max(next, shell + 1);
    }
}

// Halves of a cut know most partners: forgetting any of them changes nothing but the time.
TEST(Surface, KnownPartnersGiveTheSameHalfEdges) {
    std::mt19937 random(7);
    for (const Soup& soup : {test::tetrahedron(), test::box(), test::icosphere(2), test::torus(3, 1, 12, 9)}) {
        const SurfaceArrays arrays = test::to_arrays(soup);
        const Surface whole{SurfaceArrays(arrays)};
        Array<HalfEdge, std::int32_t> corner_of(3 * arrays.facets.size());
        for (const Facet f : whole.facets())
            for (int i = 0; i < 3; ++i) corner_of[whole.half_edges(f)[i]] = 3 * f.value() + i;
        for (int trial = 0; trial < 10; ++trial) {
            SCOPED_TRACE(testing::Message() << soup.patch_names[0] << ", trial " << trial << " of seed 7");
            std::vector<std::int32_t> partner(corner_of.size(), -1);
            for (std::size_t h = 0; h < partner.size(); h += 2)
                if (random() % 10 >= static_cast<unsigned>(trial)) {
                    partner[corner_of[h]] = corner_of[h + 1];
                    partner[corner_of[h + 1]] = corner_of[h];
                }
            auto built = Surface::build(SurfaceArrays(arrays), partner);
            ASSERT_TRUE(std::holds_alternative<Surface>(built));
            const Surface& surface = std::get<Surface>(built);
            for (const Facet f : whole.facets()) {
                EXPECT_EQ(surface.half_edges(f), whole.half_edges(f));
                EXPECT_EQ(surface.corners(f), whole.corners(f));
                EXPECT_EQ(surface.neighbours(f), whole.neighbours(f));
            }
        }
    }
}

TEST(Surface, OpenCornersWithoutPartnerAreDefects) {
    SurfaceArrays arrays = test::to_arrays(test::icosphere(1));
    const Surface whole{SurfaceArrays(arrays)};
    std::vector<std::int32_t> partner(3 * arrays.facets.size());
    for (const Facet f : whole.facets())
        for (int i = 0; i < 3; ++i) {
            const Facet g = whole.neighbours(f)[i];
            const auto others = whole.neighbours(g);
            const auto place = std::find(others.begin(), others.end(), f) - others.begin();
            partner[3 * f.value() + i] = static_cast<std::int32_t>(3 * g.value() + place);
        }
    arrays.facets.pop_back();  // its neighbours lose theirs
    arrays.facet_key.pop_back();
    arrays.patch.pop_back();
    partner.resize(partner.size() - 3);
    for (std::int32_t& p : partner)
        if (p >= static_cast<std::int32_t>(partner.size())) p = -1;
    const auto built = Surface::build(std::move(arrays), partner);
    ASSERT_TRUE(std::holds_alternative<ManifoldDefect>(built));
    EXPECT_EQ(std::get<ManifoldDefect>(built).kind, ManifoldDefect::Kind::open_edge);
}

}  // namespace
}  // namespace kerf

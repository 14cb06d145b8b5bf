#include "surface/complex/touching.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/geometry/predicates.h"
#include "base/geometry/triangle.h"
#include "base/geometry/union_find.h"
#include "support/voxels.h"
#include "surface/complex/mass_properties.h"
#include "surface/soup/edge_corners.h"

namespace kerf {
namespace {

using test::Voxels;

bool same_arrays(const SurfaceArrays& a, const SurfaceArrays& b) {
    return a.vertices == b.vertices && a.facets == b.facets && a.vertex_key == b.vertex_key &&
           a.facet_key == b.facet_key && a.patch == b.patch;
}

// The number of the voxels' components that hang together by sides, per voxel.
std::map<std::array<int, 3>, std::int32_t> side_components(const Voxels& voxels) {
    const std::vector<std::array<int, 3>> list(voxels.begin(), voxels.end());
    UnionFind sets(list.size());
    for (std::size_t v = 0; v < list.size(); ++v)
        for (std::size_t w = 0; w < v; ++w) {
            int distance = 0;
            for (int i = 0; i < 3; ++i) distance += std::abs(list[v][i] - list[w][i]);
            if (distance == 1) sets.join(static_cast<std::int32_t>(v), static_cast<std::int32_t>(w));
        }
    const Components components = sets.take();
    std::map<std::array<int, 3>, std::int32_t> component;
    for (std::size_t v = 0; v < list.size(); ++v) component[list[v]] = components.of[v];
    return component;
}

// The cube behind a facet.
std::array<int, 3> voxel_behind(const SurfaceArrays& arrays, const Triangle& t) {
    const Vec3 centroid = (arrays.vertices[t[0]] + arrays.vertices[t[1]] + arrays.vertices[t[2]]) / 3;
    const Vec3 p = centroid - 0.25 * doubled_area_vector(arrays.vertices, t).normalized();
    return {int(std::floor(p.x())), int(std::floor(p.y())), int(std::floor(p.z()))};
}

void expect_own_vertices(const Surface& surface) {
    Array<Vertex, int> corners(surface.vertex_count(), 0);
    for (const Facet f : surface.facets())
        for (const Vertex v : surface.corners(f)) ++corners[v];
    for (const Vertex v : surface.vertices()) {
        int around = 0;
        for (const HalfEdge h : surface.around(v)) {
            ASSERT_EQ(surface.from_vertex(h), v);
            ++around;
        }
        EXPECT_EQ(around, corners[v]) << "vertex " << v.value();
    }
}

// Each component of voxels has shells of its own, of which one is its outer one.
void expect_shells_of(const Voxels& voxels, const SurfaceArrays& arrays, const Components& shells) {
    const auto component = side_components(voxels);
    std::vector<std::int32_t> component_of(shells.count, -1);
    std::vector<std::vector<Triangle>> facets(shells.count);
    for (std::size_t f = 0; f < arrays.facets.size(); ++f) {
        const std::int32_t own = component.at(voxel_behind(arrays, arrays.facets[f])), shell = shells.of[f];
        EXPECT_TRUE(component_of[shell] == -1 || component_of[shell] == own) << "facet " << f;
        component_of[shell] = own;
        facets[shell].push_back(arrays.facets[f]);
    }
    std::map<std::int32_t, int> outer;
    for (std::int32_t s = 0; s < shells.count; ++s) outer[component_of[s]] += is_outward(arrays.vertices, facets[s]);
    for (const auto& [voxel, own] : component) EXPECT_EQ(outer[own], 1);
}

void expect_laws(const Voxels& voxels) {
    const SurfaceArrays arrays = test::to_arrays(test::voxel_surface(voxels));
    const SeparatedSurface separated = separate_touching(arrays);
    const SurfaceArrays& own = separated.arrays;
    ASSERT_EQ(own.facets.size(), arrays.facets.size());
    EXPECT_EQ(own.facet_key, arrays.facet_key);
    for (std::size_t f = 0; f < arrays.facets.size(); ++f)
        for (int i = 0; i < 3; ++i) {
            const std::int32_t v = own.facets[f][i], before = arrays.facets[f][i];
            EXPECT_EQ(own.vertices[v], arrays.vertices[before]);
            EXPECT_EQ(own.vertex_key[v], arrays.vertex_key[before]);
            EXPECT_EQ(separated.touches() ? separated.original[v] : v, before);
        }
    EXPECT_EQ(separated.touches(), !find_manifold_defects(arrays.vertices.size(), arrays.facets).empty());
    const Surface surface = to_surface(separated);
    EXPECT_NEAR(enclosed_volume(surface), static_cast<double>(voxels.size()), 1e-9);
    expect_own_vertices(surface);
    expect_shells_of(voxels, own, find_shells(surface));
    EXPECT_TRUE(same_arrays(joined_by_key(surface.arrays()), arrays));
    EXPECT_EQ(copied_vertices(surface).empty(), own.vertices.size() == arrays.vertices.size());
    EXPECT_TRUE(same_arrays(separated_surface(arrays).arrays(), own));
    const SeparatedSurface again = separate_touching(own);
    EXPECT_TRUE(same_arrays(again.arrays, own));
    EXPECT_EQ(again.partner, separated.partner);
}

std::int32_t shell_count(const Voxels& voxels) {
    return find_shells(to_surface(separate_touching(test::to_arrays(test::voxel_surface(voxels))))).count;
}

TEST(SeparateTouching, ReturnsWhatTouchesNothing) {
    for (const Soup& soup : {test::box(), test::icosphere(2), test::torus(3, 1, 12, 7), test::nested_boxes(3, 2)}) {
        const SurfaceArrays arrays = test::to_arrays(soup);
        const SeparatedSurface separated = separate_touching(arrays);
        EXPECT_FALSE(separated.touches());
        EXPECT_TRUE(same_arrays(separated.arrays, arrays));
        const Surface surface(arrays), same = to_surface(separated);
        for (const Facet f : surface.facets()) EXPECT_EQ(same.half_edges(f), surface.half_edges(f));
        EXPECT_TRUE(copied_vertices(surface).empty());
        EXPECT_TRUE(same_arrays(joined_by_key(arrays), arrays));
    }
}

TEST(SeparateTouching, TakesApartTwoCubes) {
    for (const std::array<int, 3>& other : {std::array{1, 1, 1}, std::array{1, 1, 0}, std::array{-1, 0, 1}}) {
        const Voxels voxels = {{0, 0, 0}, other};
        expect_laws(voxels);
        EXPECT_EQ(shell_count(voxels), 2);
        const SeparatedSurface separated = separate_touching(test::to_arrays(test::voxel_surface(voxels)));
        EXPECT_EQ(separated.arrays.vertices.size(), 16u);
    }
}

// All sets of eight cubes around a corner.
TEST(SeparateTouching, HoldsForEveryCorner) {
    for (int filled = 1; filled < 256; ++filled) {
        SCOPED_TRACE(filled);
        Voxels voxels;
        for (int i = 0; i < 8; ++i)
            if (filled >> i & 1) voxels.insert({i & 1, i >> 1 & 1, i >> 2});
        expect_laws(voxels);
    }
}

TEST(SeparateTouching, HoldsForRandomVoxels) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::SeededNumbers random(seed);
        expect_laws(test::random_voxels(4, random.between(0.1, 0.9), random));
    }
}

TEST(SeparateTouching, DoesNotDependOnTheOrderOfFacets) {
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::SeededNumbers random(seed);
        const SurfaceArrays arrays = test::to_arrays(test::voxel_surface(test::random_voxels(4, 0.5, random)));
        SurfaceArrays mixed = arrays;
        std::mt19937 shuffler(static_cast<unsigned>(seed));
        std::shuffle(mixed.facet_key.begin(), mixed.facet_key.end(), shuffler);
        std::vector<int> turns(mixed.facets.size());
        for (std::size_t f = 0; f < mixed.facets.size(); ++f) {
            mixed.facets[f] = arrays.facets[key_index(mixed.facet_key[f])];
            turns[f] = static_cast<int>(shuffler() % 3);
            std::rotate(mixed.facets[f].begin(), mixed.facets[f].begin() + turns[f], mixed.facets[f].end());
        }
        const SeparatedSurface a = separate_touching(arrays), b = separate_touching(mixed);
        ASSERT_EQ(a.arrays.vertices.size(), b.arrays.vertices.size());
        std::vector<std::int32_t> number(a.arrays.vertices.size(), -1);
        const auto corner_before = [&](std::int32_t corner) {
            return 3 * key_index(mixed.facet_key[corner / 3]) + (corner % 3 + turns[corner / 3]) % 3;
        };
        for (std::int32_t c = 0; c < static_cast<std::int32_t>(b.partner.size()); ++c) {
            EXPECT_EQ(a.partner[corner_before(c)], corner_before(b.partner[c]));
            std::int32_t& v = number[start_vertex(a.arrays.facets, corner_before(c))];
            EXPECT_TRUE(v == -1 || v == start_vertex(b.arrays.facets, c));
            v = start_vertex(b.arrays.facets, c);
        }
    }
}

TEST(SeparateTouching, LeavesADoubleEdge) {
    const SurfaceArrays arrays = test::to_arrays(test::voxel_surface(test::notched_voxels()));
    expect_laws(test::notched_voxels());
    const SeparatedSurface separated = separate_touching(arrays);
    EXPECT_TRUE(separated.touches());
    EXPECT_TRUE(same_arrays(separated.arrays, arrays));
    EXPECT_THROW(Surface{SurfaceArrays(arrays)}, Error);
    const Surface surface = to_surface(separated);
    for (const Vertex v : surface.vertices())
        EXPECT_EQ(has_touching_edge(surface, v),
                  surface.point(v) == Vec3(1, 1, 1) || surface.point(v) == Vec3(1, 1, 2));
}

// Tetrahedra with one edge in common, each between two of the points around it.
SurfaceArrays tetrahedra_at_edge(const Vec3& a, const Vec3& b, const std::vector<Vec3>& around) {
    Soup soup;
    soup.vertices = {a, b};
    soup.vertices.insert(soup.vertices.end(), around.begin(), around.end());
    for (std::int32_t c = 2, d = 3; d < static_cast<std::int32_t>(soup.vertices.size()); c += 2, d += 2)
        soup.facets.insert(soup.facets.end(), {{0, c, 1}, {0, 1, d}, {0, d, c}, {1, c, d}});
    soup.patch.assign(soup.facets.size(), 0);
    return test::to_arrays(soup);
}

void expect_tetrahedra_apart(const SurfaceArrays& arrays) {
    const SeparatedSurface separated = separate_touching(arrays);
    for (std::size_t c = 0; c < separated.partner.size(); ++c)
        EXPECT_EQ(separated.partner[c] / 12, static_cast<std::int32_t>(c / 12));
    EXPECT_EQ(find_shells(to_surface(separated)).count, static_cast<std::int32_t>(arrays.facets.size() / 4));
}

TEST(SeparateTouching, SortsWedgesAroundAnyEdge) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        test::SeededNumbers random(seed);
        const auto any = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
        const Vec3 a = any(), axis = any().normalized(), u = axis.unitOrthogonal(), v = axis.cross(u);
        const int wedges = random.integer(2, 6);
        const double start = random.between(0, 7), step = std::numbers::pi / wedges;
        std::vector<Vec3> around;
        for (int i = 0; i < 2 * wedges; ++i) {
            const double angle = start + step * (i + random.between(-0.4, 0.4));
            around.push_back(a + random.between(-1, 1) * axis + std::cos(angle) * u + std::sin(angle) * v);
        }
        expect_tetrahedra_apart(tetrahedra_at_edge(a, a + axis, around));
    }
}

// All points lie within a few units in the last place of one another.
TEST(SeparateTouching, SortsWedgesThatAreNearlyFlat) {
    const Vec3 a(0.1, 0.2, 0.3), b(0.4, 1.1, 2.3);
    std::vector<Vec3> around = {Vec3(1.7, 0.9, 0.6)};
    while (around.size() < 8) {
        Vec3 p = around.back();
        for (const int axis : {0, 1}) {
            p = around.back();
            p[axis] = std::nextafter(p[axis], 9);
            if (orientation(a, b, around.back(), p) > 0) break;
            p[axis] = std::nextafter(around.back()[axis], -9);
            if (orientation(a, b, around.back(), p) > 0) break;
        }
        ASSERT_GT(orientation(a, b, around.back(), p), 0);
        around.push_back(p);
    }
    expect_tetrahedra_apart(tetrahedra_at_edge(a, b, around));
    std::swap(around[0], around[2]);  // in another order
    std::swap(around[1], around[3]);
    expect_tetrahedra_apart(tetrahedra_at_edge(a, b, around));
}

TEST(SeparateTouching, RefusesFacetsThatDoNotPair) {
    SurfaceArrays open = test::to_arrays(test::box());
    open.facets.pop_back(), open.facet_key.pop_back(), open.patch.pop_back();
    EXPECT_THROW(separate_touching(open), Error);

    SurfaceArrays turned = test::to_arrays(test::box());
    std::swap(turned.facets[0][0], turned.facets[0][1]);
    EXPECT_THROW(separate_touching(turned), Error);

    Soup twice = test::join(test::box(), test::box());
    weld_exactly(twice);
    EXPECT_THROW(separate_touching(test::to_arrays(twice)), Error);

    // The second wedge lies within the first.
    const Vec3 a(0, 0, 0), b(0, 0, 1);
    EXPECT_THROW(separate_touching(tetrahedra_at_edge(a, b, {{1, 0, 0}, {0, 1, 0}, {2, 1, 0}, {1, 2, 0}})), Error);
    // A facet lies in the plane of another.
    EXPECT_THROW(separate_touching(tetrahedra_at_edge(a, b, {{1, 0, 0}, {0, 1, 0}, {0, 2, 1}, {-1, 1, 0}})), Error);
    // A facet without area.
    EXPECT_THROW(separate_touching(tetrahedra_at_edge(a, b, {{1, 0, 0}, {0, 1, 0}, {0, 0, 2}, {-1, 1, 0}})), Error);
}

TEST(JoinedByKey, KeepsTheFirstOfEachKey) {
    SurfaceArrays arrays = test::to_arrays(test::join(test::tetrahedron(), test::tetrahedron()));
    arrays.vertex_key = {9, 7, 5, 3, 1, 5, 2, 9};
    const SurfaceArrays joined = joined_by_key(arrays);
    EXPECT_EQ(joined.vertex_key, (std::vector<Key>{9, 7, 5, 3, 1, 2}));
    EXPECT_EQ(joined.facets[4], (Triangle{4, 5, 2}));
    EXPECT_EQ(joined.facets[7], (Triangle{2, 5, 0}));
    EXPECT_EQ(joined.facet_key, arrays.facet_key);
}

TEST(CopiedVertices, AreFoundForKeysOfAnySize) {
    for (const std::int32_t factor : {1, 100000000}) {
        SurfaceArrays arrays = test::to_arrays(test::join(test::tetrahedron(), test::tetrahedron()));
        for (std::int32_t v = 0; v < 8; ++v) arrays.vertex_key[v] = make_key(NodeId(v % 3), factor * v);
        EXPECT_TRUE(copied_vertices(Surface(arrays)).empty());
        arrays.vertex_key[6] = arrays.vertex_key[1];
        EXPECT_EQ(copied_vertices(Surface(arrays)), (std::vector<char>{0, 1, 0, 0, 0, 0, 1, 0}));
    }
}

}  // namespace
}  // namespace kerf

#include "surface/diagnosis/intersections.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/threads.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/predicates.h"
#include "support/shapes.h"
#include "surface/diagnosis/orientation.h"

namespace kerf {
namespace {

using Lattice = Eigen::Matrix<std::int64_t, 3, 1>;
using LatticeTriangle = std::array<Lattice, 3>;
using Corners = std::array<Vec3, 3>;

// Oracle: two convex sets with integer corners are disjoint if and only if one of finitely many axes separates them.
class SeparatingAxis {
 public:
    static bool meet(const LatticeTriangle& p, const LatticeTriangle& q) {
        const std::array<Lattice, 3> e = edges(p), f = edges(q);
        std::vector<Lattice> axes = {e[0].cross(e[1]), f[0].cross(f[1])};
        for (const Lattice& n : {axes[0], axes[1]})
            for (int i = 0; i < 3; ++i) axes.insert(axes.end(), {n.cross(e[i]), n.cross(f[i])});
        for (int i = 0; i < 3; ++i) {
            axes.insert(axes.end(), {e[i], f[i]});
            for (int j = 0; j < 3; ++j) axes.push_back(e[i].cross(f[j]));
        }
        return std::none_of(axes.begin(), axes.end(), [&](const Lattice& axis) { return separates(axis, p, q); });
    }

 private:
    static std::array<Lattice, 3> edges(const LatticeTriangle& t) { return {t[1] - t[0], t[2] - t[1], t[0] - t[2]}; }
    static bool separates(const Lattice& axis, const LatticeTriangle& p, const LatticeTriangle& q) {
        const auto [p_low, p_high] = std::minmax({axis.dot(p[0]), axis.dot(p[1]), axis.dot(p[2])});
        const auto [q_low, q_high] = std::minmax({axis.dot(q[0]), axis.dot(q[1]), axis.dot(q[2])});
        return p_high < q_low || q_high < p_low;
    }
};

class RandomTriangles {
 public:
    RandomTriangles(unsigned seed, int range) : random_(seed), coordinate_(0, range) {}
    Lattice point() { return {coordinate_(random_), coordinate_(random_), coordinate_(random_)}; }
    // Corners not on one line.
    LatticeTriangle triangle() {
        for (;;) {
            const LatticeTriangle t = {point(), point(), point()};
            if (!is_flat(t)) return t;
        }
    }
    static bool is_flat(const LatticeTriangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]).isZero(); }

 private:
    std::mt19937 random_;
    std::uniform_int_distribution<std::int64_t> coordinate_;
};

Corners to_corners(const LatticeTriangle& t) { return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()}; }

constexpr Triangle first_ids = {0, 1, 2};

TEST(TrianglesIntersect, AgreesWithSeparatingAxesWhereNothingIsShared) {
    int meeting = 0, apart = 0;
    for (int range : {1, 2, 4, 20}) {  // small lattices are full of coplanar, collinear and touching cases
        SCOPED_TRACE("seed 7, range " + std::to_string(range));
        RandomTriangles random(7, range);
        for (int i = 0; i < 5000; ++i) {
            const LatticeTriangle p = random.triangle(), q = random.triangle();
            const bool expected = SeparatingAxis::meet(p, q);
            ASSERT_EQ(triangles_intersect(to_corners(p), first_ids, to_corners(q), {3, 4, 5}), expected) << i;
            ++(expected ? meeting : apart);
        }
    }
    EXPECT_GT(meeting, 3000);
    EXPECT_GT(apart, 3000);
}

TEST(TrianglesIntersect, AgreesInOnePlane) {
    int meeting = 0, apart = 0;
    RandomTriangles random(11, 6);
    for (int i = 0; i < 10000; ++i) {
        LatticeTriangle p = random.triangle(), q = random.triangle();
        for (LatticeTriangle* t : {&p, &q})
            for (Lattice& x : *t) x[2] = 2 * x[0] - 3 * x[1];
        if (RandomTriangles::is_flat(p) || RandomTriangles::is_flat(q)) continue;
        const bool expected = SeparatingAxis::meet(p, q);
        ASSERT_EQ(triangles_intersect(to_corners(p), first_ids, to_corners(q), {3, 4, 5}), expected)
            << "seed 11, " << i;
        ++(expected ? meeting : apart);
    }
    EXPECT_GT(meeting, 1000);
    EXPECT_GT(apart, 1000);
}

TEST(TrianglesIntersect, TakesCollinearCornersForASegment) {
    int meeting = 0, apart = 0;
    for (int range : {1, 2, 4}) {
        SCOPED_TRACE("seed 29, range " + std::to_string(range));
        RandomTriangles random(29, range);
        for (int i = 0; i < 5000; ++i) {
            const Lattice a = random.point(), d = random.point() - a;
            const LatticeTriangle p = i % 2 ? random.triangle() : LatticeTriangle{random.point(), a + d, a - d};
            const LatticeTriangle q = {a, a + 2 * d, a + (i % 5) * d};
            const bool expected = SeparatingAxis::meet(p, q);
            ASSERT_EQ(triangles_intersect(to_corners(p), first_ids, to_corners(q), {3, 4, 5}), expected) << i;
            ASSERT_EQ(triangles_intersect(to_corners(q), first_ids, to_corners(p), {3, 4, 5}), expected) << i;
            ++(expected ? meeting : apart);
        }
    }
    EXPECT_GT(meeting, 1000);
    EXPECT_GT(apart, 1000);
}

TEST(TrianglesIntersect, LooksBeyondASharedVertex) {
    int meeting = 0, apart = 0;
    for (int range : {1, 2, 4, 20}) {
        SCOPED_TRACE("seed 13, range " + std::to_string(range));
        RandomTriangles random(13, range);
        for (int i = 0; i < 5000; ++i) {
            const LatticeTriangle p = random.triangle();
            LatticeTriangle q = random.triangle();
            q[1] = p[2];
            if (RandomTriangles::is_flat(q)) continue;
            const bool expected =
                SeparatingAxis::meet(p, {q[0], q[2], q[2]}) || SeparatingAxis::meet({p[0], p[1], p[1]}, q);
            ASSERT_EQ(triangles_intersect(to_corners(p), first_ids, to_corners(q), {3, 2, 4}), expected) << i;
            ++(expected ? meeting : apart);
        }
    }
    EXPECT_GT(meeting, 3000);
    EXPECT_GT(apart, 3000);
}

TEST(TrianglesIntersect, LooksBeyondASharedEdge) {
    int meeting = 0, apart = 0;
    for (int range : {1, 2, 4}) {
        SCOPED_TRACE("seed 17, range " + std::to_string(range));
        RandomTriangles random(17, range);
        for (int i = 0; i < 5000; ++i) {
            const LatticeTriangle p = random.triangle();
            const LatticeTriangle q = {p[1], random.point(), p[0]};
            if (RandomTriangles::is_flat(q)) continue;
            const Lattice n = (p[1] - p[0]).cross(p[2] - p[0]), m = (p[1] - p[0]).cross(q[1] - p[0]);
            const bool expected = n.cross(m).isZero() && n.dot(m) > 0;
            ASSERT_EQ(triangles_intersect(to_corners(p), first_ids, to_corners(q), {1, 3, 0}), expected) << i;
            ++(expected ? meeting : apart);
        }
    }
    EXPECT_GT(meeting, 500);
    EXPECT_GT(apart, 3000);
}

TEST(TrianglesIntersect, DoesNotDependOnTheOrderOfTrianglesAndCorners) {
    RandomTriangles random(19, 3);
    std::mt19937 turn(19);
    for (int i = 0; i < 5000; ++i) {
        Corners p = to_corners(random.triangle()), q = to_corners(random.triangle());
        Triangle p_id = first_ids, q_id = {3, 4, 5};
        for (std::uint32_t shared = turn() % 3, k = 0; k < shared; ++k) q[k] = p[k], q_id[k] = p_id[k];
        const bool expected = triangles_intersect(p, p_id, q, q_id);
        ASSERT_EQ(triangles_intersect(q, q_id, p, p_id), expected) << "seed 19, " << i;
        const std::uint32_t shift = turn() % 3;
        std::rotate(p.begin(), p.begin() + shift, p.end());
        std::rotate(p_id.begin(), p_id.begin() + shift, p_id.end());
        std::swap(q[0], q[1]), std::swap(q_id[0], q_id[1]);
        ASSERT_EQ(triangles_intersect(p, p_id, q, q_id), expected) << "seed 19, " << i;
    }
}

TEST(TrianglesIntersect, IsExactWhereRoundingWouldErr) {
    const Corners p = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    const double tiny = 1e-300;
    const auto standing_at = [](double z) {
        return Corners{Vec3(0.25, 0.25, z), Vec3(0.3, 0.2, 1), Vec3(0.2, 0.3, 1)};
    };
    EXPECT_FALSE(triangles_intersect(p, first_ids, standing_at(tiny), {3, 4, 5}));
    EXPECT_TRUE(triangles_intersect(p, first_ids, standing_at(0), {3, 4, 5}));
    EXPECT_TRUE(triangles_intersect(p, first_ids, standing_at(-tiny), {3, 4, 5}));
    EXPECT_TRUE(triangles_intersect(p, first_ids, p, {2, 0, 1})) << "the same three vertices";
}

TEST(MeetingPlace, IsOnBothFacets) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
    int meeting = 0;
    for (int i = 0; i < 2000; ++i) {
        std::vector<Vec3> v;
        for (int k = 0; k < 6; ++k) v.push_back(point());
        Triangle s = {0, 1, 2}, t = {3, 4, 5};
        if (i % 3 == 1) t[0] = 0;                                       // a corner is shared
        if (i % 3 == 2) v[4] = 0.5 * v[0] + 0.25 * v[1] + 0.25 * v[2];  // a corner touches the other facet
        const Vec3 place = meeting_place(v, s, t);
        if (!triangles_intersect({v[s[0]], v[s[1]], v[s[2]]}, s, {v[t[0]], v[t[1]], v[t[2]]}, t)) continue;
        ++meeting;
        EXPECT_LT(point_triangle_distance(place, v[s[0]], v[s[1]], v[s[2]]), 1e-12) << i;
        EXPECT_LT(point_triangle_distance(place, v[t[0]], v[t[1]], v[t[2]]), 1e-12) << i;
        EXPECT_NE(place, v[0]) << i;
    }
    EXPECT_GT(meeting, 200);
}

TEST(FindSelfIntersections, AgreesWithAllPairs) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        RandomTriangles random(seed, 12);
        std::vector<Vec3> vertices;
        for (int i = 0; i < 60; ++i) vertices.push_back(random.point().cast<double>());
        std::mt19937 choice(seed);
        std::vector<Triangle> facets;
        while (facets.size() < 80) {
            const auto pick = [&] { return static_cast<std::int32_t>(choice() % vertices.size()); };
            const Triangle t = {pick(), pick(), pick()};
            if (!are_collinear(vertices[t[0]], vertices[t[1]], vertices[t[2]])) facets.push_back(t);
        }
        const auto corners = [&](const Triangle& t) { return Corners{vertices[t[0]], vertices[t[1]], vertices[t[2]]}; };
        std::vector<std::pair<std::int32_t, std::int32_t>> expected;
        for (std::int32_t f = 0; f < 80; ++f)
            for (std::int32_t g = f + 1; g < 80; ++g)
                if (triangles_intersect(corners(facets[f]), facets[f], corners(facets[g]), facets[g]))
                    expected.emplace_back(f, g);
        ASSERT_GT(expected.size(), 10u);
        EXPECT_EQ(find_self_intersections(vertices, facets, 100000), expected);
        expected.resize(expected.size() / 10);
        EXPECT_EQ(find_self_intersections(vertices, facets, expected.size()), expected) << "the first, not just any";
    }
}

TEST(FindSelfIntersections, FindsNoneOnEmbeddedSurfaces) {
    for (const Soup& soup : {test::tetrahedron(), test::box(Vec3(0, 0, 0), Vec3(1, 2, 3), 5), test::icosphere(3),
                             test::torus(3, 1, 30, 20), test::nested_boxes(4, 3)}) {
        SCOPED_TRACE(soup.patch_names.front());
        EXPECT_TRUE(find_self_intersections(soup.vertices, soup.facets).empty());
    }
}

// With a small limit the search may end before all pairs are found; what it returns is true and the same every time.
TEST(FindSelfIntersections, KeepsToItsLimitInASoupThatIsNoSurface) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(0, 1);
    std::vector<Vec3> vertices;
    for (int i = 0; i < 600; ++i) vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    std::vector<Triangle> facets;
    for (int i = 0; i < 600; i += 3) facets.push_back({i, i + 1, i + 2});
    const auto all = find_self_intersections(vertices, facets, facets.size() * facets.size());
    ASSERT_GT(all.size(), 400u);
    for (const std::size_t limit : {1, 5, 1000, 100'000}) {
        SCOPED_TRACE(limit);
        const auto some = find_self_intersections(vertices, facets, limit);
        EXPECT_EQ(some.size(), std::min(limit, all.size()));
        EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
        EXPECT_EQ(some, find_self_intersections(vertices, facets, limit));
        if (20 * limit > all.size()) {
            EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin()));
        }
    }
}

// Spheres at random: most pairs of facets are neighbours or apart, some hundred cross.
Soup crossing_spheres(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 10);
    Soup soup;
    for (int i = 0; i < 12; ++i) {
        const Vec3 centre(coordinate(random), coordinate(random), coordinate(random));
        soup = test::join(std::move(soup), test::icosphere(3, 1.5, centre));
    }
    return soup;
}

TEST(FindSelfIntersections, IsTheSameForAnyNumberOfThreadsAndHopelessOrNot) {
    const Soup soup = crossing_spheres(5);
    for (const std::size_t limit : {1, 3, 10, 100'000}) {
        SCOPED_TRACE(limit);
        std::vector<IntersectingPairs> found;
        for (const int threads : {1, 2, 7}) {
            set_thread_limit(threads);
            found.push_back(find_self_intersections(soup.vertices, soup.facets, limit));
        }
        set_thread_limit(static_cast<int>(std::thread::hardware_concurrency()));
        EXPECT_GT(found[0].size(), std::min<std::size_t>(limit, 200) - 1);
        EXPECT_EQ(found[1], found[0]);
        EXPECT_EQ(found[2], found[0]);
    }
}

TEST(SelfIntersectionSearch, FindsInSharesWhatItFindsAtOnce) {
    for (const Soup& soup : {crossing_spheres(6), test::tetrahedron(), Soup()}) {
        const SelfIntersectionSearch search(soup.vertices, soup.facets);
        const IntersectingPairs all = find_self_intersections(soup.vertices, soup.facets, 100'000);
        for (const std::size_t shares : {1, 2, 3, 8, 100})
            for (const std::size_t limit : {std::size_t{100'000}, all.size() / 10 + 1}) {
                IntersectingPairs found;
                for (std::size_t share = 0; share < shares; ++share) {
                    const IntersectingPairs part = search.pairs_of_share(share, shares, limit);
                    EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
                    EXPECT_LE(part.size(), limit);
                    found.insert(found.end(), part.begin(), part.end());
                }
                std::sort(found.begin(), found.end());
                found.resize(std::min(found.size(), limit));
                IntersectingPairs expected = all;
                expected.resize(std::min(all.size(), limit));
                EXPECT_EQ(found, expected) << shares << " shares, limit " << limit;
            }
    }
}

// Facets of all sizes and shapes, at places that floats cannot tell from each other or cannot hold.
TEST(FindSelfIntersections, AgreesWithAllPairsWhereverTheSoupLies) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const double scale : {1.0, 1e30, 1e-30})
        for (const double distance : {0.0, 1e7})
            for (const bool is_flat : {false, true}) {
                SCOPED_TRACE(testing::Message() << "scale " << scale << ", at " << distance << ", flat " << is_flat);
                std::vector<Vec3> vertices;
                std::vector<Triangle> facets;
                for (int i = 0; i < 120; ++i) {
                    const Vec3 centre(unit(random), unit(random), is_flat ? 0 : unit(random));
                    const double size = 0.3 * std::pow(10, 2 * unit(random) - 1);
                    for (int c = 0; c < 3; ++c) {
                        const Vec3 corner(unit(random), unit(random), is_flat ? 0 : unit(random));
                        vertices.emplace_back(scale * (centre + size * corner + Vec3::Constant(distance)));
                    }
                    facets.push_back({3 * i, 3 * i + 1, 3 * i + 2});
                }
                IntersectingPairs expected;
                const auto corners = [&](std::int32_t f) {
                    return Corners{vertices[3 * f], vertices[3 * f + 1], vertices[3 * f + 2]};
                };
                for (std::int32_t f = 0; f < 120; ++f)
                    for (std::int32_t g = f + 1; g < 120; ++g)
                        if (triangles_intersect(corners(f), facets[f], corners(g), facets[g]))
                            expected.emplace_back(f, g);
                EXPECT_GT(expected.size(), 5u);
                EXPECT_EQ(find_self_intersections(vertices, facets, 100'000), expected);
            }
}

// Shells at random, most of them one in the other, some of which cross.
TEST(NestedShellsAreApart, AgreesWithAllPairs) {
    int apart = 0, crossing = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> shift(-0.05, 0.05);
        Soup soup;
        for (int i = 0; i < 6; ++i) {
            const Vec3 centre(shift(random) + (i == 3 && seed % 2 == 0 ? 0.4 : 0), shift(random), shift(random));
            soup = test::join(std::move(soup), test::icosphere(1, 0.2 + 0.15 * (i * 5 % 6), centre));
        }
        const ConsistentFacets consistent = make_consistent(soup.facets);
        std::vector<std::int32_t> parent;
        for (const ShellPlace& place : locate_shells(soup.vertices, consistent)) parent.push_back(place.parent);
        const bool is_apart = find_self_intersections(soup.vertices, soup.facets).empty();
        EXPECT_EQ(nested_shells_are_apart(soup.vertices, soup.facets, consistent.shell, parent), is_apart);
        ++(is_apart ? apart : crossing);
    }
    EXPECT_GT(apart, 5);
    EXPECT_GT(crossing, 5);
}

TEST(FindIntersectionsOf, AreThoseOfAllPairsWithAChosenFacet) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(0, 1);
        std::vector<Vec3> vertices;
        for (int i = 0; i < 150; ++i) vertices.emplace_back(coordinate(random), coordinate(random), coordinate(random));
        std::vector<Triangle> facets;
        for (int i = 0; i < 150; i += 3) facets.push_back({i, i + 1, i + 2});
        std::vector<char> chosen(facets.size());
        for (char& c : chosen) c = random() % 4 < seed % 5;  // none to all
        auto expected = find_self_intersections(vertices, facets, 100'000);
        ASSERT_FALSE(expected.empty());
        std::erase_if(expected, [&](const auto& pair) { return !chosen[pair.first] && !chosen[pair.second]; });
        EXPECT_EQ(find_intersections_of(chosen, vertices, facets, 100'000), expected);
    }
}

TEST(ExactPredicates, FollowTheSignOfTheDeterminant) {
    RandomTriangles random(23, 2);
    for (int i = 0; i < 2000; ++i) {
        const Lattice a = random.point(), b = random.point(), c = random.point(), d = random.point();
        const std::int64_t det = (b - a).dot((c - a).cross(d - a));
        const int sign = (det > 0) - (det < 0);
        ASSERT_EQ(orientation(a.cast<double>(), b.cast<double>(), c.cast<double>(), d.cast<double>()), sign)
            << "seed 23, " << i;
        ASSERT_EQ(are_collinear(a.cast<double>(), b.cast<double>(), c.cast<double>()),
                  RandomTriangles::is_flat({a, b, c}))
            << "seed 23, " << i;
    }
}

}  // namespace
}  // namespace kerf

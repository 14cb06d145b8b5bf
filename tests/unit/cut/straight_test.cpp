// Facets split at a coordinate plane, the planes that are tried, and the check that pieces are their facet.
#include "cut/cut/straight.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/geometry/triangle.h"
#include "support/shapes.h"
#include "surface/diagnosis/facet_cover.h"

namespace kerf {
namespace {

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Triangle& t, const std::vector<Vec3>& p) { return {p[t[0]], p[t[1]], p[t[2]]}; }

Triangle rotated(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

std::set<Triangle> set_of(const TrianglePieces& pieces, bool turned = false) {
    std::set<Triangle> set;
    for (int i = 0; i < pieces.count; ++i) {
        const Triangle& t = pieces.pieces[i];
        set.insert(rotated(turned ? Triangle{t[0], t[2], t[1]} : t));
    }
    return set;
}

// A random triangle 0, 1, 2 somewhere in space and random points 3, 4, 5 on the edges that begin there.
class RandomTriangle {
 public:
    explicit RandomTriangle(unsigned seed) : random_(seed) {
        const Vec3 offset = 100 * vector();
        for (int i = 0; i < 3; ++i) points.push_back(offset + vector());
        for (int i = 0; i < 3; ++i) points.push_back(points[i] + inner_share() * (points[(i + 1) % 3] - points[i]));
    }
    double inner_share() { return std::uniform_real_distribution(0.05, 0.95)(random_); }

    std::vector<Vec3> points;

 private:
    Vec3 vector() { return {normal_(random_), normal_(random_), normal_(random_)}; }
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

// All ways to divide none, one or two edges.
std::vector<std::array<std::int32_t, 3>> divisions() {
    return {{-1, -1, -1}, {3, -1, -1}, {-1, 4, -1}, {-1, -1, 5}, {3, 4, -1}, {-1, 4, 5}, {3, -1, 5}};
}

template <class Body>
void for_random_triangles(Body body) {
    for (unsigned seed = 1; seed <= 300; ++seed)
        for (const auto& on_edge : divisions()) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", vertices " << on_edge[0] << ' ' << on_edge[1]
                                            << ' ' << on_edge[2] << " on the edges");
            body(RandomTriangle(seed).points, on_edge);
        }
}

TEST(SplitTriangle, PiecesAreTheTriangle) {
    for_random_triangles([](const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& on_edge) {
        const Triangle whole = {0, 1, 2};
        const TrianglePieces pieces = split_triangle(whole, on_edge, points);
        const auto divided = std::count_if(on_edge.begin(), on_edge.end(), [](std::int32_t v) { return v >= 0; });
        ASSERT_EQ(pieces.count, 1 + divided);
        const Vec3 normal = area_vector(corners_of(whole, points));
        std::vector<Corners> corners;
        for (int i = 0; i < pieces.count; ++i) {
            corners.push_back(corners_of(pieces.pieces[i], points));
            EXPECT_GT(area_vector(corners.back()).dot(normal), 0);
        }
        EXPECT_TRUE(covers(corners_of(whole, points), corners));
    });
}

TEST(SplitTriangle, EveryEdgeIsDividedWhereItWasTold) {
    for_random_triangles([](const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& on_edge) {
        const TrianglePieces pieces = split_triangle({0, 1, 2}, on_edge, points);
        std::multiset<std::array<std::int32_t, 2>> open;  // directed edges, less those between two pieces
        for (int i = 0; i < pieces.count; ++i)
            for (int j = 0; j < 3; ++j) {
                const std::int32_t from = pieces.pieces[i][j], to = pieces.pieces[i][(j + 1) % 3];
                if (const auto back = open.find({to, from}); back != open.end())
                    open.erase(back);
                else
                    open.insert({from, to});
            }
        std::multiset<std::array<std::int32_t, 2>> expected;
        for (std::int32_t i = 0; i < 3; ++i) {
            const std::int32_t next = (i + 1) % 3;
            if (on_edge[i] < 0)
                expected.insert({i, next});
            else
                expected.insert({{i, on_edge[i]}, {on_edge[i], next}});
        }
        EXPECT_EQ(open, expected);
    });
}

// The parts on both sides of a facet must split it alike.
TEST(SplitTriangle, FirstCornerAndSideDoNotMatter) {
    for_random_triangles([](const std::vector<Vec3>& points, const std::array<std::int32_t, 3>& on_edge) {
        const std::set<Triangle> expected = set_of(split_triangle({0, 1, 2}, on_edge, points));
        const TrianglePieces shifted = split_triangle({1, 2, 0}, {on_edge[1], on_edge[2], on_edge[0]}, points);
        const TrianglePieces turned = split_triangle({2, 1, 0}, {on_edge[1], on_edge[0], on_edge[2]}, points);
        EXPECT_EQ(set_of(shifted), expected);
        EXPECT_EQ(set_of(turned, true), expected);
    });
}

struct NamedShape {
    std::string name;
    Soup soup;
};
std::ostream& operator<<(std::ostream& out, const NamedShape& shape) { return out << shape.name; }

std::vector<NamedShape> shapes() {
    using namespace test;
    return {{"box", box()},
            {"tetrahedron", tetrahedron()},
            {"needle", box(Vec3::Zero(), Vec3(250, 1, 1))},
            {"sphere", icosphere(3)},
            {"sphere_far_away", icosphere(2, 1, Vec3(1e5, -2e5, 3e5))},
            {"torus", torus(3, 1, 40, 16)},
            {"nested_boxes", nested_boxes(4, 3)},
            {"linked_rings", linked_rings(3, 24, 9)},
            {"cavities", block_with_cavities({3, 2, 2})},
            {"porous_frame", porous_frame(2, 1)}};
}

class SplitShape : public testing::TestWithParam<NamedShape> {
 protected:
    SplitShape() : surface_(test::to_arrays(GetParam().soup)) {
        for (const Vec3& p : GetParam().soup.vertices) box_.extend(p);
    }
    // Splits at random heights.
    template <class Body>
    void for_random_planes(Body body) const {
        std::mt19937 random(1);
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < 8; ++i) {
                const double height = std::uniform_real_distribution(box_.min()[axis], box_.max()[axis])(random);
                SCOPED_TRACE(testing::Message() << "seed 1, axis " << axis << ", height " << height);
                const std::optional<PlaneSplit> split = split_at_plane(surface_, axis, height, NodeId(5));
                ASSERT_TRUE(split.has_value());
                body(*split, axis, height);
            }
    }

    Surface surface_;
    Eigen::AlignedBox3d box_;
};
INSTANTIATE_TEST_SUITE_P(Shapes, SplitShape, testing::ValuesIn(shapes()),
                         [](const auto& param) { return param.param.name; });

TEST_P(SplitShape, StaysClosedWithItsVolume) {
    const double spacing = box_.min().cwiseAbs().cwiseMax(box_.max().cwiseAbs()).maxCoeff() * 1e-15;
    const MassProperties mass = mass_properties(surface_);
    for_random_planes([&](const PlaneSplit& split, int, double) {
        const SurfaceArrays& arrays = split.arrays;
        EXPECT_TRUE(find_manifold_defects(arrays.vertices.size(), arrays.facets).empty());
        EXPECT_NEAR(enclosed_volume(arrays.vertices, arrays.facets), mass.volume,
                    1e-12 * mass.volume + spacing * mass.area);
    });
}

TEST_P(SplitShape, EveryCrossedEdgeHasOneNewVertexOnThePlane) {
    for_random_planes([&](const PlaneSplit& split, int axis, double height) {
        const auto old_count = static_cast<std::size_t>(surface_.vertex_count());
        std::set<SurfaceEdge> crossed, divided;  // from below to above
        for (const Facet f : surface_.facets())
            for (const HalfEdge h : surface_.half_edges(f)) {
                const Vertex from = surface_.from_vertex(h), to = surface_.to_vertex(h);
                if (surface_.point(from)[axis] < height && surface_.point(to)[axis] > height)
                    crossed.insert({from, to});
            }
        ASSERT_EQ(split.arrays.vertices.size(), old_count + split.edges.size());
        for (std::size_t i = 0; i < split.edges.size(); ++i) {
            const SplitEdge& edge = split.edges[i];
            divided.insert({Vertex(edge.below), Vertex(edge.above)});
            EXPECT_EQ(edge.vertex, static_cast<std::int32_t>(old_count + i));
            EXPECT_EQ(split.arrays.vertices[edge.vertex][axis], height);
            EXPECT_EQ(split.arrays.vertex_key[edge.vertex], make_key(NodeId(5), static_cast<std::int32_t>(i)));
        }
        EXPECT_EQ(divided, crossed);
        EXPECT_EQ(divided.size(), split.edges.size());
        for (std::size_t v = 0; v < old_count; ++v) {
            EXPECT_EQ(split.arrays.vertices[v], surface_.point(Vertex(v)));
            EXPECT_EQ(key_node(split.arrays.vertex_key[v]), input_node);
        }
    });
}

TEST_P(SplitShape, PiecesAreTheirFacetsAndLieOnTheirSide) {
    for_random_planes([&](const PlaneSplit& split, int axis, double height) {
        const SurfaceArrays& arrays = split.arrays;
        Array<Facet, std::vector<Corners>> pieces(surface_.facet_count());
        EXPECT_TRUE(std::is_sorted(split.parent.begin(), split.parent.end()));
        for (std::size_t f = 0; f < arrays.facets.size(); ++f) {
            const Corners corners = corners_of(arrays.facets[f], arrays.vertices);
            pieces.at(split.parent[f].value()).push_back(corners);
            EXPECT_EQ(arrays.facet_key[f], surface_.facet_key(split.parent[f]));
            EXPECT_EQ(arrays.patch[f], surface_.patch(split.parent[f]));
            for (const Vec3& p : corners)
                EXPECT_TRUE(split.side[f] == Side::below ? p[axis] <= height : p[axis] >= height);
        }
        for (const Facet f : surface_.facets()) {
            const auto t = surface_.corners(f);
            EXPECT_TRUE(covers({surface_.point(t[0]), surface_.point(t[1]), surface_.point(t[2])}, pieces[f]));
        }
    });
}

TEST_P(SplitShape, PlaneThroughAVertexIsRefused) {
    for (int axis = 0; axis < 3; ++axis)
        for (std::int32_t v = 0; v < surface_.vertex_count(); v += 7)
            EXPECT_FALSE(split_at_plane(surface_, axis, surface_.point(Vertex(v))[axis], root_node).has_value());
}

// The heights between which the load is as wanted, and `margin` beyond: a plane stays clear of the vertex that ends its
// gap, also where that lies at the end of the window.
std::array<double, 2> load_window(const Surface& surface, int axis, double fraction, const CutOptions& options) {
    constexpr double margin = 0.0101;  // of the extent
    const LoadProfile profile(surface, Plane(Vec3::Zero(), Vec3::Unit(axis)), options.load());
    const double away = margin * (profile.highest() - profile.lowest());
    return {profile.bisect(fraction - options.load_window) - away,
            profile.bisect(fraction + options.load_window) + away};
}

TEST_P(SplitShape, PlanesStayClearOfVerticesAndInsideOfTheLoadWindow) {
    CutOptions options;
    for (const double fraction : {1 / 3.0, 0.5})
        for (options.axis = -1; options.axis < 3; ++options.axis) {
            SCOPED_TRACE(testing::Message() << "fraction " << fraction << ", axis " << options.axis);
            const std::vector<StraightPlane> planes = straight_planes(surface_, fraction, options);
            ASSERT_FALSE(planes.empty());
            EXPECT_LE(planes.size(), 12u);
            EXPECT_TRUE(split_at_plane(surface_, planes[0].axis, planes[0].height, root_node).has_value());
            for (const auto& [axis, height] : planes) {
                EXPECT_TRUE(options.axis < 0 || axis == options.axis);
                for (const Vec3& p : GetParam().soup.vertices) EXPECT_NE(p[axis], height);
                const auto [low, high] = load_window(surface_, axis, fraction, options);
                EXPECT_GE(height, low);
                EXPECT_LE(height, high);
            }
        }
}

// A cover of a random triangle by the pieces of pieces: some ten.
std::vector<Corners> random_cover(unsigned seed) {
    RandomTriangle start(seed);
    std::vector<Vec3>& points = start.points;
    std::vector<Corners> cover = {{points[0], points[1], points[2]}};
    for (std::size_t i = 0; i < 4; ++i) {
        const Corners t = cover[i];
        const auto on_edge = [&](int j) -> Vec3 { return t[j] + start.inner_share() * (t[(j + 1) % 3] - t[j]); };
        const std::vector<Vec3> local = {t[0], t[1], t[2], on_edge(0), on_edge(1)};
        const TrianglePieces pieces = split_triangle({0, 1, 2}, {3, 4, -1}, local);
        for (int j = 0; j < pieces.count; ++j) cover.push_back(corners_of(pieces.pieces[j], local));
    }
    cover.erase(cover.begin(), cover.begin() + 4);
    return cover;
}

TEST(FacetCover, IsAcceptedAndEveryDamageIsRefused) {
    for (unsigned seed = 1; seed <= 100; ++seed) {
        const RandomTriangle triangle(seed);
        const Corners facet = corners_of({0, 1, 2}, triangle.points);
        const std::vector<Corners> cover = random_cover(seed);
        ASSERT_EQ(cover.size(), 9u);
        EXPECT_TRUE(covers(facet, cover)) << "seed " << seed;
        EXPECT_FALSE(covers({facet[0], facet[2], facet[1]}, cover)) << "seed " << seed;
        for (std::size_t i = 0; i < cover.size(); ++i) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", piece " << i);
            std::vector<Corners> missing = cover, doubled = cover, turned = cover, moved = cover, lifted = cover;
            missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(i));
            doubled.push_back(cover[i]);
            std::swap(turned[i][1], turned[i][2]);
            moved[i][0] += 1e-3 * (cover[i][1] - cover[i][0]);
            lifted[i][0] += 1e-6 * area_vector(facet).normalized();
            for (const auto& damaged : {missing, doubled, turned, moved, lifted}) EXPECT_FALSE(covers(facet, damaged));
        }
    }
}

}  // namespace
}  // namespace kerf

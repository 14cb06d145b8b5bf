// Interface, acceptance and split: from a contour to two closed halves.
#include "cut/cut/inside/acceptance.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "cut/cut/inside/contour.h"
#include "cut/cut/inside/shell_placement.h"
#include "cut/cut/split.h"
#include "support/voxels.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/touching.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {
namespace {

constexpr NodeId cut_node(5);

// A body, its plane at height z, and the interface there.
struct Section {
    Section(const Soup& soup, double z)
        : surface(test::to_arrays(soup)),
          band(make_band(surface, Plane(Vec3(0, 0, z), Vec3::UnitZ()))),
          side(band.majority) {
        clean_labels(surface, band, side, nullptr);
        const ContourLoops contour = trace_loops(surface, contour_edges(surface, band, side));
        const std::vector<std::int32_t> hits(band.vertices.size(), 0);
        InterfaceAttempt attempt = build_interface(surface, band, side, contour.loops, hits, CutOptions());
        EXPECT_EQ(attempt.refusal, Refusal::none);
        interface = std::move(attempt.interface);
    }
    Verdict judge() const { return judge_interface(surface, band, interface, options); }

    Surface surface;
    Band band;
    Array<Facet, Side> side;
    Interface interface;
    CutOptions options;
};

std::vector<Soup> bodies() {
    return {test::box(Vec3(-1, -1, -1), Vec3(1, 1, 1), 8), test::nested_boxes(2, 10), test::icosphere(3),
            test::torus(3, 1, 40, 20)};
}

TEST(Interface, SpansTheSection) {
    for (const Soup& soup : bodies()) {
        const Section s(soup, 0.03);
        EXPECT_NEAR(interface_area(s.interface), s.band.section_area, 0.1 * s.band.section_area);
        for (std::size_t i = 0; i < s.interface.contour.size(); ++i)
            EXPECT_EQ(s.interface.points[i], s.surface.point(s.interface.contour[i]));
        EXPECT_EQ(s.interface.planar.size(), s.interface.points.size());
        EXPECT_NE(s.judge().refusal, Refusal::intersection);
        EXPECT_NE(s.judge().refusal, Refusal::chord);
    }
}

TEST(Acceptance, GoodInterfaceHasGoodAngles) {
    Section s(test::box(Vec3(-1, -1, -1), Vec3(1, 1, 1), 8), 0.03);
    const Verdict verdict = s.judge();
    EXPECT_EQ(verdict.refusal, Refusal::none);
    EXPECT_TRUE(verdict.failed.empty());
    EXPECT_GT(verdict.quality.dihedral_deg, 45);
    EXPECT_GT(verdict.quality.angle_deg, 20);
    EXPECT_GT(verdict.quality.gap_rel, 0.2);
    s.options.good_angle_deg = 60;
    EXPECT_EQ(s.judge().refusal, Refusal::soft);
    EXPECT_FALSE(s.judge().failed.empty());
}

TEST(Acceptance, ShiftedPointThatPiercesTheSurfaceIsFound) {
    for (const double height : {-5.0, 5.0}) {
        Section s(test::box(Vec3(-1, -1, -1), Vec3(1, 1, 1), 8), 0.03);
        ASSERT_GT(s.interface.points.size(), s.interface.contour.size());
        s.interface.points.back().z() = height;
        const Verdict verdict = s.judge();
        EXPECT_EQ(verdict.refusal, Refusal::intersection);
        EXPECT_FALSE(verdict.failed.empty());
        for (const Vertex v : verdict.failed) EXPECT_TRUE(s.surface.has_vertex(v));
    }
}

TEST(Acceptance, FoldedInterfaceIsFound) {
    Section s(test::box(Vec3(-1, -1, -1), Vec3(1, 1, 1), 8), 0.03);
    // A triangle of interior points, stood upright through its neighbours.
    const auto count = static_cast<std::int32_t>(s.interface.contour.size());
    const auto inside = std::find_if(s.interface.triangles.begin(), s.interface.triangles.end(),
                                     [&](const Triangle& t) { return *std::min_element(t.begin(), t.end()) >= count; });
    ASSERT_NE(inside, s.interface.triangles.end());
    std::swap(s.interface.points[(*inside)[0]], s.interface.points[(*inside)[1]]);
    EXPECT_EQ(s.judge().refusal, Refusal::intersection);
}

// A small triangle near a facet, on a plane of any direction far from the origin, where rounding is as large as the
// gap.
TEST(Acceptance, WhateverMeetsIsFoundFarFromTheOrigin) {
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    const auto direction = [&] { return Vec3(uniform(), uniform(), uniform()).normalized(); };
    int meetings = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        SCOPED_TRACE(trial);
        const Vec3 place = 1e6 * direction();
        const Surface surface = test::to_surface(test::translated(test::tetrahedron(), place));
        const auto facet = surface.corners(Facet(random() % 4));
        const Plane plane(place + 0.1 * direction(), direction());
        // A corner of the triangle is the place of a vertex of the facet or one on an edge, up to rounding.
        const double t = trial % 2 ? 0 : 0.5 + 0.4 * uniform();
        const Vec3 target = (1 - t) * surface.point(facet[0]) + t * surface.point(facet[1]);
        const Vec3 away = 0.2 * (target - place).normalized();
        Interface interface;
        for (const Vec3& p : {target, Vec3(target + away + 0.1 * direction()), Vec3(target + away)}) {
            interface.planar.push_back(plane.project(p));
            interface.points.push_back(plane.lift(interface.planar.back(), plane.distance(p)));
        }
        interface.triangles = {{0, 1, 2}};
        const std::array<Vec3, 3> corners = {interface.points[0], interface.points[1], interface.points[2]};
        bool meets = false;
        for (const Facet f : surface.facets()) {
            const auto v = surface.corners(f);
            meets |=
                triangles_intersect(corners, {4, 5, 6}, {surface.point(v[0]), surface.point(v[1]), surface.point(v[2])},
                                    surface.triangle(f));
        }
        meetings += meets;
        EXPECT_EQ(judge_interface(surface, make_band(surface, plane), interface, CutOptions()).refusal ==
                      Refusal::intersection,
                  meets);
    }
    EXPECT_GT(meetings, 100);
}

TEST(Acceptance, TinyVoidsKeepTheirSign) {
    std::mt19937 random(3);
    const auto uniform = [&] { return 0.1 + 0.8 * static_cast<double>(random()) / 4294967296.0; };
    for (int place = 0; place < 30; ++place) {
        SCOPED_TRACE(place);
        const Soup shell = test::icosphere(2, 3e-6, Vec3(uniform(), uniform(), uniform()));
        EXPECT_EQ(find_misplaced_shell(test::to_surface(test::join(test::box(), test::inside_out(shell)))),
                  Vertex::none());
        EXPECT_EQ(find_misplaced_shell(test::to_surface(test::join(test::box(), shell))), Vertex(8));
    }
}

TEST(Acceptance, ShellsMustLieInTheMaterial) {
    const auto misplaced = [](const Soup& soup) { return find_misplaced_shell(test::to_surface(soup)).value(); };
    EXPECT_EQ(misplaced(test::box()), -1);
    EXPECT_EQ(misplaced(test::inside_out(test::box())), 0);
    EXPECT_EQ(misplaced(test::nested_boxes(2)), -1);
    EXPECT_EQ(misplaced(test::nested_boxes(4)), -1);
    EXPECT_EQ(misplaced(test::join(test::box(), test::translated(test::box(), Vec3(3, 0, 0)))), -1);
    EXPECT_EQ(misplaced(test::join(test::box(), test::inside_out(test::translated(test::box(), Vec3(3, 0, 0))))), 8)
        << "a void outside of the material";
    EXPECT_GE(misplaced(test::join(test::box(Vec3::Zero(), Vec3::Constant(9), 1),
                                   test::translated(test::box(), Vec3(3, 3, 3)))),
              0)
        << "material inside of material";
}

// No vertex says where a cube lies that touches others at all of its corners.
TEST(Acceptance, ShellsMayTouchOneAnother) {
    test::Voxels checkerboard;
    for (int i = 0; i < 27; ++i)
        if ((i / 9 + i / 3 + i) % 2 == 0) checkerboard.insert({i / 9, i / 3 % 3, i % 3});
    const test::Voxels at_vertex = {{0, 0, 0}, {1, 1, 1}}, at_edge = {{0, 0, 0}, {1, 1, 0}};
    for (const test::Voxels& voxels : {at_vertex, at_edge, checkerboard, test::notched_voxels()}) {
        const Soup soup = test::voxel_surface(voxels);
        EXPECT_FALSE(find_misplaced_shell(separated_surface(test::to_arrays(soup))).is_valid());
        EXPECT_TRUE(find_misplaced_shell(separated_surface(test::to_arrays(test::inside_out(soup)))).is_valid());
    }
}

// Voids near the plane, some of which get the label of the wrong half.
TEST(ShellPlacement, ShellsThatAreNotAskedAreInTheirPlace) {
    std::mt19937 random(11);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    int misplaced = 0, unasked = 0;
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        Soup soup = bodies()[0];
        for (int i = 0; i <= trial % 3; ++i) {
            const double depth = 0.1 + 0.5 * uniform(), height = uniform() < 0.5 ? depth : -depth;
            const Vec3 centre(0.4 * (i - 1), 0.5 * uniform() - 0.25, height);
            soup = test::join(soup, test::inside_out(test::icosphere(1, 0.06, centre)));
        }
        Section s(soup, 0.01);
        const Components shells = find_shells(s.surface);
        std::vector<char> is_turned(static_cast<std::size_t>(shells.count), 0);
        for (std::size_t shell = 1; shell < is_turned.size(); ++shell) is_turned[shell] = uniform() < 0.3;
        for (std::size_t f = 0; f < s.side.size(); ++f)
            if (is_turned[shells.of[f]]) s.side[f] = other(s.side[f]);
        const HeightSpan shared = shared_heights(s.band, s.side, s.interface);
        const bool in_doubt = may_misplace_shells(s.surface, s.band, s.side, shared);
        unasked += !in_doubt;
        for (Half& half : split(s.surface, s.side, s.interface, cut_node)) {
            const Surface surface(std::move(half.arrays));
            const Vertex found = find_misplaced_shell(surface);
            EXPECT_EQ(in_doubt ? find_misplaced_shell(surface, s.band.plane, shared) : Vertex::none(), found);
            misplaced += found.is_valid();
        }
    }
    EXPECT_GT(misplaced, 10);
    EXPECT_GT(unasked, 10);
}

TEST(Split, FacetsArePartitionedAndInterfacesOpposite) {
    for (const Soup& soup : bodies()) {
        const Section s(soup, 0.03);
        const std::array<Half, 2> split_halves = split(s.surface, s.side, s.interface, cut_node);
        const std::array<SurfaceArrays, 2> halves = {split_halves[0].arrays, split_halves[1].arrays};
        const std::size_t interface_facets = s.interface.triangles.size();
        std::set<Key> seen;
        double volume = 0;
        for (int i = 0; i < 2; ++i) {
            const SurfaceArrays& half = halves[i];
            EXPECT_TRUE(find_manifold_defects(half.vertices.size(), half.facets).empty());
            volume += enclosed_volume(half.vertices, half.facets);
            const std::size_t own = half.facets.size() - interface_facets;
            for (std::size_t f = 0; f < own; ++f) {
                const Facet parent(key_index(half.facet_key[f]));
                EXPECT_TRUE(seen.insert(half.facet_key[f]).second) << "a facet in both halves";
                EXPECT_EQ(s.side[parent], i == 0 ? Side::below : Side::above);
                EXPECT_EQ(half.patch[f], s.surface.patch(parent));
                const auto t = s.surface.corners(parent);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_EQ(half.vertex_key[half.facets[f][k]], s.surface.vertex_key(t[k]));
                    EXPECT_EQ(half.vertices[half.facets[f][k]], s.surface.point(t[k]));
                }
            }
        }
        EXPECT_EQ(seen.size(), static_cast<std::size_t>(s.surface.facet_count()));
        EXPECT_NEAR(volume, enclosed_volume(s.surface), 1e-12 * volume);
        for (std::size_t j = 0; j < interface_facets; ++j) {
            const std::size_t f0 = halves[0].facets.size() - interface_facets + j;
            const std::size_t f1 = halves[1].facets.size() - interface_facets + j;
            EXPECT_EQ(halves[0].facet_key[f0], make_key(cut_node, static_cast<std::int32_t>(j)));
            EXPECT_EQ(halves[1].facet_key[f1], halves[0].facet_key[f0]);
            EXPECT_EQ(halves[0].patch[f0], -1);
            EXPECT_EQ(halves[1].patch[f1], -1);
            const Triangle &a = halves[0].facets[f0], &b = halves[1].facets[f1];
            for (const auto& [k, l] : {std::array{0, 0}, std::array{1, 2}, std::array{2, 1}}) {
                EXPECT_EQ(halves[0].vertex_key[a[k]], halves[1].vertex_key[b[l]]);
                EXPECT_EQ(halves[0].vertices[a[k]], halves[1].vertices[b[l]]);
            }
        }
    }
}

}  // namespace
}  // namespace kerf

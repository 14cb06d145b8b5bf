#include "fill/volume/meshers.h"
#include "fill/volume/tet_forecast.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "cut/cut/inside/load.h"
#include "files/io/surface_reader.h"
#include "fill/mesh/quality.h"
#include "fill/mesh/verification.h"
#include "support/shapes.h"

namespace kerf {
namespace {

struct NamedSurface {
    std::string name;
    SurfaceArrays surface;
};

std::vector<NamedSurface> surfaces() {
    return {{"tetrahedron", test::to_arrays(test::tetrahedron())},
            {"box", test::to_arrays(test::box())},
            {"plate", test::to_arrays(test::box(Vec3(-5, -5, 0), Vec3(5, 5, 0.3), std::array{8, 8, 1}))},
            {"sphere", test::to_arrays(test::icosphere(3))},
            {"uv sphere", test::to_arrays(test::uv_sphere(12, 20))},
            {"torus", test::to_arrays(test::torus(2, 0.6, 32, 14))},
            {"two boxes", test::to_arrays(test::join(test::box(), test::translated(test::box(), Vec3(2, 3, 4))))},
            {"box with a void", test::to_arrays(test::nested_boxes(2, 2))},
            {"box in a void", test::to_arrays(test::nested_boxes(3, 2))},
            {"two voids inside each other", test::to_arrays(test::nested_boxes(4, 2))}};
}

SurfaceArrays transformed(SurfaceArrays surface, double scale, const Vec3& offset) {
    for (Vec3& p : surface.vertices) p = scale * p + offset;
    return surface;
}

void expect_laws(const TetMesh& mesh, const SurfaceArrays& surface) {
    const MeshLaws laws = verify_mesh(mesh, surface);
    EXPECT_GT(mesh.tets.size(), 0u);
    EXPECT_EQ(laws.inverted_tets, 0);
    EXPECT_EQ(laws.tets_without_volume, 0);
    EXPECT_EQ(laws.missing_facets, 0);
    EXPECT_EQ(laws.extra_boundary_faces, 0);
    EXPECT_EQ(laws.mismatched_neighbours, 0);
    EXPECT_EQ(laws.moved_vertices, 0);
    EXPECT_NEAR(laws.volume / laws.surface_volume, 1, 1e-10);
    EXPECT_TRUE(laws.hold());
}

double volume(const TetMesh& mesh, const Tetrahedron& t) {
    const Vec3& a = mesh.vertices[t[0]];
    return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).dot(mesh.vertices[t[3]] - a) / 6;
}

ErrorCode code_of(const SurfaceArrays& surface, const MesherOptions& options) {
    try {
        mesh_volume(surface, options);
    } catch (const Error& error) {
        return error.code();
    }
    ADD_FAILURE() << "no error";
    return ErrorCode::internal;
}

MesherOptions of_mesher(const std::string& name) {
    MesherOptions options;
    options.name = name;
    return options;
}
MesherOptions of_tetgen() { return of_mesher("tetgen"); }

class EachMesher : public testing::TestWithParam<std::string> {
 protected:
    static MesherOptions of_this_mesher() { return of_mesher(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Meshers, EachMesher, testing::Values("lattice", "tetgen"),
                         [](const auto& instance) { return instance.param; });

TEST_P(EachMesher, ObeysTheLaws) {
    for (const auto& [name, surface] : surfaces())
        for (const double radius_edge : {0.0, 1.2, 1.4, 2.0})
            for (const double max_volume : {0.0, 0.02}) {
                SCOPED_TRACE(testing::Message() << name << ", Q " << radius_edge << ", V " << max_volume);
                MesherOptions options = of_this_mesher();
                options.radius_edge = radius_edge;
                options.size = SizeField(max_volume);
                const TetMesh mesh = mesh_volume(surface, options).mesh;
                expect_laws(mesh, surface);
            }
}

// Behind two facets in one plane, as those of a quadrangle are but for rounding, a cell may be positive and have no
// volume as doubles have it. Such cells are replaced also where cells stay as they are otherwise.
TEST(LatticeMesher, LeavesNoCellWithoutVolume) {
    for (const int around : {12, 20, 32, 48})
        for (const int across : {8, 11, 14})
            for (const double thickness : {0.2, 0.6, 0.9}) {
                SCOPED_TRACE(testing::Message() << around << " by " << across << ", thickness " << thickness);
                MesherOptions options = of_mesher("lattice");
                options.radius_edge = 0;
                options.improve = false;
                const SurfaceArrays surface = test::to_arrays(test::torus(2, thickness, around, across));
                expect_laws(mesh_volume(surface, options).mesh, surface);
            }
}

TEST_P(EachMesher, ObeysTheLawsInAnyPlaceAndScale) {
    for (const auto& [name, surface] : surfaces())
        for (const double scale : {1e-6, 1.0, 1e3, 1e12})
            for (const double offset : {0.0, 1e5}) {
                SCOPED_TRACE(testing::Message() << name << ", scale " << scale << ", offset " << offset << " scales");
                const SurfaceArrays moved = transformed(surface, scale, scale * Vec3(offset, -offset, 0.3 * offset));
                expect_laws(mesh_volume(moved, of_this_mesher()).mesh, moved);
            }
}

TEST_P(EachMesher, TopologyIsInvariantToPowersOfTwo) {
    for (const auto& [name, surface] : surfaces()) {
        SCOPED_TRACE(name);
        MesherOptions options = of_this_mesher();
        options.size = SizeField(0.02);
        const TetMesh mesh = mesh_volume(surface, options).mesh;
        for (const int exponent : {-40, -1, 20}) {
            SCOPED_TRACE(exponent);
            const double scale = std::ldexp(1.0, exponent);
            options.size = SizeField(0.02 * scale * scale * scale);
            const TetMesh scaled = mesh_volume(transformed(surface, scale, Vec3::Zero()), options).mesh;
            EXPECT_EQ(scaled.tets, mesh.tets);
            ASSERT_EQ(scaled.vertices.size(), mesh.vertices.size());
            for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
                ASSERT_EQ(scaled.vertices[v], Vec3(scale * mesh.vertices[v]));
        }
    }
}

TEST(TetgenMesher, ObeysTheLawsInAnyVertexOrder) {
    for (const auto& [name, surface] : surfaces())
        for (const std::uint32_t seed : {1u, 2u, 3u, 4000000000u}) {
            SCOPED_TRACE(testing::Message() << name << ", seed " << seed);
            MesherOptions options = of_tetgen();
            options.size = SizeField(0.05);
            options.tetgen.shuffle = seed;
            expect_laws(mesh_volume(surface, options).mesh, surface);
        }
}

TEST(TetgenMesher, IsDeterministic) {
    const SurfaceArrays surface = test::to_arrays(test::icosphere(3));
    std::vector<std::vector<Tetrahedron>> meshes;
    for (const std::uint32_t seed : {0u, 1u, 2u}) {
        SCOPED_TRACE(seed);
        MesherOptions options = of_tetgen();
        options.tetgen.shuffle = seed;
        const TetMesh first = mesh_volume(surface, options).mesh, second = mesh_volume(surface, options).mesh;
        EXPECT_EQ(first.tets, second.tets);
        EXPECT_EQ(first.vertices, second.vertices);
        meshes.push_back(first.tets);
    }
    EXPECT_NE(meshes[0], meshes[1]);
    EXPECT_NE(meshes[1], meshes[2]);
}

TEST_P(EachMesher, WithoutBoundsAddsNoVertices) {
    MesherOptions options = of_this_mesher();
    options.radius_edge = 0;
    const SurfaceArrays surface = test::to_arrays(test::icosphere(3));
    EXPECT_EQ(mesh_volume(surface, options).mesh.interior_vertex_count(), 0);
    options.size = SizeField(0.001);
    EXPECT_GT(mesh_volume(surface, options).mesh.interior_vertex_count(), 0);
}

TEST_P(EachMesher, KeepsVerticesWithoutFacetsAndTheirNumbers) {
    SurfaceArrays surface = test::to_arrays(test::box(Vec3::Zero(), Vec3::Ones(), 2));
    surface.vertices.insert(surface.vertices.begin(), Vec3(0.4, 0.3, 0.2));
    for (Triangle& t : surface.facets)
        for (std::int32_t& v : t) ++v;
    surface.vertex_key.push_back(make_key(input_node, static_cast<std::int32_t>(surface.vertex_key.size())));
    for (const std::uint32_t seed : {0u, 1u}) {
        SCOPED_TRACE(seed);
        MesherOptions options = of_this_mesher();
        options.tetgen.shuffle = seed;
        expect_laws(mesh_volume(surface, options).mesh, surface);
    }
}

TEST_P(EachMesher, KeepsTheVolumeBoundWhereTheSurfaceIsFine) {
    for (const double scale : {1e-6, 1.0})
        for (const double relative : {0.0008, 0.0004}) {
            SCOPED_TRACE(testing::Message() << "scale " << scale << ", bound " << relative);
            MesherOptions options = of_this_mesher();
            options.size = SizeField(relative * scale * scale * scale);
            const TetMesh mesh =
                mesh_volume(transformed(test::to_arrays(test::icosphere(4)), scale, Vec3::Zero()), options).mesh;
            std::vector<double> volumes;
            for (const Tetrahedron& t : mesh.tets) volumes.push_back(volume(mesh, t) / options.size.reference_volume());
            std::sort(volumes.begin(), volumes.end());
            EXPECT_LE(volumes[volumes.size() - 1 - volumes.size() / 1000], 1);  // all but one in a thousand
            EXPECT_LT(volumes.back(), 1.5);
            const double all = std::accumulate(volumes.begin(), volumes.end(), 0.0);
            EXPECT_GT(all / static_cast<double>(volumes.size()), 0.3);  // not many more cells than are needed
        }
}

TEST(TetgenMesher, TakesExpertSwitches) {
    // The volume in the switches is in units of the input, whatever unit the mesher works in.
    const SurfaceArrays surface = transformed(test::to_arrays(test::icosphere(4)), 100, Vec3::Zero());
    MesherOptions by_option = of_tetgen(), by_switch;
    by_option.radius_edge = 1.3;
    by_option.size = SizeField(400);
    by_option.improve = false;
    by_switch.tetgen.switches = "q1.3a400";
    const TetMesh mesh = mesh_volume(surface, by_switch).mesh;
    expect_laws(mesh, surface);
    EXPECT_EQ(mesh.tets, mesh_volume(surface, by_option).mesh.tets);
}

TEST(TetgenMesher, ImprovesCellsUnlessToldNotTo) {
    for (const auto& [name, surface] : surfaces())
        for (const SizeField& size : {SizeField(), SizeField(0.02)}) {
            SCOPED_TRACE(name);
            MesherOptions options = of_tetgen(), by_switch;
            options.size = size;
            by_switch.tetgen.switches = "q1.4";
            const Filling improved = mesh_volume(surface, options), expert = mesh_volume(surface, by_switch);
            options.improve = false;
            const Filling raw = mesh_volume(surface, options);
            expect_laws(improved.mesh, surface);
            expect_laws(raw.mesh, surface);
            EXPECT_TRUE(raw.improvement.is_empty());
            EXPECT_TRUE(expert.improvement.is_empty());
            TetMesh by_hand = raw.mesh;
            improve(by_hand, {.max_size = size});
            EXPECT_EQ(improved.mesh.tets, by_hand.tets);
            EXPECT_EQ(improved.mesh.vertices, by_hand.vertices);
            EXPECT_EQ(improved.improvement.smallest_before.count(), static_cast<std::int64_t>(raw.mesh.tets.size()));
            EXPECT_LE(improved.improvement.bad_cells_after, improved.improvement.bad_cells_before);
        }
}

TEST_P(EachMesher, RefusesOptionsOutOfRange) {
    const SurfaceArrays surface = test::to_arrays(test::box());
    MesherOptions options = of_this_mesher();
    for (const double radius_edge : {-1.0, 0.5, 1.0, std::nan("")}) {
        SCOPED_TRACE(radius_edge);
        options.radius_edge = radius_edge;
        EXPECT_EQ(code_of(surface, options), ErrorCode::usage);
    }
    options = of_this_mesher();
    for (const std::string& switches : {std::string("r"), std::string("o2"), std::string(2000, 'q')}) {
        SCOPED_TRACE(switches);
        options.tetgen.switches = switches;
        EXPECT_EQ(code_of(surface, options), ErrorCode::usage);
    }
}

TEST(Meshers, AreFoundByTheirNamesAndNothingElse) {
    ASSERT_FALSE(meshers().empty());
    EXPECT_EQ(MesherOptions().name, meshers().front()->name);
    EXPECT_EQ(mesher_names().size(), meshers().size());
    for (const Mesher* mesher : meshers()) EXPECT_EQ(&find_mesher(mesher->name), mesher);
    MesherOptions options;
    for (const char* name : {"", "tet", "tetgen ", "TetGen"}) {
        options.name = name;
        EXPECT_EQ(code_of(test::to_arrays(test::box()), options), ErrorCode::usage) << name;
    }
}

// Whatever mesher it is: the surface is filled, the first call is what was asked for, and a failure can be repeated.
TEST(Meshers, KeepTheLawsOfTheTable) {
    for (const Mesher* mesher : meshers())
        for (const auto& [name, surface] : surfaces()) {
            SCOPED_TRACE(testing::Message() << mesher->name << ", " << name);
            MesherOptions options;
            options.name = mesher->name;
            options.size = SizeField(0.1);
            expect_laws(mesh_volume(surface, options).mesh, surface);
            for (const MesherCall& call : mesher_calls(options)) EXPECT_NO_THROW(check_mesher_options(call.options));
            const Reproducer reproducer = mesher->reproducer(surface, options, "stem");
            EXPECT_NE(reproducer.command.find("stem" + reproducer.ending), std::string::npos) << reproducer.command;
            const Soup again = read_surface_bytes(reproducer.bytes, "stem" + reproducer.ending);
            EXPECT_EQ(again.vertices, surface.vertices);
            EXPECT_EQ(again.facets, surface.facets);
        }
}

TEST(Meshers, ForecastWhatBodiesTake) {
    for (const Mesher* mesher : meshers()) {
        const MesherForecast& f = mesher->forecast;
        for (const double value : {f.tets_by_edge_ratio.back(), f.most_tets_per_facet, f.tets_per_volume_bound,
                                   f.tets_per_sized_volume, f.seconds_per_tet, f.volume_weight})
            EXPECT_GT(value, 0) << mesher->name;
        for (const double value : f.tets_by_edge_ratio) EXPECT_GE(value, 0) << mesher->name;
        EXPECT_GE(f.bytes_per_tet, sizeof(Tetrahedron)) << mesher->name;
        EXPECT_LT(f.most_tets, std::numeric_limits<std::int32_t>::max()) << mesher->name;
    }
    EXPECT_EQ(LoadModel().volume_weight, find_mesher(MesherOptions().name).forecast.volume_weight);
}

// As many for a body in another unit, and nearly so for a size that is nearly the same.
TEST(Meshers, ForecastByRatiosAlone) {
    for (const Mesher* mesher : meshers()) {
        MesherOptions options;
        options.name = mesher->name;
        const auto at_facet = [&](double scale, double size) {
            return tets_at_facet({scale, 1.1 * scale}, size * scale, 2 * scale, options);
        };
        for (double size = 0.01; size < 100; size *= 1.01) {
            SCOPED_TRACE(testing::Message() << mesher->name << ", size " << size);
            EXPECT_NEAR(at_facet(1e-3, size), at_facet(1, size), 1e-9 * at_facet(1, size));
            EXPECT_LE(std::abs(at_facet(1, 1.01 * size) - at_facet(1, size)), 0.2 * at_facet(1, size) + 0.05);
        }
        EXPECT_EQ(at_facet(1, std::numeric_limits<double>::infinity()), at_facet(1, 1e9)) << "where none is wanted";
        EXPECT_EQ(tets_inside(1, options), 0) << "no size";
        options.size = SizeField(0.01);
        EXPECT_NEAR(tets_inside(2, options), 2 * tets_inside(1, options), 1e-9);
    }
}

TEST(Mesher, ReportsIntersectingFacets) {
    const Soup soup = test::join(test::icosphere(2), test::translated(test::icosphere(2), Vec3(0.9, 0.1, 0)));
    EXPECT_EQ(code_of(test::to_arrays(soup), {}), ErrorCode::subdomain);
}

TEST(Mesher, CoincidentVerticesBreakTheLaws) {
    // Two boxes that touch in one point, which each has under its own number; TetGen takes them for one vertex.
    const SurfaceArrays surface = test::to_arrays(test::join(test::box(), test::translated(test::box(), Vec3::Ones())));
    const MeshLaws laws = verify_mesh(mesh_volume(surface, {}).mesh, surface);
    EXPECT_GT(laws.missing_facets, 0);
    EXPECT_GT(laws.extra_boundary_faces, 0);
    EXPECT_EQ(laws.mismatched_neighbours, 0);
    EXPECT_FALSE(laws.hold());
}

// Rings of long flat facets, whose Delaunay cells are slivers between two of them.
TEST(Meshers, LeaveNoSliversBetweenFacets) {
    for (const int sections : {6, 8}) {
        const Filling filling = mesh_volume(test::to_arrays(test::torus(1, 0.1, sections, 6)), MesherOptions());
        const PartQuality quality = measure_quality(filling.mesh, {}, 1);
        EXPECT_GT(quality.all.measures[0].min(), 3) << sections;
    }
}

}  // namespace
}  // namespace kerf

// The facade: arrays to meshes in memory and in folders, by nothing but its header.
#include "kerf/kerf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using Points = std::vector<std::array<double, 3>>;
using Facets = std::vector<std::array<std::int32_t, 3>>;

const Points corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Facets cube_facets = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                            {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
const std::vector<std::int32_t> cube_patches = {0, 0, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2};

ClosedSurface cube() { return surface_from_arrays(corners, cube_facets, cube_patches, {"bottom", "top", "sides"}); }

MeshOptions two_parts() {
    return {.size = 0.25,
            .parts = 2,
            .workers = 1,
            .programs = std::filesystem::path(test::worker_program()).parent_path().string()};
}

double six_volumes(const MeshArrays& mesh, const std::array<std::int64_t, 4>& tet) {
    std::array<std::array<double, 3>, 3> e;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            e[i][k] = mesh.vertices[static_cast<std::size_t>(tet[i + 1])][k] -
                      mesh.vertices[static_cast<std::size_t>(tet[0])][k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

TEST(Facade, MeshesArraysInMemory) {
    const MeshArrays mesh = mesh_to_arrays(cube(), two_parts());
    double sum = 0;
    for (const auto& tet : mesh.tets) {
        EXPECT_GT(six_volumes(mesh, tet), 0);
        sum += six_volumes(mesh, tet) / 6;
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_EQ(mesh.part.size(), mesh.tets.size());
    for (const std::int32_t part : {2, 3})
        EXPECT_NE(std::find(mesh.part.begin(), mesh.part.end(), part), mesh.part.end()) << part;
    EXPECT_EQ(mesh.patch_names, (std::vector<std::string>{"bottom", "top", "sides"}));
    ASSERT_EQ(mesh.patch.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (const std::int64_t v : mesh.triangles[i]) {
            const double z = mesh.vertices[static_cast<std::size_t>(v)][2];
            if (mesh.patch[i] < 2) {
                EXPECT_EQ(z, mesh.patch[i]);
            }
        }
}

TEST(Facade, AFolderHasTheSameMesh) {
    const test::TemporaryFolder folder;
    mesh_to_folder(cube(), two_parts(), folder.file("run"));
    const MeshArrays of_run = arrays_of_run(folder.file("run")), in_memory = mesh_to_arrays(cube(), two_parts());
    EXPECT_EQ(of_run.vertices, in_memory.vertices);
    EXPECT_EQ(of_run.tets, in_memory.tets);
    EXPECT_EQ(of_run.triangles, in_memory.triangles);
}

TEST(Facade, AFileIsTheSurfaceOfItsArrays) {
    const ClosedSurface read = surface_from_file(test::asset_path("cube"));
    const ClosedSurface made = surface_from_arrays(read.vertices(), read.facets(), read.patches(), read.patch_names());
    EXPECT_EQ(made.vertices(), read.vertices());
    EXPECT_EQ(made.facets(), read.facets());
    EXPECT_EQ(made.volume(), read.volume());
    EXPECT_TRUE(check_file(test::asset_path("cube")).can_be_meshed);
}

TEST(Facade, AnErrorHasTheDefectsThatACheckTells) {
    for (const double z : {1.0, std::numeric_limits<double>::quiet_NaN()}) {
        Points points = corners;
        points[6][2] = z;
        const Facets open(cube_facets.begin() + 1, cube_facets.end());
        const SurfaceCheck check = check_arrays(points, open);
        EXPECT_FALSE(check.can_be_meshed);
        try {
            surface_from_arrays(points, open);
            ADD_FAILURE() << "a surface with a hole";
        } catch (const SurfaceError& error) {
            ASSERT_EQ(error.defects().size(), 1u);
            ASSERT_EQ(check.defects.size(), 1u);
            EXPECT_EQ(error.defects()[0].text, check.defects[0].text);
            EXPECT_EQ(check.defects[0].kind, z == 1 ? "open edge loop" : "wrong row");
            EXPECT_EQ(check.defects[0].vertices.size(), z == 1 ? 3u : 1u);
            EXPECT_EQ(check.defects[0].points.size(), z == 1 ? 3u : 0u);
        }
    }
    EXPECT_TRUE(check_arrays(corners, cube_facets).can_be_meshed);
}

TEST(Facade, ASurfaceIsWrittenAndReadAgain) {
    const test::TemporaryFolder folder;
    for (const std::string name : {"cube.obj", "cube.stl", "cube.ply", "cube.off", "cube.vtk", "cube.vtp"}) {
        surface_to_file(cube(), folder.file(name));
        EXPECT_EQ(surface_from_file(folder.file(name)).volume(), 1);
    }
    EXPECT_EQ(surface_from_file(folder.file("cube.obj")).patch_names(), cube().patch_names());
    EXPECT_THROW(surface_to_file(cube(), folder.file("cube.txt")), Error);
}

TEST(Facade, RemeshingTakesOptionsOfSizesAlone) {
    EXPECT_EQ(remeshed(cube(), {{"size", "0.2"}, {"deviation", "1e-3"}}).vertices(),
              remeshed(cube(), 1e-3, 0.2).vertices());
    EXPECT_NO_THROW(remeshed(cube(), {{"cells", "1k"}}));
    EXPECT_THROW(remeshed(cube(), {{"radius-edge", "2"}}), Error);
}

TEST(Facade, RemeshedSurfacesKeepPatchesAndVolume) {
    const ClosedSurface fine = remeshed(cube(), 1e-3, 0.2);
    EXPECT_GT(fine.facet_count(), 100);
    EXPECT_NEAR(fine.volume(), 1, 1e-9);
    EXPECT_EQ(fine.patch_names(), cube().patch_names());
}

// Two cubes with a wall between them.
ClosedSurface two_cubes() {
    Points points = corners;
    for (const auto& [x, y, z] : corners)
        if (x == 1) points.push_back({2, y, z});  // 8 to 11: of 1, 2, 5, 6
    Facets facets = cube_facets;
    std::vector<std::array<std::int32_t, 2>> sides(12, {0, -1});
    sides[6] = sides[7] = {0, 1};
    for (const auto& facet : Facets{{1, 9, 8},
                                    {1, 2, 9},
                                    {5, 10, 11},
                                    {5, 11, 6},
                                    {1, 8, 10},
                                    {1, 10, 5},
                                    {8, 9, 11},
                                    {8, 11, 10},
                                    {9, 2, 6},
                                    {9, 6, 11}}) {
        facets.push_back(facet);
        sides.push_back({1, -1});
    }
    return surface_of_regions(points, facets, sides, {"steel", "copper"});
}

TEST(Facade, RegionsKeepTheirNamesAndTheirWall) {
    const ClosedSurface cubes = two_cubes();
    EXPECT_EQ(cubes.region_names(), (std::vector<std::string>{"steel", "copper"}));
    EXPECT_EQ(cubes.sides()[6], (std::array{0, 1}));
    for (const ClosedSurface& surface : {cubes, remeshed(cubes, 1e-3, 0.4)}) {
        const MeshArrays mesh = mesh_to_arrays(surface, two_parts());
        EXPECT_EQ(mesh.region_names, cubes.region_names());
        std::array<double, 2> volumes{};
        for (std::size_t t = 0; t < mesh.tets.size(); ++t)
            volumes[static_cast<std::size_t>(mesh.region[t])] += six_volumes(mesh, mesh.tets[t]) / 6;
        for (const double volume : volumes) EXPECT_NEAR(volume, 1, 1e-9);
        std::size_t on_wall = 0;
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            bool is_on_wall = true;
            for (const std::int64_t v : mesh.triangles[f])
                is_on_wall &= mesh.vertices[static_cast<std::size_t>(v)][0] == 1;
            EXPECT_EQ(mesh.sides[f][1], is_on_wall ? 1 - mesh.sides[f][0] : -1);
            on_wall += is_on_wall;
        }
        EXPECT_GT(on_wall, 2U);
    }
    Facets open = cubes.facets();
    open.pop_back();
    auto sides = cubes.sides();
    sides.pop_back();
    try {
        surface_of_regions(cubes.vertices(), open, sides, {"steel", "copper"});
        ADD_FAILURE() << "copper is open";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_NE(std::string(error.what()).find("copper"), std::string::npos) << error.what();
    }
}

TEST(Facade, ASurfaceOfOneRegionHasItBehindItsFacets) {
    EXPECT_TRUE(cube().region_names().empty());
    EXPECT_EQ(cube().sides()[0], (std::array{0, -1}));
    const MeshArrays mesh = mesh_to_arrays(cube(), two_parts());
    EXPECT_TRUE(mesh.region_names.empty());
    EXPECT_EQ(std::count(mesh.region.begin(), mesh.region.end(), 0), std::ssize(mesh.tets));
    EXPECT_EQ(mesh.sides.size(), mesh.triangles.size());
}

TEST(Facade, ErrorsHaveCodesAndElements) {
    Facets facets = cube_facets;
    facets[7][2] = 99;
    try {
        surface_from_arrays(corners, facets);
        ADD_FAILURE() << "a corner that is no vertex";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::input);
        EXPECT_EQ(error.elements().front().ids, std::vector<std::int64_t>{7});
    }
    const auto code_of = [](const MeshOptions& options) {
        try {
            mesh_to_arrays(cube(), options);
        } catch (const Error& error) {
            return error.code();
        }
        return ErrorCode::internal;
    };
    MeshOptions options = two_parts();
    options.others = {{"voids", "parity"}};
    EXPECT_EQ(code_of(options), ErrorCode::usage) << "an option of the surface";
    options.others = {{"radius-edge", "-1"}};
    EXPECT_EQ(code_of(options), ErrorCode::usage) << "out of range";
    options = two_parts();
    options.progress = [](const char*, std::size_t, std::size_t) { return false; };
    EXPECT_EQ(code_of(options), ErrorCode::cancelled);
    options = two_parts();
    options.programs = "/nowhere";
    EXPECT_EQ(code_of(options), ErrorCode::io) << "no worker";
}

}  // namespace
}  // namespace kerf

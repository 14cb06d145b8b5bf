// A case of OpenFOAM with one mesh for each region.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "export/cases.h"
#include "export/openfoam_laws.h"
#include "export/regions_cases.h"
#include "files/export/format.h"

namespace kerf::openfoam_regions_test {
namespace {

using namespace test::openfoam;

using Corners = std::array<std::array<double, 3>, 3>;

// An exported case: the meshes of each region, by processor.
struct SplitCase {
    explicit SplitCase(const PartSource& source) : parts(source) {
        ExportFiles files(folder.file("case"), "", {}, {.split_regions = true});
        write_format(find_format("openfoam"), parts, files);
        for (const std::string& region : parts.outline().region_names)
            for (const PartIndex index : parts.outline().parts.ids())
                meshes[region].push_back(
                    read_mesh(folder.file("case/") +
                              (parts.outline().parts.size() == 1 ? "" : fmt::format("processor{}/", index.value())) +
                              "constant/" + region + "/polyMesh/"));
    }

    const PartSource& parts;
    test::TemporaryFolder folder;
    std::map<std::string, std::vector<PolyMesh>> meshes;
};

template <class Law>
void for_each_split_case(const Law& law) {
    test::for_each_regions_source([&](const PartSource& parts) { law(SplitCase(parts)); });
}

// The faces of a patch in all processors, each by its corners in ascending order.
std::multiset<Corners> faces_of(const std::vector<PolyMesh>& meshes, const std::string& name) {
    std::multiset<Corners> faces;
    for (const PolyMesh& mesh : meshes)
        for (const Patch& patch : mesh.patches) {
            if (patch.name != name) continue;
            for (std::size_t f = patch.start; f < patch.start + patch.faces; ++f) {
                Corners corners;
                for (std::size_t i = 0; i < 3; ++i) {
                    const Vec3& p = mesh.corner(f, i);
                    corners[i] = {p.x(), p.y(), p.z()};
                }
                std::sort(corners.begin(), corners.end());
                faces.insert(corners);
            }
        }
    return faces;
}

TEST(OpenFoamRegions, AreMeshesOfTheirOwn) {
    for_each_split_case([](const SplitCase& split) {
        for (const auto& [region, meshes] : split.meshes) {
            SCOPED_TRACE(region);
            for (const PolyMesh& mesh : meshes) {
                expect_four_faces(mesh);
                expect_upper_triangular(mesh);
                expect_normals_out_of_owner(mesh);
                expect_patches_follow_each_other(mesh);
                EXPECT_EQ(mesh.faces.size() + mesh.neighbour.size(), 4 * mesh.cells());
            }
            expect_both_sides_agree(meshes);
        }
    });
}

TEST(OpenFoamRegions, HaveTheCellsAndVolumesOfTheParts) {
    for_each_split_case([](const SplitCase& split) {
        const MeshOutline& outline = split.parts.outline();
        std::map<std::string, std::size_t> cells;
        std::map<std::string, double> volumes;
        for (const PartIndex index : outline.parts.ids()) {
            const Part part = split.parts.load(index);
            for (std::int32_t t = 0; t < part.tet_count(); ++t) {
                const std::string& region = outline.region_names[static_cast<std::size_t>(part.region_of(t).value())];
                const auto point = [&](std::size_t i) {
                    const std::int32_t v = part.mesh.tets[static_cast<std::size_t>(t)][i];
                    return part.mesh.vertices[static_cast<std::size_t>(v)];
                };
                ++cells[region];
                volumes[region] +=
                    std::abs((point(1) - point(0)).dot((point(2) - point(0)).cross(point(3) - point(0)))) / 6;
            }
        }
        for (const auto& [region, meshes] : split.meshes) {
            std::size_t count = 0;
            double volume = 0;
            for (const PolyMesh& mesh : meshes) {
                count += mesh.cells();
                for (std::size_t f = mesh.neighbour.size(); f < mesh.faces.size(); ++f)
                    volume += mesh.centre(f).dot(mesh.area(f)) / 3;
            }
            EXPECT_EQ(count, cells[region]) << region;
            EXPECT_NEAR(volume, volumes[region], 1e-12 * volume) << region;
        }
    });
}

TEST(OpenFoamRegions, HaveTheSamePatchesInAllProcessors) {
    for_each_split_case([](const SplitCase& split) {
        for (const auto& [region, meshes] : split.meshes) {
            std::vector<std::string> first;
            for (const PolyMesh& mesh : meshes) {
                std::vector<std::string> names;
                for (const Patch& patch : mesh.patches)
                    if (patch.type != "processor") names.push_back(patch.name + ' ' + patch.type);
                if (&mesh == meshes.data()) first = names;
                EXPECT_EQ(names, first) << region;
            }
            for (const Patch& patch : meshes[0].patches) {
                if (patch.type == "processor") continue;
                EXPECT_FALSE(faces_of(meshes, patch.name).empty()) << region << ": " << patch.name;
            }
        }
    });
}

TEST(OpenFoamRegions, WallsAreMappedToEachOther) {
    for_each_split_case([](const SplitCase& split) {
        std::size_t mapped = 0;
        for (const auto& [region, meshes] : split.meshes)
            for (const Patch& patch : meshes[0].patches) {
                EXPECT_EQ(patch.type == "mappedWall", !patch.sample_region.empty());
                if (patch.type != "mappedWall") continue;
                ++mapped;
                EXPECT_EQ(patch.name, region + "_to_" + patch.sample_region);
                EXPECT_EQ(patch.sample_patch, patch.sample_region + "_to_" + region);
                EXPECT_EQ(faces_of(meshes, patch.name),
                          faces_of(split.meshes.at(patch.sample_region), patch.sample_patch));
            }
        const std::size_t regions = split.meshes.size();
        EXPECT_EQ(mapped, regions == 3 ? 4 : 2) << "two of the three touch along an edge alone";
        const std::string text = test::bytes_of_file(split.folder.file("case/constant/regionProperties"));
        for (const std::string& region : split.parts.outline().region_names)
            EXPECT_NE(text.find("    " + region + "\n"), text.npos);
    });
}

TEST(OpenFoamRegions, HaveWordsThatAreNoFilesOfACase) {
    test::RegionsCase odd = test::regions_cases[0];
    odd.names = {"polyMesh", "region0", "Stahl (2)"};
    const test::FinishedRegions run(odd);
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("case"), "", {}, {.split_regions = true});
    write_format(find_format("openfoam"), run.parts(), files);
    const std::string text = test::bytes_of_file(folder.file("case/constant/regionProperties"));
    EXPECT_NE(
        text.find("    // polyMesh\n    polyMesh_2\n    // region0\n    region0_2\n    // Stahl (2)\n    Stahl_2\n"),
        text.npos)
        << text;
    for (const char* region : {"polyMesh_2", "region0_2", "Stahl_2"}) {
        EXPECT_TRUE(std::filesystem::exists(folder.file("case/processor0/constant/") + region + "/polyMesh/faces"));
        EXPECT_TRUE(std::filesystem::exists(folder.file("case/system/") + region + "/fvSchemes"));
    }
}

TEST(OpenFoamRegions, AreRefusedWhereThereIsOne) {
    const RunParts run(test::run_of(test::export_cases().front()));
    const test::TemporaryFolder folder;
    ExportFiles files(folder.file("case"), "", {}, {.split_regions = true});
    EXPECT_THROW(write_format(find_format("openfoam"), run, files), Error);
    EXPECT_TRUE(files.list().empty());
}

}  // namespace
}  // namespace kerf::openfoam_regions_test

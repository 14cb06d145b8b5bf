// The laws of OpenFOAM's meshes, read back by a reader that shares nothing with the writer.
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "export/cases.h"
#include "export/openfoam_laws.h"
#include "files/export/format.h"
#include "files/part/run_parts.h"
#include "support/file_contents.h"
#include "support/temporary_folder.h"

namespace kerf::openfoam_export_test {
namespace {

using namespace test::openfoam;

// An exported run.
struct Case {
    explicit Case(const test::ExportCase& wanted)
        : name(wanted.name), surface(wanted.surface), run(test::run_of(wanted)) {
        ExportFiles files(folder.file("case"));
        write_format(find_format("openfoam"), run, files);
        for (std::int32_t rank = 0; rank < wanted.parts; ++rank)
            meshes.push_back(read_mesh(folder.file("case/") +
                                       (wanted.parts == 1 ? "" : fmt::format("processor{}/", rank)) +
                                       "constant/polyMesh/"));
    }

    std::string name;
    test::TemporaryFolder folder;
    const Soup& surface;
    RunParts run;
    std::vector<PolyMesh> meshes;
};

const std::vector<std::unique_ptr<Case>>& all_cases() {
    static const std::vector<std::unique_ptr<Case>> cases = [] {
        std::vector<std::unique_ptr<Case>> made;
        for (const test::ExportCase& each : test::export_cases()) made.push_back(std::make_unique<Case>(each));
        return made;
    }();
    return cases;
}

template <class Law>
void for_each_case(Law law) {
    for (const auto& each : all_cases()) {
        SCOPED_TRACE(each->name);
        law(*each);
    }
}

template <class Law>
void for_each_mesh(Law law) {
    for_each_case([&](const Case& each) {
        for (const PolyMesh& mesh : each.meshes) law(mesh);
    });
}

TEST(OpenFoam, CountsAreThoseOfTheParts) {
    for_each_case([](const Case& each) {
        for (std::size_t rank = 0; rank < each.meshes.size(); ++rank) {
            const PolyMesh& mesh = each.meshes[rank];
            const PartExtent& extent = each.run.outline().parts[rank];
            EXPECT_EQ(mesh.points.size(), extent.vertices);
            EXPECT_EQ(mesh.cells(), extent.tets);
            std::int64_t of_surface = 0, between = 0;
            for (const Patch& patch : mesh.patches)
                (patch.type == "patch" ? of_surface : between) += static_cast<std::int64_t>(patch.faces);
            EXPECT_EQ(of_surface, extent.patch_facets);
            EXPECT_EQ(between, extent.interface_facets);
            EXPECT_EQ(mesh.note, fmt::format("nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}", mesh.points.size(),
                                             mesh.cells(), mesh.faces.size(), mesh.neighbour.size()));
        }
    });
}

TEST(OpenFoam, CellsHaveFourFacesOfFourPoints) { for_each_mesh(expect_four_faces); }

TEST(OpenFoam, FacesBetweenCellsAreUpperTriangular) { for_each_mesh(expect_upper_triangular); }

TEST(OpenFoam, NormalsPointOutOfTheOwner) { for_each_mesh(expect_normals_out_of_owner); }

// Patches of one name are one.
double area_of(const Soup& soup, const std::string& patch) {
    double area = 0;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (soup.patch_names[static_cast<std::size_t>(soup.patch[f])] != patch) continue;
        const auto corner = [&](std::size_t i) { return soup.vertices[static_cast<std::size_t>(soup.facets[f][i])]; };
        area += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
    }
    return area;
}

double volume_of(const Soup& soup) {
    double volume = 0;
    for (const Triangle& t : soup.facets) {
        const auto corner = [&](std::size_t i) { return soup.vertices[static_cast<std::size_t>(t[i])]; };
        volume += corner(0).dot(corner(1).cross(corner(2))) / 6;
    }
    return volume;
}

TEST(OpenFoam, VolumeAndAreasAreThoseOfTheSurface) {
    for_each_case([](const Case& each) {
        double volume = 0;
        const std::vector<std::string>& names = each.run.outline().patch_names;
        std::vector<double> areas(names.size(), 0);
        for (const PolyMesh& mesh : each.meshes) {
            ASSERT_GE(mesh.patches.size(), areas.size());
            for (std::size_t f = mesh.neighbour.size(); f < mesh.faces.size(); ++f)
                volume += mesh.centre(f).dot(mesh.area(f)) / 3;
            for (std::size_t p = 0; p < areas.size(); ++p)
                for (std::size_t f = 0; f < mesh.patches[p].faces; ++f)
                    areas[p] += mesh.area(mesh.patches[p].start + f).norm();
        }
        EXPECT_NEAR(volume, volume_of(each.surface), 1e-9 * volume);
        for (std::size_t p = 0; p < areas.size(); ++p)
            EXPECT_NEAR(areas[p], area_of(each.surface, names[p]), 1e-9 * areas[p]) << names[p];
    });
}

TEST(OpenFoam, PatchesFollowEachOtherToTheEnd) { for_each_mesh(expect_patches_follow_each_other); }

TEST(OpenFoam, EveryProcessorHasAllPatchesAndThenItsNeighbours) {
    for_each_case([](const Case& each) {
        const std::size_t count = each.run.outline().patch_names.size();
        for (std::size_t rank = 0; rank < each.meshes.size(); ++rank) {
            const std::vector<Patch>& patches = each.meshes[rank].patches;
            ASSERT_GE(patches.size(), count);
            std::set<std::string> words;
            for (std::size_t p = 0; p < count; ++p) {
                EXPECT_EQ(patches[p].type, "patch");
                EXPECT_EQ(patches[p].name, each.meshes[0].patches[p].name);
                EXPECT_TRUE(std::regex_match(patches[p].name, std::regex("[A-Za-z_][-A-Za-z0-9_.]*")));
                EXPECT_TRUE(words.insert(patches[p].name).second) << patches[p].name;
            }
            int last = -1;
            for (std::size_t p = count; p < patches.size(); ++p) {
                EXPECT_EQ(patches[p].type, "processor");
                EXPECT_EQ(patches[p].self, rank);
                EXPECT_NE(patches[p].other, rank);
                EXPECT_GT(patches[p].other, last);
                EXPECT_GT(patches[p].faces, 0);
                EXPECT_EQ(patches[p].name, fmt::format("procBoundary{}to{}", rank, patches[p].other));
                last = patches[p].other;
            }
        }
    });
}

TEST(OpenFoam, BothSidesOfAProcessorPatchAgree) {
    for_each_case([](const Case& each) {
        const std::size_t pairs = expect_both_sides_agree(each.meshes);
        EXPECT_EQ(pairs > 0, each.meshes.size() > 1);
    });
}

// ---- Meshes that no run makes

// One tetrahedron whose faces are patches of these names, or an outline alone.
class MadeUpPart : public PartSource {
 public:
    explicit MadeUpPart(const std::vector<std::string>& names) {
        part_.mesh.vertices = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        part_.mesh.boundary_vertex_count = 4;
        part_.mesh.tets = {{0, 1, 2, 3}};
        part_.facets = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
        part_.patch = {0, 0, 0, 0};
        part_.facet = {0, 1, 2, 3};
        part_.neighbour.assign(4, NodeId::none());
        part_.tet_at_facet = {0, 0, 0, 0};
        part_.global_id = {0, 1, 2, 3};
        part_.patch_names = names;
        outline_ = {{{root_node, 4, 1, 4, 0}}, 4, names};
    }

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex) const override { return part_; }
    MeshOutline& outline() { return outline_; }

 private:
    Part part_;
    MeshOutline outline_;
};

void write(const PartSource& parts, const std::string& folder) {
    ExportFiles files(folder);
    write_format(find_format("openfoam"), parts, files);
}

std::vector<std::string> words_of(const std::vector<std::string>& names) {
    const test::TemporaryFolder folder;
    write(MadeUpPart(names), folder.file("case"));
    std::vector<std::string> words;
    for (const Patch& patch : read_mesh(folder.file("case/constant/polyMesh/")).patches) words.push_back(patch.name);
    return words;
}

using Words = std::vector<std::string>;

TEST(OpenFoam, NamesBecomeWords) {
    EXPECT_EQ(words_of({"inlet", "wall-1.a_b", "_x"}), (Words{"inlet", "wall-1_a_b", "x"}));
    EXPECT_EQ(words_of({"inlet pipe, left (1)"}), Words{"inlet_pipe_left_1"});
    EXPECT_EQ(words_of({"K\u00f6rper \"zwei\" <&> 2'"}), Words{"K_rper_zwei_2"});
    EXPECT_EQ(words_of({"", "\u00e4\u00f6"}), (Words{"patch", "patch_2"}));
    EXPECT_EQ(words_of({"300", "-x", ".y"}), (Words{"patch_300", "x", "y"})) << "no number";
    EXPECT_EQ(words_of({"a; } \n{ $b #c /d", "$x"}), (Words{"a_b_c_d", "x"})) << "nothing that dictionaries read";
    EXPECT_EQ(words_of({"procBoundary0to1", "processor"}), (Words{"patch_procBoundary0to1", "processor_2"}));
}

TEST(OpenFoam, DifferentPatchesHaveDifferentWords) {
    EXPECT_EQ(words_of({"a b", "a,b", "a_b"}), (Words{"a_b_2", "a_b_3", "a_b"})) << "a word keeps its name";
    EXPECT_EQ(words_of({"a b", "a b", "a_b_2"}), (Words{"a_b", "a_b_3", "a_b_2"}));
    EXPECT_EQ(words_of({"a", "a", "a"}), (Words{"a", "a_2", "a_3"}));
}

TEST(OpenFoam, OneTetrahedronIsAMesh) {
    const test::TemporaryFolder folder;
    write(MadeUpPart({"all"}), folder.file("case"));
    const PolyMesh mesh = read_mesh(folder.file("case/constant/polyMesh/"));
    EXPECT_EQ(mesh.cells(), 1);
    EXPECT_EQ(mesh.faces.size(), 4);
    EXPECT_TRUE(mesh.neighbour.empty());
}

TEST(OpenFoam, PartsWithMoreFacesThanLabelsAreRefusedFirst) {
    const test::TemporaryFolder folder;
    MadeUpPart parts({"all"});
    parts.outline().parts[0].tets = 357'913'940;
    parts.outline().parts[0].patch_facets = 4;  // 715'827'882 faces: the last offset is 2'147'483'646
    ExportFiles files(folder.file("case"));
    EXPECT_NO_THROW(find_format("openfoam").write_whole(parts, files));
    std::filesystem::remove_all(folder.file("case"));
    parts.outline().parts[0].patch_facets = 6;
    try {
        write(parts, folder.file("case"));
        ADD_FAILURE() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        EXPECT_NE(std::string(error.what()).find("715827883"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder.file("case")));
}

// ---- The case around the mesh

TEST(OpenFoam, ACaseSaysHowManyProcessorsItHas) {
    for_each_case([](const Case& each) {
        std::set<std::string> folders;
        for (const auto& entry : std::filesystem::directory_iterator(each.folder.file("case")))
            folders.insert(entry.path().filename());
        std::set<std::string> expected = {"system"};
        if (each.meshes.size() == 1) expected.insert("constant");
        for (std::size_t rank = 0; each.meshes.size() > 1 && rank < each.meshes.size(); ++rank)
            expected.insert(fmt::format("processor{}", rank));
        EXPECT_EQ(folders, expected);
        const std::string dictionary = test::bytes_of_file(each.folder.file("case/system/decomposeParDict"));
        const bool says_it =
            dictionary.find(fmt::format("numberOfSubdomains {};", each.meshes.size())) != dictionary.npos;
        EXPECT_EQ(says_it, each.meshes.size() > 1);
    });
}

TEST(OpenFoam, DictionariesOfTheUserStay) {
    const test::TemporaryFolder folder;
    const MadeUpPart parts({"all"});
    write(parts, folder.file("case"));
    const auto fresh = test::contents(folder.file("case/system"));
    EXPECT_EQ(fresh.size(), 3);
    const std::string mine = "application simpleFoam;\n";
    std::ofstream(folder.file("case/system/controlDict")) << mine;
    ExportFiles files(folder.file("case"));
    write_format(find_format("openfoam"), parts, files);
    EXPECT_EQ(test::bytes_of_file(folder.file("case/system/controlDict")), mine);
    for (const RunFile& file : files.list()) EXPECT_NE(file.path, "system/controlDict") << "it is not ours";
}

TEST(OpenFoam, PatchesHaveTheTypesThatWereAskedFor) {
    const test::TemporaryFolder folder;
    const MadeUpPart parts({"a = b", "side", "top"});
    const std::vector<std::string> texts = {"a = b=wall", "top=symmetry", "top=symmetryPlane"};
    ExportFiles files(folder.file("case"), "", {}, {.patch_types = parse_patch_types(texts)});
    write_format(find_format("openfoam"), parts, files);
    std::vector<std::string> types;
    for (const Patch& patch : read_patches(folder.file("case/constant/polyMesh/boundary"))) types.push_back(patch.type);
    EXPECT_EQ(types, (std::vector<std::string>{"wall", "patch", "symmetryPlane"}));
    const std::vector<std::string> other = {"bottom=wall"};
    ExportFiles refused(folder.file("other"), "", {}, {.patch_types = parse_patch_types(other)});
    EXPECT_THROW(write_format(find_format("openfoam"), parts, refused), Error) << "there is no such patch";
    EXPECT_FALSE(std::filesystem::exists(folder.file("other")));
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{"side"}, {"=wall"}, {"side=cyclic"}})
        EXPECT_THROW(parse_patch_types(wrong), Error) << wrong[0];
}

TEST(OpenFoam, FoldersOfMoreProcessorsAreRefused) {
    const test::TemporaryFolder folder;
    const test::ExportCase& four = test::export_cases()[2];
    ASSERT_EQ(four.parts, 4);
    const RunParts run(test::run_of(four));
    std::filesystem::create_directories(folder.file("case/processor4"));
    EXPECT_THROW(write(run, folder.file("case")), Error);
    EXPECT_FALSE(std::filesystem::exists(folder.file("case/processor0")));
    std::filesystem::remove(folder.file("case/processor4"));
    std::filesystem::create_directories(folder.file("case/processor3"));
    EXPECT_NO_THROW(write(run, folder.file("case")));
}

}  // namespace
}  // namespace kerf::openfoam_export_test

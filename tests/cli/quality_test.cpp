// kerf quality as a user sees it: runs, files of other programs, two meshes, limits, and what is no mesh.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/part/vtu_reader.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

using Json = nlohmann::json;
using test::output_of;

// A part of a run as the files of other programs: its boundary is its patch triangles and its interfaces.
struct PartMesh {
    Soup boundary;
    std::vector<Tetrahedron> tets;
};

PartMesh mesh_of(const Part& part) {
    PartMesh mesh;
    mesh.boundary.vertices = part.mesh.vertices;
    mesh.boundary.facets = part.facets;
    mesh.boundary.patch.assign(part.facets.size(), 0);
    mesh.boundary.patch_names = {"boundary"};
    mesh.tets = part.mesh.tets;
    return mesh;
}

class Quality : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = std::make_unique<test::TemporaryFolder>();
        mesh("cube", "run", {"-n", "3"});
        mesh("hollow_box", "straight", {"-n", "4", "--contour", "straight"});
    }
    static void TearDownTestSuite() { folder_.reset(); }

    static void mesh(const std::string& asset, const std::string& name, std::vector<std::string> more) {
        more.insert(more.begin(), {"mesh", test::asset_path(asset), "-o", path(name), "-q"});
        const ChildResult run = test::run_kerf(more);
        ASSERT_EQ(run.exit_code, 0) << run.log;
    }
    static std::string path(const std::string& name) { return folder_->file(name); }
    static std::string write(const std::string& name, const std::string& bytes) {
        std::ofstream(path(name), std::ios::binary) << bytes;
        return path(name);
    }
    static ChildResult quality(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "quality");
        return test::run_kerf(arguments);
    }
    static Json quality_json(std::vector<std::string> arguments) {
        arguments.push_back("--json");
        const ChildResult result = quality(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return Json::parse(output_of(result));
    }
    static void expect_refused(std::vector<std::string> arguments, int exit_code, const std::string& words) {
        const ChildResult result = quality(std::move(arguments));
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_NE(result.log.find(words), std::string::npos) << result.log;
        EXPECT_EQ(output_of(result), "");
    }

    static std::unique_ptr<test::TemporaryFolder> folder_;
};
std::unique_ptr<test::TemporaryFolder> Quality::folder_;

TEST_F(Quality, OfARunIsThatOfItsReport) {
    for (const char* run : {"run", "straight"}) {
        SCOPED_TRACE(run);
        const Json report = Json::parse(test::bytes_of_file(path(run) + "/report.json"));
        const Json found = quality_json({path(run)});
        EXPECT_EQ(found.at("quality"), report.at("quality"));
        EXPECT_EQ(found.at("forced"), report.at("forced"));
        EXPECT_EQ(found.at("tets"), report.at("totals").at("tets"));
        EXPECT_EQ(found.at("vertices"), report.at("totals").at("vertices"));
        EXPECT_EQ(found.at("parts"), report.at("parts").size());
        EXPECT_GT(found.at("interface_tets"), 0);
        EXPECT_GT(found.at("boundary_triangles"), 0);
    }
    // The cube's facets are kept.
    EXPECT_EQ(quality_json({path("run")}).at("boundary_triangles"), 4660);
}

TEST_F(Quality, OfAPartIsTheSameInEveryFormat) {
    const std::string part = path("run") + "/parts/part_0002.vtu";
    const Part read = read_part(part);
    const PartMesh mesh = mesh_of(read);
    const Json expected = quality_json({part});
    EXPECT_EQ(expected.at("tets"), mesh.tets.size());
    EXPECT_EQ(expected.at("boundary_triangles"),
              std::count(read.neighbour.begin(), read.neighbour.end(), NodeId::none()));
    EXPECT_GT(expected.at("interface_tets"), 0);
    std::vector<test::SurfaceFile> files = test::to_all_mesh_formats(mesh.boundary, mesh.tets);
    files.push_back({"tetgen.ele", test::to_element_list(mesh.tets, 1)});
    write("tetgen.node", test::to_node_list(mesh.boundary, 1));
    for (const test::SurfaceFile& file : files) {
        SCOPED_TRACE(file.name);
        const Json found = quality_json({write(file.name, file.bytes)});
        EXPECT_EQ(found.at("quality").at("all"), expected.at("quality").at("all"));
        EXPECT_EQ(found.at("boundary_triangles"), mesh.boundary.facets.size());
        EXPECT_EQ(found.at("interface_tets"), 0);
        EXPECT_EQ(found.at("turned_tets"), 0);
    }
}

// Of a file, of its run, and of that merged.
TEST_F(Quality, OfRegionsAddsUpToThatOfTheWhole) {
    const std::array<std::int32_t, 3> cubes = {4, 4, 4};
    const test::RegionOfCube grain = test::grains(cubes, 14, 5);
    const std::vector<double> volumes = test::voxel_body(cubes, grain).volumes;
    ASSERT_GT(volumes.size(), 10U);
    const std::string file = path("grains.mesh"), run = path("grains"), merged = path("grains.vtu");
    test::write_tets(file, cubes, grain);
    ASSERT_EQ(test::run_kerf({"mesh", file, "-o", run, "-n", "1", "-q"}).exit_code, 0);
    ASSERT_EQ(test::run_kerf({"merge", run, "-o", merged, "-q"}).exit_code, 0);
    for (const std::string& mesh : {file, run, merged}) {
        SCOPED_TRACE(mesh);
        const Json found = quality_json({mesh});
        const Json& regions = found.at("regions");
        ASSERT_EQ(regions.size(), volumes.size());
        std::int64_t tets = 0;
        double least = 180;
        for (std::size_t r = 0; r < volumes.size(); ++r) {
            EXPECT_NEAR(regions[r].at("volume"), volumes[r], 1e-12 * 64);
            tets += regions[r].at("tets").get<std::int64_t>();
            least = std::min(least, regions[r].at("quality").at("min_dihedral_deg").at("min").get<double>());
        }
        EXPECT_EQ(tets, found.at("tets"));
        EXPECT_EQ(least, found.at("quality").at("all").at("min_dihedral_deg").at("min"));
    }
    const Json of_run = quality_json({run}).at("regions"), of_merged = quality_json({merged}).at("regions");
    for (std::size_t r = 0; r < volumes.size(); ++r) {
        EXPECT_EQ(of_merged[r].at("name"), of_run[r].at("name"));
        EXPECT_EQ(of_merged[r].at("tets"), of_run[r].at("tets"));
        EXPECT_EQ(of_merged[r].at("quality"), of_run[r].at("quality"));
    }
    EXPECT_NE(output_of(quality({run})).find(" more, none with worse cells"), std::string::npos);
    EXPECT_EQ(output_of(quality({run, "-v"})).find("none with worse cells"), std::string::npos);
    const ChildResult missed = quality({run, "--fail-below", "min-dihedral=60"});
    EXPECT_EQ(missed.exit_code, 6);
    EXPECT_NE(missed.log.find("It is in the region 'region_"), std::string::npos) << missed.log;
    EXPECT_FALSE(quality_json({path("run")}).contains("regions"));
}

TEST_F(Quality, OfAMergedMeshIsThatOfItsParts) {
    const Json expected = quality_json({path("straight")});
    for (const char* ending : {"vtu", "mesh", "node"}) {
        SCOPED_TRACE(ending);
        const std::string file = path(std::string("merged.") + ending);
        ASSERT_EQ(test::run_program(test::kerf_program(), {"merge", path("straight"), "-o", file}).exit_code, 0);
        const Json found = quality_json({file});
        EXPECT_EQ(found.at("quality").at("all"), expected.at("quality").at("all"));
        EXPECT_EQ(found.at("forced"), expected.at("forced"));
        EXPECT_EQ(found.at("vertices"), expected.at("vertices"));
        EXPECT_EQ(found.at("boundary_triangles"), expected.at("boundary_triangles"));
        EXPECT_EQ(found.at("turned_tets"), 0);
    }
}

// A run says of its sharp cells what is to blame, and what helps: against an edge of the body nothing does.
TEST_F(Quality, OfARunThatIsBadIsExplained) {
    const auto prism = [](double height, double length) {
        std::string text;
        for (const double z : {0.0, length}) text += fmt::format("v 0 0 {0}\nv 1 0 {0}\nv 1 {1} {0}\n", z, height);
        return text + "f 1 3 2\nf 4 5 6\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\nf 3 1 4\nf 3 4 6\n";
    };
    struct Bad {
        std::string file, cause, words;
    };
    for (const auto& [file, cause, words] :
         {Bad{write("wedge.obj", prism(0.03, 0.2)), "edge", "an edge of 1.7 degrees there. Every mesh of this surface"},
          Bad{write("long.obj", prism(0.8, 150)), "facet", "--surface remesh makes better ones."}}) {
        const ChildResult run = test::run_kerf({"mesh", file, "-o", path("bad"), "-n", "1", "--surface", "keep"});
        ASSERT_EQ(run.exit_code, 0) << run.log;
        EXPECT_NE(run.log.find("\nsharp       "), std::string::npos) << run.log;
        EXPECT_NE(run.log.find(words), std::string::npos) << run.log;
        const Json report = Json::parse(test::bytes_of_file(path("bad/report.json")));
        const Json& worst = report.at("sharp").at("places").at(0);
        EXPECT_EQ(worst["cause"], cause);
        EXPECT_NEAR(worst["min_dihedral_deg"], report["quality"]["all"]["min_dihedral_deg"]["min"], 1e-9);
        EXPECT_LT(worst["min_dihedral_deg"], report["sharp"]["below_deg"]);
        EXPECT_EQ(report["input"]["faces_of_file"], 8);
    }
    const Json good = Json::parse(test::bytes_of_file(path("run/report.json")));
    EXPECT_EQ(good["sharp"]["tets"], 0);
}

TEST_F(Quality, SaysHowManyCellsWereTurned) {
    PartMesh mesh = mesh_of(read_part(path("run") + "/parts/part_0002.vtu"));
    const Json expected = quality_json({write("good.mesh", test::to_medit(mesh.boundary, mesh.tets))});
    std::swap(mesh.tets[0][2], mesh.tets[0][3]);
    std::swap(mesh.tets[5][0], mesh.tets[5][1]);
    const std::string turned = write("turned.mesh", test::to_medit(mesh.boundary, mesh.tets));
    EXPECT_EQ(quality_json({turned}).at("turned_tets"), 2);
    EXPECT_EQ(quality_json({turned}).at("quality").at("all").at("volume").at("min"),
              expected.at("quality").at("all").at("volume").at("min"));
    EXPECT_NE(output_of(quality({turned})).find("2 tetrahedra of negative orientation were turned."),
              std::string::npos);
}

TEST_F(Quality, ExitsWithSixWhereALimitIsMissed) {
    const std::string run = path("run");
    const Json all = quality_json({run}).at("quality").at("all");
    const double angle = all.at("min_dihedral_deg").at("min"), ratio = all.at("radius_edge").at("max");
    EXPECT_EQ(quality({run, "--fail-below", "min-dihedral=" + std::to_string(angle - 0.001)}).exit_code, 0);
    EXPECT_EQ(quality({run, "--fail-above", "radius-edge=" + std::to_string(ratio + 0.001)}).exit_code, 0);
    const ChildResult below = quality({run, "--fail-below", "shape=0,min-dihedral=" + std::to_string(angle + 0.001)});
    EXPECT_EQ(below.exit_code, 6);
    EXPECT_NE(below.log.find("The worst smallest dihedral angle is"), std::string::npos) << below.log;
    EXPECT_NE(output_of(below).find("All cells"), std::string::npos);
    EXPECT_EQ(quality({run, "--fail-above", "radius-edge=" + std::to_string(ratio - 0.001)}).exit_code, 6);
    const ChildResult json =
        quality({run, "--json", "--fail-below", "min-dihedral=90", "--fail-above", "max-angle=60"});
    EXPECT_EQ(json.exit_code, 6);
    EXPECT_EQ(Json::parse(output_of(json)).at("missed_limits").size(), 2U);
    expect_refused({run, "--fail-below", "max-dihedral=170"}, 2, "--fail-above");
    expect_refused({run, "--fail-above", "size=3"}, 2, "'size' is no measure");
}

TEST_F(Quality, PutsTwoMeshesBesideEachOther) {
    const std::string run = path("run"), other = path("straight");
    const std::string text = output_of(quality({run, "--compare", other}));
    EXPECT_NE(text.find("A " + run + ": 3 parts"), std::string::npos) << text;
    EXPECT_NE(text.find("B " + other + ": 4 parts"), std::string::npos) << text;
    const Json json = quality_json({run, "--compare", other});
    // Volumes and edges are counted over the larger of the two bodies: the numbers are those of each mesh alone, to the
    // width of a bin.
    const Json alone = quality_json({other}).at("quality").at("all");
    for (const auto& [measure, values] : json.at("compared_with").at("quality").at("all").items()) {
        EXPECT_EQ(values.at("min"), alone.at(measure).at("min")) << measure;
        EXPECT_EQ(values.at("max"), alone.at(measure).at("max")) << measure;
        EXPECT_NEAR(values.at("median"), alone.at(measure).at("median"),
                    0.05 * std::abs(values.at("median").get<double>()));
    }
    // Limits are for the first.
    EXPECT_EQ(quality({run, "--compare", other, "--fail-below", "min-dihedral=90"}).exit_code, 6);
}

TEST_F(Quality, DrawsTheSamePictureAgain) {
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--compare", path("straight")}}) {
        std::vector<std::string> pictures;
        for (const char* name : {"first.svg", "second.svg"}) {
            std::vector<std::string> arguments = {path("run"), "--picture", path(name)};
            arguments.insert(arguments.end(), more.begin(), more.end());
            ASSERT_EQ(quality(arguments).exit_code, 0);
            pictures.push_back(test::bytes_of_file(path(name)));
        }
        EXPECT_TRUE(pictures[0].starts_with("<?xml"));
        EXPECT_TRUE(pictures[0].ends_with("</svg>\n"));
        EXPECT_EQ(pictures[0], pictures[1]);
    }
}

TEST_F(Quality, RefusesWhatIsNoMesh) {
    expect_refused({path("none")}, 7, "none");
    expect_refused({test::asset_path("cube")}, 3, "no volume mesh");
    expect_refused({path("run") + "/mesh.pvtu"}, 3, "list of parts");
    expect_refused({path("run") + "/parts/part_0002.surface.vtu"}, 3, "holds no tetrahedra");
    std::filesystem::create_directory(path("empty"));
    expect_refused({path("empty")}, 7, "not a finished run");
    const std::string part = test::bytes_of_file(path("run") + "/parts/part_0002.vtu");
    expect_refused({write("truncated.vtu", part.substr(0, part.size() / 2))}, 3, "truncated");
    expect_refused({path("run"), "--compare", path("none")}, 7, "none");
    expect_refused({path("run"), "--picture", path("no_folder/a.svg")}, 7, "--picture");
    const std::string mesh = write("kept.mesh", test::to_medit(Soup{}, {}));
    expect_refused({mesh, "--picture", mesh}, 7, "--picture");
    expect_refused({}, 2, "mesh");
}

}  // namespace
}  // namespace kerf

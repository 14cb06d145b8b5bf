// Files as a caller of the kernel diagnoses and remeshes them: values, text and JSON.
#include "run/report/file_diagnosis.h"

#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/stl_writer.h"
#include "files/io/text_file.h"
#include "run/prepare/remeshed_file.h"
#include "run/report/repair_text.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

class FileDiagnosisTest : public testing::Test {
 protected:
    std::string write(Soup soup, const std::string& name) const {
        write_stl(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    }
    static InputOptions patches_by_angle() {
        InputOptions options;
        options.feature_angle_deg = 30;
        return options;
    }
    test::TemporaryFolder folder_;
};

TEST_F(FileDiagnosisTest, AClosedSurfaceCanBeMeshed) {
    const FileDiagnosis found = diagnose_file(write(test::box(), "box.stl"));
    EXPECT_EQ(found.exit_code(), 0);
    EXPECT_TRUE(to_text(found).ends_with("It can be meshed.\n"));
    const auto json = nlohmann::json::parse(to_json(found));
    EXPECT_TRUE(json["can_be_meshed"]);
    EXPECT_EQ(json["extent"], nlohmann::json::parse("[[0, 0, 0], [1, 1, 1]]"));
    EXPECT_EQ(json["area"], 6);
    EXPECT_EQ(json["volume"], 1);
    EXPECT_NE(to_text(found).find("  extent    1 x 1 x 1, from (0, 0, 0) to (1, 1, 1); area 6, volume 1\n"),
              std::string::npos)
        << to_text(found);
    const std::vector<PatchSummary> patches = patches_of_run(found, patches_by_angle());
    EXPECT_EQ(patches.size(), 6u);
}

TEST_F(FileDiagnosisTest, TheCommandHasAllFilesAndOptions) {
    const std::string one = write(test::box(), "one.stl"),
                      other = write(test::box(Vec3(1 - 1e-4, 0, 0), Vec3(2, 1, 1)), "other.stl");
    InputOptions options;
    options.more_files = {other};
    options.scale = 0.001;
    FileDiagnosis found = diagnose_file(one, options);
    found.remedy = find_remedy(one, options, found.checked);
    const std::string command =
        "kerf repair " + one + " " + other + " -o one_repaired.obj --scale 0.001 --repair full,snap,bodies=regions";
    EXPECT_NE(to_text(found).find(command + "\n"), std::string::npos) << to_text(found);
    const auto json = nlohmann::json::parse(to_json(found))["remedy"];
    EXPECT_EQ(json["command"], command);
    EXPECT_EQ(json["repair"], "full,snap,bodies=regions");
    found.remedy->options.wrap = true;
    found.remedy->options.repairs.plan.clear();
    EXPECT_EQ(command_of(*found.remedy, one), "kerf wrap " + one + " -o one_wrapped.obj --scale 0.001 --with " + other);
}

TEST_F(FileDiagnosisTest, AHoleIsOneDefectWithItsVertices) {
    Soup soup = test::box();
    soup.facets.pop_back();
    const FileDiagnosis found = diagnose_file(write(std::move(soup), "open.stl"));
    EXPECT_EQ(found.exit_code(), static_cast<int>(ErrorCode::input));
    const auto json = nlohmann::json::parse(to_json(found));
    ASSERT_EQ(json["defects"].size(), 1u);
    EXPECT_EQ(json["defects"][0]["kind"], "open edge loop");
    EXPECT_EQ(json["defects"][0]["vertices"].size(), 3u);
    EXPECT_TRUE(to_text(found).ends_with("It cannot be meshed as it is.\n"));
    EXPECT_THROW(patches_of_run(found, patches_by_angle()), Error);
}

// Two groups that touch, with vertices and walls of their own: a cube and a box of 2 x 1 x 1 beside it.
TEST_F(FileDiagnosisTest, RegionsAreListedWithTheirWalls) {
    std::string obj;
    std::size_t first = 1;
    for (const double low : {0.0, 1.0}) {
        const Soup box = test::box(Vec3(low, 0, 0), Vec3(1 + 2 * low, 1, 1));
        obj += low == 0 ? "g bone\n" : "g cement\n";
        for (const Vec3& p : box.vertices) obj += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
        for (const auto& [a, b, c] : box.facets) obj += fmt::format("f {} {} {}\n", a + first, b + first, c + first);
        first += box.vertices.size();
    }
    write_text_file(folder_.file("two.obj"), obj);
    const FileDiagnosis found = diagnose_file(folder_.file("two.obj"));
    ASSERT_TRUE(found.can_be_meshed()) << to_text(found);
    const std::string text = to_text(found);
    EXPECT_NE(text.find("  region    bone: volume 1, 1 shell, outside 5, wall to cement 1\n"), text.npos) << text;
    EXPECT_NE(text.find("  region    cement: volume 2, 1 shell, outside 9, wall to bone 1\n"), text.npos) << text;
    const std::string tables = tables_of_regions(found);
    EXPECT_NE(tables.find("\n--region bone="), text.npos) << tables;
    EXPECT_NE(tables.find("\n--region cement="), text.npos) << tables;
    const auto regions = nlohmann::json::parse(to_json(found))["regions"];
    ASSERT_EQ(regions.size(), 2U);
    EXPECT_EQ(regions[1]["name"], "cement");
    EXPECT_EQ(regions[1]["volume"], 2);
    EXPECT_EQ(regions[0]["walls"][0]["region"], "cement");
    EXPECT_EQ(regions[0]["walls"][0]["area"], 1);
    EXPECT_TRUE(nlohmann::json::parse(to_json(diagnose_file(write(test::box(), "box.stl"))))["regions"].empty());
}

TEST_F(FileDiagnosisTest, AFileThatIsNoSurfaceIsRefused) {
    write_text_file(folder_.file("none.obj"), "v 0 0\n");
    const FileDiagnosis found = diagnose_file(folder_.file("none.obj"));
    ASSERT_TRUE(found.refused);
    EXPECT_EQ(found.refused->kind, "unreadable");
    EXPECT_EQ(nlohmann::json::parse(to_json(found))["counts"]["unreadable"], 1);
    EXPECT_THROW(patches_of_run(found, {}), Error);
    EXPECT_THROW(diagnose_file(folder_.file("missing.stl")), Error);
}

TEST_F(FileDiagnosisTest, ARemeshedFileHasTheFacetsThatAreTold) {
    RunRequest options;
    options.input = write(test::box(), "box.stl");
    options.sizes.size = Length(0.25);
    const RemeshedFile written = remesh_file(options, folder_.file("fine.obj"));
    EXPECT_GT(written.facets, 12);
    EXPECT_EQ(written.done->facets_before, 12);
    EXPECT_EQ(diagnose_file(folder_.file("fine.obj")).checked.soup.facets.size(),
              static_cast<std::size_t>(written.facets));
    EXPECT_THROW(remesh_file(options, folder_.file("fine.vtu")), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("fine.vtu")));
}

TEST_F(FileDiagnosisTest, GoodFacetsStayWhereOnlyBadOnesAreRemeshed) {
    RunRequest options;
    const std::string output = folder_.file("better.obj");
    const auto remesh_bad = [&](const Soup& soup) {
        options.input = write(soup, "given.stl");
        return remesh_file(options, output, nullptr, Remeshing::where_needed);
    };
    const RemeshedFile good = remesh_bad(test::box());
    EXPECT_FALSE(good.done);
    EXPECT_EQ(good.facets, 12);
    EXPECT_EQ(diagnose_file(output).checked.soup.facets.size(), 12u);
    // A needle in one corner of a fine box: what is far from it stays.
    Soup needle = test::box({0, 0, 0}, {1, 1, 1}, {8, 8, 8});
    for (Vec3& p : needle.vertices)
        if (p.isApprox(Vec3(0.125, 0.125, 0))) p = {0.001, 0.125, 0};
    const auto facets = static_cast<std::int64_t>(needle.facets.size());
    const RemeshedFile some = remesh_bad(needle);
    ASSERT_TRUE(some.done);
    EXPECT_FALSE(some.notes.empty());
    EXPECT_GT(some.done->facets_kept, facets / 2);
    EXPECT_LT(some.done->facets_kept, facets);
    EXPECT_LT(some.done->angles_before.smallest, 1);
    EXPECT_GT(some.done->angles.smallest, 10);
    EXPECT_GE(some.done->angles.first_percent, some.done->angles.smallest);
}

TEST_F(FileDiagnosisTest, RemeshedRegionsAreReadAgainAsBodiesThatTouch) {
    RunRequest options;
    options.input = folder_.file("two.mesh");
    test::write_tets(options.input, {2, 1, 1}, [](const auto& cube) { return cube[0]; });
    options.sizes.size = Length(0.3);
    const RemeshedFile written = remesh_file(options, folder_.file("two.obj"));
    const Input again = read_input(folder_.file("two.obj"), {});
    EXPECT_EQ(again.complex.region_count(), 2);
    EXPECT_EQ(again.complex.facet_count(), written.facets);
    EXPECT_NEAR(again.regions[0].volume, 1, 1e-12);
    EXPECT_THROW(remesh_file(options, folder_.file("two.stl")), Error);
}

}  // namespace
}  // namespace kerf

// Files as a caller of the kernel diagnoses and remeshes them: values, text and JSON.
#include "report/file_diagnosis.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/stl_writer.h"
#include "io/text_file.h"
#include "prepare/remeshed_file.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

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
    EXPECT_TRUE(nlohmann::json::parse(to_json(found))["can_be_meshed"]);
    const std::vector<PatchSummary> patches = patches_of_run(found, patches_by_angle());
    EXPECT_EQ(patches.size(), 6u);
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
    RunOptions options;
    options.input = write(test::box(), "box.stl");
    options.sizes.size = Length(0.25);
    const RemeshedFile written = remesh_file(options, folder_.file("fine.obj"));
    EXPECT_GT(written.facets, 12);
    EXPECT_EQ(written.done.facets_before, 12);
    EXPECT_EQ(diagnose_file(folder_.file("fine.obj")).checked.soup.facets.size(),
              static_cast<std::size_t>(written.facets));
    EXPECT_THROW(remesh_file(options, folder_.file("fine.vtu")), Error);
    EXPECT_FALSE(std::filesystem::exists(folder_.file("fine.vtu")));
}

}  // namespace
}  // namespace kerf

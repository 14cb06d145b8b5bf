// --contour straight and --surface as a user sees them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

class StraightCuts : public testing::Test {
 protected:
    nlohmann::json report_of(const std::string& input, const std::vector<std::string>& more) const {
        std::vector<std::string> arguments = {"mesh", input, "-o", folder_.file("out"), "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult run = test::run_kerf(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.log;
        const ChildResult verified = test::run_kerf({"verify", folder_.file("out")});
        EXPECT_EQ(verified.exit_code, 0) << test::output_of(verified);
        return nlohmann::json::parse(test::bytes_of_file(folder_.file("out/report.json")));
    }
    // Beams whose facets are as long as a beam is thick: it has no good contour of edges.
    std::string written_frame() const {
        const Soup frame = test::porous_frame(2, 1);
        test::write_off(folder_.file("frame.off"), frame.vertices, frame.facets);
        return folder_.file("frame.off");
    }

 private:
    test::TemporaryFolder folder_;
};

TEST_F(StraightCuts, OnRequestEveryCutIsStraight) {
    const auto report = report_of(test::asset_path("hollow_box"), {"-n", "4", "--contour", "straight"});
    EXPECT_EQ(report["parts"].size(), 4u);
    EXPECT_GT(report["totals"]["split_facets"].get<double>(), 0);
    std::int64_t straight = 0;
    for (const auto& node : report["tree"]) straight += node.contains("cut") && node["cut"]["rung"] == "straight";
    EXPECT_EQ(straight, 3);
}

TEST_F(StraightCuts, SurfaceOfWellShapedFacetsIsNotSplit) {
    const auto report = report_of(test::asset_path("hollow_box"), {"-n", "4"});
    EXPECT_EQ(report["totals"]["split_facets"], 0);
}

TEST_F(StraightCuts, FacetsAreSplitWhereNoOtherCutExistsUnlessTheSurfaceIsKept) {
    const std::string frame = written_frame();
    const auto split = report_of(frame, {"-n", "4"});
    EXPECT_EQ(split["parts"].size(), 4u);
    EXPECT_GT(split["totals"]["split_facets"].get<double>(), 0);
    const auto kept = report_of(frame, {"-n", "4", "--surface", "keep"});
    EXPECT_EQ(kept["parts"].size(), 1u);
    EXPECT_EQ(kept["totals"]["split_facets"], 0);
}

}  // namespace
}  // namespace kerf

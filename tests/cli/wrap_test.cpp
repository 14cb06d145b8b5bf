// kerf wrap and --surface wrap as a user sees them: what cannot be meshed can be, and how far it is off is told.
#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/file_contents.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

using Json = nlohmann::json;

class Wrapping : public testing::Test {
 protected:
    Wrapping() {
        const Soup crossing = test::join(test::box(), test::box(Vec3::Constant(0.5), Vec3::Constant(1.25), 1));
        test::write_off(crossing_, crossing.vertices, crossing.facets);
    }

    test::TemporaryFolder folder_;
    const std::string crossing_ = folder_.file("crossing.off");
};

TEST_F(Wrapping, MakesASurfaceThatCheckCallsClean) {
    const std::string around = folder_.file("around.obj");
    EXPECT_NE(test::run_kerf({"check", crossing_}).exit_code, 0);
    const ChildResult wrapped = test::run_kerf({"wrap", crossing_, "-o", around, "--gap", "8%"});
    EXPECT_EQ(wrapped.exit_code, 0) << wrapped.log;
    EXPECT_NE(wrapped.log.find("facets around 24"), std::string::npos) << wrapped.log;
    const ChildResult checked = test::run_kerf({"check", around});
    EXPECT_EQ(checked.exit_code, 0) << checked.log;
}

// Without its lid a box is a wall that is filled, not a body: the volumes say so.
TEST_F(Wrapping, TellsThatOnlyTheWallAroundAnOpeningIsFilled) {
    Soup open = test::box();
    std::erase_if(open.facets, [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return open.vertices[v].z() == 1; });
    });
    test::write_off(folder_.file("open.off"), open.vertices, open.facets);
    const ChildResult wrapped =
        test::run_kerf({"wrap", folder_.file("open.off"), "-o", folder_.file("around.obj"), "--gap", "8%"});
    EXPECT_EQ(wrapped.exit_code, 0) << wrapped.log;
    EXPECT_NE(wrapped.log.find("only the wall around it is filled"), std::string::npos) << wrapped.log;
}

TEST_F(Wrapping, IsPartOfARunThatTellsOfIt) {
    const std::string out = folder_.file("out");
    const ChildResult meshed =
        test::run_kerf({"mesh", crossing_, "-o", out, "-n", "2", "--surface", "wrap", "--gap", "10%"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    const Json input = Json::parse(test::bytes_of_file(out + "/report.json"))["input"];
    EXPECT_EQ(input["wrap"]["facets_before"], 24);
    EXPECT_NEAR(input["wrap"]["gap"], 0.1 * 1.25 * std::sqrt(3.0), 1e-6);
    EXPECT_LE(input["wrap"]["distance_to_input"], input["wrap"]["gap"]);
    EXPECT_NEAR(input["volume"], 1 + 0.421875 - 0.125, 0.03);
    EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
}

TEST_F(Wrapping, RefusesAnOffsetWithoutAWrapAndLengthsOutOfRange) {
    const std::string around = folder_.file("around.obj");
    EXPECT_EQ(test::run_kerf({"check", crossing_, "--offset", "1%"}).exit_code, 2);
    for (const char* gap : {"90%", "1e-9"})
        EXPECT_EQ(test::run_kerf({"wrap", crossing_, "-o", around, "--gap", gap}).exit_code, 2) << gap;
}

}  // namespace
}  // namespace kerf

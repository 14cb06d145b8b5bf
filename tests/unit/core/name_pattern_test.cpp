// Names of patches with stars.
#include "base/core/name_pattern.h"

#include <gtest/gtest.h>

namespace kerf {
namespace {

TEST(Patterns, StarsStandForAnything) {
    EXPECT_TRUE(matches_pattern("face_1", "face_1"));
    EXPECT_FALSE(matches_pattern("face_1", "face_12"));
    EXPECT_FALSE(matches_pattern("ace_1", "face_1"));
    EXPECT_TRUE(matches_pattern("*", ""));
    EXPECT_TRUE(matches_pattern("*", "anything"));
    EXPECT_TRUE(matches_pattern("a*b*c", "aXbbYc"));
    EXPECT_FALSE(matches_pattern("a*b*c", "aXYc"));
    EXPECT_TRUE(matches_pattern("body/face *", "body/face 12"));
    EXPECT_FALSE(matches_pattern("", "a"));
    EXPECT_TRUE(matches_pattern("**", "a"));
}

TEST(Patterns, NoMatchIsRefusedWithTheNamesThatThereAre) {
    const std::vector<std::string> names = {"side_1", "side_2", "top"};
    EXPECT_EQ(matching_names("--size-on", "patch", "side*", names), (std::vector<std::int32_t>{0, 1}));
    try {
        matching_names("--size-on", "patch", "wall*", names);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        for (const char* word : {"--size-on", "'wall*'", "'side_1', 'side_2', 'top'"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace kerf

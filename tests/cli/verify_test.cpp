// kerf verify on good runs, damaged files and folders that are no runs.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "io/vtu_writer.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class Verify : public testing::Test {
 protected:
    void SetUp() override {
        const ChildResult run =
            test::run_kerf({"mesh", test::asset_path("hollow_box"), "-o", folder_.file("out"), "-n", "2", "-q"});
        ASSERT_EQ(run.exit_code, 0) << run.log;
    }
    std::string part() const { return folder_.file("out/parts/part_0002.vtu"); }

    // Overwrites one value of an array of the part file.
    template <class T>
    void overwrite(const std::string& array, std::int64_t index, T value) {
        std::fstream file(part(), std::ios::in | std::ios::out | std::ios::binary);
        std::string begin(vtu_header_limit, '\0');
        file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
        const VtuHeader::Array* found = nullptr;
        const VtuHeader header = parse_vtu_header(begin, part());
        ASSERT_TRUE(found = header.find(array)) << array;
        file.clear();
        file.seekp(found->position + 8 + index * static_cast<std::int64_t>(sizeof(T)));
        file.write(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void expect_broken(const std::string& words) {
        const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
        EXPECT_EQ(result.exit_code, 8) << test::output_of(result);
        EXPECT_NE(test::output_of(result).find(words), std::string::npos) << test::output_of(result);
    }

    test::TemporaryFolder folder_;
};

TEST_F(Verify, GoodRunHolds) {
    const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_NE(test::output_of(result).find("Every law holds."), std::string::npos);
}

TEST_F(Verify, MovedVertexIsFound) {
    overwrite("Points", 0, 0.1234);
    expect_broken("coordinates differ");
}

TEST_F(Verify, WrongNumberIsFound) {
    overwrite<std::int64_t>("GlobalVertexId", 3, 1000000);
    expect_broken("wrong global vertex numbers");
}

TEST_F(Verify, SwappedCornersAreFound) {
    overwrite<std::int32_t>("connectivity", 0, 0);
    overwrite<std::int32_t>("connectivity", 1, 0);
    expect_broken("not positively oriented");
}

TEST_F(Verify, TruncatedPartIsRefused) {
    std::filesystem::resize_file(part(), std::filesystem::file_size(part()) / 2);
    const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_NE(result.log.find("part_0002.vtu"), std::string::npos) << result.log;
}

TEST_F(Verify, FolderThatIsNoRunIsRefused) {
    const ChildResult result = test::run_kerf({"verify", folder_.file("none")});
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_NE(result.log.find("report.json"), std::string::npos) << result.log;
}

}  // namespace
}  // namespace kerf

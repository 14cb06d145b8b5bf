// One value of one file of a run is another: whoever reads the run says so, with the name of the file, and so nobody
// crashes or tells what is not true. Where somebody has computed the hashes again, nobody crashes all the same.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/export/merged_file.h"
#include "files/html/report_page.h"
#include "files/io/file_bytes.h"
#include "files/io/folder_files.h"
#include "files/io/json.h"
#include "files/io/text_file.h"
#include "files/part/inside/vtu_header.h"
#include "files/part/run_parts.h"
#include "files/part/solution_parts.h"
#include "files/quality/compared_quality.h"
#include "run/run/verify_folder.h"
#include "support/assets.h"
#include "support/run_in_process.h"
#include "support/sealed_run.h"
#include "support/seeded_numbers.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

constexpr int tamperings = 60;

struct Reader {
    const char* name;
    std::function<void(const std::string& folder)> read;
    bool reads_cells = true;
};

const std::vector<Reader>& readers() {
    static const std::vector<Reader> all = {
        {"parts",
         [](const std::string& folder) {
             const RunParts parts(folder);
             for (const PartIndex index : parts.outline().parts.ids())
                 for (const PartContent content :
                      {PartContent::all, PartContent::surface, PartContent::cells, PartContent::vertices})
                     parts.load_only(index, content);
         }},
        {"merge",
         [](const std::string& folder) {
             merge_run({.folder = folder, .output = folder + ".vtu", .options = {}, .is_cancelled = {}});
         }},
        {"quality", [](const std::string& folder) { compare_quality(folder); }},
        {"report", [](const std::string& folder) { report_page(folder, 1000); }, false},
    };
    return all;
}

class Tampering : public testing::TestWithParam<int> {
 protected:
    static void SetUpTestSuite() {
        runs_ = new test::TemporaryFolder;
        for (const int order : {1, 2}) {
            RunRequest options;
            options.order = order;
            options.curving = Curving::straight;
            ASSERT_EQ(test::run_parts(test::asset_path("hollow_box"), good(order), 3, options).exit_code, 0);
        }
    }
    static void TearDownTestSuite() {
        delete runs_;
        runs_ = nullptr;
    }
    static std::string good(int order) { return runs_->file(order == 1 ? "first" : "second"); }
    std::string run() const { return folder_.file("run"); }
    void restore() const {
        std::filesystem::remove_all(run());
        std::filesystem::copy(good(GetParam()), run(), std::filesystem::copy_options::recursive);
    }

    // A value of an array becomes another one, by the numbers. Returns which.
    std::string change_value(const std::string& file, test::SeededNumbers& numbers) const {
        std::string bytes = read_file(run() + "/" + file);
        const VtuHeader header = parse_vtu_header(bytes, file);
        const auto& array =
            header.arrays[static_cast<std::size_t>(numbers.integer(0, static_cast<int>(header.arrays.size()) - 1))];
        std::uint64_t size = 0;
        std::memcpy(&size, bytes.data() + array.position, sizeof size);
        const std::size_t width = array.type.ends_with("64") ? 8 : array.type.ends_with("32") ? 4 : 1;
        if (size < width) return "";
        const auto place = static_cast<std::size_t>(numbers.integer(0, static_cast<int>(size / width) - 1));
        char* const value = bytes.data() + array.position + sizeof size + place * width;
        const std::string before(value, width);
        constexpr std::array<std::int64_t, 7> others = {
            100, 77, std::int64_t{1} << 62, -1, 0x7ff0000000000000, std::numeric_limits<std::int64_t>::min(), 0};
        std::memcpy(value, &others[static_cast<std::size_t>(numbers.integer(0, 6))], width);
        if (before == std::string(value, width)) *value = static_cast<char>(*value ^ 1);
        write_text_file(run() + "/" + file, bytes);
        return file + ": " + array.name + "[" + std::to_string(place) + "]";
    }

    std::string some_part_file(test::SeededNumbers& numbers) const {
        std::vector<std::string> files = list_files(run() + "/parts");
        return "parts/" + files[static_cast<std::size_t>(numbers.integer(0, static_cast<int>(files.size()) - 1))];
    }

    static test::TemporaryFolder* runs_;
    test::TemporaryFolder folder_;
};
test::TemporaryFolder* Tampering::runs_ = nullptr;
INSTANTIATE_TEST_SUITE_P(Orders, Tampering, testing::Values(1, 2));

TEST_P(Tampering, WhoeverReadsAnotherValueNamesItsFile) {
    test::SeededNumbers numbers(static_cast<std::uint64_t>(GetParam()));
    for (int i = 0; i < tamperings; ++i) {
        restore();
        const std::string file = some_part_file(numbers), what = change_value(file, numbers);
        if (what.empty()) continue;
        for (const Reader& reader : readers()) {
            if (!reader.reads_cells && !file.ends_with(".surface.vtu")) continue;
            SCOPED_TRACE(std::string(reader.name) + ", " + what);
            try {
                reader.read(run());
                ADD_FAILURE() << "It was read as if nothing had happened.";
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::verification) << error.what();
                EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
            }
        }
        const FolderVerification found = verify_folder(run(), {.input = "", .without_input = true});
        EXPECT_EQ(found.exit_code(), 8) << what;
        EXPECT_EQ(std::ranges::count(found.differences, file + " is not as the run has written it"), 1) << what;
    }
}

TEST_P(Tampering, NobodyCrashesOverValuesWhoseHashesFit) {
    test::SeededNumbers numbers(100 + static_cast<std::uint64_t>(GetParam()));
    std::vector<Reader> all = readers();
    all.push_back({"verify", [](const std::string& folder) {
                       VerifyOptions options;
                       options.input = test::asset_path("hollow_box");
                       EXPECT_GE(verify_folder(folder, options).tets, 1);
                   }});
    for (int i = 0; i < tamperings; ++i) {
        restore();
        const std::string what = change_value(some_part_file(numbers), numbers);
        test::seal_run(run());
        for (const Reader& reader : all) {
            SCOPED_TRACE(std::string(reader.name) + ", " + what);
            try {
                reader.read(run());
            } catch (const Error& error) {
                EXPECT_TRUE(error.code() == ErrorCode::verification || error.code() == ErrorCode::io) << error.what();
            }
        }
    }
}

TEST_P(Tampering, AReportThatIsNotAsItWasWrittenIsRefused) {
    test::SeededNumbers numbers(7);
    for (int i = 0; i < tamperings; ++i) {
        restore();
        std::string text = read_file(run() + "/report.json");
        char& byte = text[static_cast<std::size_t>(numbers.integer(0, static_cast<int>(text.size()) - 1))];
        byte = static_cast<char>(byte ^ 1);
        write_text_file(run() + "/report.json", text);
        for (const Reader& reader : readers()) try {
                reader.read(run());
                ADD_FAILURE() << reader.name;
            } catch (const Error& error) {
                EXPECT_EQ(error.code(), ErrorCode::verification) << reader.name << error.what();
            }
    }
}

TEST_P(Tampering, AReportThatIsNoJsonIsRefusedThoughItsHashFits) {
    for (const char* text : {"{\n  \"exit_code\": Infinity\n}\n", "{\n  \"solve\": {\"mesh\": 1\n}\n", "[\n}\n"}) {
        restore();
        write_text_file(run() + "/report.json", sealed(text));
        std::vector<Reader> all = readers();
        all.push_back({"solution", [](const std::string& folder) { open_parts(folder); }});
        for (const Reader& reader : all) try {
                reader.read(run());
                ADD_FAILURE() << reader.name;
            } catch (const Error& error) {
                EXPECT_TRUE(error.code() == ErrorCode::verification || error.code() == ErrorCode::io) << error.what();
            }
    }
}

TEST(Solutions, OfNoStepsAreRefused) {
    const test::TemporaryFolder folder;
    write_text_file(folder.file("report.json"), sealed("{\n  \"steps\": []\n}\n"));
    EXPECT_THROW(find_solution_folder(folder.file("")), Error);
}

// Values of any depth would be destroyed by a function that calls itself.
TEST(DeepJson, IsRefused) {
    for (const char* opening : {"[", "{\"a\":"}) {
        std::string text;
        for (int i = 0; i < 1'000'000; ++i) text += opening;
        EXPECT_THROW(parse_json(text), nlohmann::json::exception);
        EXPECT_THROW(parse_ordered_json(text), nlohmann::json::exception);
        EXPECT_TRUE(parse_json_or_null(text).is_null());
    }
    const std::string brackets(1000, '[');
    EXPECT_EQ(parse_json("[\"" + brackets + "\\\"" + brackets + "\"]").size(), 1u);
    std::string deep(deepest_json, '[');
    EXPECT_TRUE(parse_json(deep + std::string(deepest_json, ']')).is_array());
}

}  // namespace
}  // namespace kerf

// What users get wrong: the exit code of the contract, one clear message, and nothing left behind.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "decompose/decomposition.h"
#include "support/assets.h"
#include "support/program.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

class BadInput : public testing::Test {
 protected:
    std::string write(const std::string& name, const Soup& soup) const {
        test::write_off(folder_.file(name), soup.vertices, soup.facets);
        return folder_.file(name);
    }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.file(name), std::ios::binary) << text;
        return folder_.file(name);
    }

    // Runs `kerf mesh input -o output -n parts more`; nothing may be added to the folder.
    void expect_refused(const std::string& input, int exit_code, const std::vector<std::string>& words,
                        const std::vector<std::string>& more = {"-n", "2"}, std::string output = {}) const {
        const std::vector<std::string> before = folder_.names();
        std::vector<std::string> arguments = {"mesh", input, "-o", output.empty() ? folder_.file("out") : output};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_message(test::run_kerf(arguments), exit_code, words);
        EXPECT_EQ(folder_.names(), before);
    }
    static void expect_message(const ChildResult& result, int exit_code, const std::vector<std::string>& words) {
        EXPECT_EQ(result.end, ChildResult::End::exited) << result.describe();
        EXPECT_EQ(result.exit_code, exit_code) << result.log;
        EXPECT_EQ(test::output_of(result), "");
        for (const std::string& word : words) EXPECT_NE(result.log.find(word), std::string::npos) << result.log;
        // One line; errors of usage add where help is to be had.
        EXPECT_LE(std::count(result.log.begin(), result.log.end(), '\n'), exit_code == 2 ? 2 : 1) << result.log;
    }

    test::TemporaryFolder folder_;
    const std::string good_ = test::asset_path("hollow_box");
};

TEST_F(BadInput, MissingFile) { expect_refused(folder_.file("no.stl"), 7, {"no.stl", "cannot be read"}); }
TEST_F(BadInput, Folder) { expect_refused(KERF_ASSETS, 7, {"it is a folder"}); }
TEST_F(BadInput, StandardInput) { expect_refused("-", 7, {"standard input is not supported"}); }
TEST_F(BadInput, EmptyFile) { expect_refused(write("empty.stl", ""), 3, {"empty.stl", "the file is empty"}); }
TEST_F(BadInput, NoSurface) { expect_refused(write("text.stl", "hello"), 3, {"text.stl", "not recognised"}); }

TEST_F(BadInput, TruncatedStl) {
    std::ifstream file(good_, std::ios::binary);
    std::string bytes(5000, '\0');
    file.read(bytes.data(), 5000);
    expect_refused(write("cut.stl", bytes), 3, {"cut.stl", "truncated"});
}

TEST_F(BadInput, OpenSurface) {
    Soup soup = test::icosphere(3);
    soup.facets.pop_back();
    expect_refused(write("open.off", soup), 3, {"open.off", "open", "edge"});
}

TEST_F(BadInput, SelfIntersectingSurface) {
    const Soup soup = test::join(test::icosphere(3), test::translated(test::icosphere(3), Vec3(0.5, 0.1, 0.2)));
    expect_refused(write("crossing.off", soup), 3, {"crossing.off", "intersect"});
}

TEST_F(BadInput, ZeroParts) { expect_refused(good_, 2, {"--parts is 0", "1 or more"}, {"-n", "0"}); }
TEST_F(BadInput, NegativeParts) { expect_refused(good_, 2, {"--parts is -3", "1 or more"}, {"-n", "-3"}); }
TEST_F(BadInput, TooManyParts) {
    expect_refused(good_, 2, {"3786 facets", "-n 946"}, {"-n", "947"});
    const std::int32_t most = 3786 / min_facets_per_part;
    expect_refused(good_, 2, {"3786 facets", "-n " + std::to_string(most)},
                   {"-n", std::to_string(most + 1), "--surface", "keep"});
}
TEST_F(BadInput, StraightContourThatKeepsTheSurface) {
    expect_refused(good_, 2, {"--contour straight", "--surface keep"}, {"--contour", "straight", "--surface", "keep"});
}
TEST_F(BadInput, PartsNoNumber) { expect_refused(good_, 2, {"--parts", "many"}, {"-n", "many"}); }
TEST_F(BadInput, UnknownOption) { expect_refused(good_, 2, {"--frobnicate"}, {"--frobnicate"}); }
TEST_F(BadInput, UnknownChoice) { expect_refused(good_, 2, {"--balance", "luck", "volume"}, {"--balance", "luck"}); }
TEST_F(BadInput, ValueOutOfRange) { expect_refused(good_, 2, {"--radius-edge is 0.5"}, {"--radius-edge", "0.5"}); }
TEST_F(BadInput, NotANumber) { expect_refused(good_, 2, {"--size is nan", "positive"}, {"--size", "nan"}); }

// Permission bits do not bind the root user, as whom containers test; these places bind everybody.
TEST_F(BadInput, OutputBelowAFile) {
    const std::string file = write("file", "");
    expect_refused(good_, 7, {"Cannot create", file}, {}, file + "/out");
}
TEST_F(BadInput, OutputInUnwritablePlace) {
    expect_refused(good_, 7, {"Cannot create", "/proc/kerf_out"}, {}, "/proc/kerf_out");
}
TEST_F(BadInput, OutputIsAFile) { expect_refused(good_, 7, {"is a file"}, {}, write("file", "")); }

TEST_F(BadInput, OutputIsNoRun) {
    std::filesystem::create_directory(folder_.file("thesis"));
    write("thesis/chapter.txt", "years of work");
    expect_refused(good_, 7, {"thesis", "not a run"}, {}, folder_.file("thesis"));
    EXPECT_TRUE(std::filesystem::exists(folder_.file("thesis/chapter.txt")));
}

TEST_F(BadInput, NothingToDo) {
    expect_message(test::run_kerf({}), 2, {"subcommand"});
    expect_message(test::run_kerf({"mesh"}), 2, {"input"});
    expect_message(test::run_kerf({"mesh", good_}), 2, {"--output"});
    expect_message(test::run_kerf({"saw", good_}), 2, {"'saw' is not a command"});
}

// The printed options, read again, print themselves; the command line wins over the file.
TEST_F(BadInput, ConfigFileGivesOptions) {
    const std::vector<std::string> mesh = {"mesh", good_, "-o", folder_.file("out")};
    const auto printed = [&](std::vector<std::string> options) {
        options.insert(options.begin(), mesh.begin(), mesh.end());
        options.push_back("--print-config");
        const ChildResult result = test::run_kerf(options);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return test::output_of(result);
    };
    const std::string text = printed({"-n", "3", "--size", "0.25", "--cut", "volume"});
    const std::string config = folder_.file("kerf.toml");
    std::ofstream(config) << text;
    EXPECT_EQ(printed({"--config", config}), text);
    EXPECT_EQ(printed({"--config", config, "-n", "5"}), printed({"-n", "5", "--size", "0.25", "--cut", "volume"}));

    std::ofstream(config) << "parts = 2\nsice = 1\n";
    expect_message(test::run_kerf({"mesh", good_, "-o", folder_.file("out"), "--config", config}), 2, {"'sice'"});
}

TEST_F(BadInput, RefusalKeepsTheOlderRun) {
    const std::vector<std::string> run = {"mesh", good_, "-o", folder_.file("out"), "-n", "1", "-q"};
    ASSERT_EQ(test::run_kerf(run).exit_code, 0);
    const std::string report = folder_.file("out/report.json");
    const auto written = std::filesystem::last_write_time(report);
    expect_refused(folder_.file("no.stl"), 7, {"no.stl"});
    EXPECT_EQ(std::filesystem::last_write_time(report), written);
}

TEST(Cli, HelpAndVersion) {
    const ChildResult help = test::run_kerf({"--help"}), of_mesh = test::run_kerf({"mesh", "--help"});
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(test::output_of(help).find("Exit codes"), std::string::npos);
    EXPECT_EQ(of_mesh.exit_code, 0);
    EXPECT_NE(test::output_of(of_mesh).find("--radius-edge"), std::string::npos);
    EXPECT_EQ(test::output_of(test::run_kerf({"--version"})), "kerf " KERF_VERSION "\n");
}

TEST(Cli, QuietRunIsSilentAndReportsToAFile) {
    const test::TemporaryFolder folder;
    const ChildResult result = test::run_kerf({"mesh", test::asset_path("cube"), "-o", folder.file("out"), "-n", "2",
                                               "-q", "--report", folder.file("copy.json")});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(test::output_of(result), "");
    EXPECT_EQ(result.log, "");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"copy.json", "out"}));
}

TEST(Cli, CheckNamesTheDefects) {
    const test::TemporaryFolder folder;
    Soup soup = test::icosphere(2);
    soup.facets.pop_back();
    test::write_off(folder.file("open.off"), soup.vertices, soup.facets);
    const ChildResult bad = test::run_kerf({"check", folder.file("open.off"), "--json"});
    EXPECT_EQ(bad.exit_code, 3);
    EXPECT_NE(test::output_of(bad).find("\"defects\": [\n"), std::string::npos) << test::output_of(bad);
    EXPECT_EQ(test::run_kerf({"check", test::asset_path("cube")}).exit_code, 0);
}

}  // namespace
}  // namespace kerf

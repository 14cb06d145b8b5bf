// What users get wrong: the exit code of the contract, one clear message, and nothing left behind.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cut/decompose/decomposition.h"
#include "support/assets.h"
#include "support/file_contents.h"
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
TEST_F(BadInput, Folder) {
    const test::TemporaryFolder other;
    std::filesystem::create_directory(other.file("inside"));
    expect_refused(other.file("inside"), 7, {"it is a folder"});
}
TEST_F(BadInput, StandardInput) { expect_refused("-", 7, {"standard input is not supported"}); }
TEST_F(BadInput, EmptyFile) { expect_refused(write("empty.stl", ""), 3, {"empty.stl", "the file is empty"}); }
TEST_F(BadInput, NoSurface) { expect_refused(write("text.stl", "hello"), 3, {"text.stl", "not recognised"}); }

TEST_F(BadInput, SizesThatAreNone) {
    expect_refused(good_, 2, {"box:1,2=3", "--size-in", "box:x0,y0,z0,x1,y1,z1=H"}, {"--size-in", "box:1,2=3"});
    expect_refused(good_, 2, {"--size-on", "NAME=H"}, {"--size-on", "inlet"});
    expect_refused(good_, 2, {"--size-near", "NAME=H:D"}, {"--size-near", "inlet=1"});
    expect_refused(good_, 2, {"'inlet'", "does not have", "It has "}, {"-n", "1", "--size-on", "inlet=1"});
    expect_refused(good_, 7, {"no.vtu", "cannot be read"}, {"-n", "1", "--size-field", folder_.file("no.vtu")});
    expect_refused(good_, 3, {"hollow_box"}, {"-n", "1", "--size-field", good_});
}

// Whoever asks for a number of cells has no size of his own, on the command line nor in a file.
TEST_F(BadInput, CellsBesideASize) {
    expect_refused(good_, 2, {"--cells is 50000 and --size is 0.1", "Leave one of them out"},
                   {"--cells", "50k", "--size", "0.1"});
    expect_refused(good_, 2, {"--cells is 50000 and --size is 2%"}, {"--cells", "50k", "--size", "2%"});
    expect_refused(good_, 2, {"--cells is 1000000 and --max-volume is 0.01"},
                   {"--cells", "1M", "--max-volume", "0.01"});
    const std::string config = write("kerf.toml", "size = 0.1\n");
    expect_refused(good_, 2, {"--cells", "--size is 0.1"}, {"--cells", "5000", "--config", config});
    for (const std::string cells : {"-5", "many", "1.5", "50 k", "1e99", ""})
        expect_refused(good_, 2, {"--cells is ", "must be", "50k or 1M"}, {"--cells", cells});
    expect_message(test::run_kerf({"remesh", good_, "-o", folder_.file("out.obj"), "--cells", "9k", "--size", "1"}), 2,
                   {"--cells is 9000 and --size is 1"});
}

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

// The first reason is the one that helps, whatever the remedies said.
TEST_F(BadInput, ShellsThatAlmostTouchForTetGen) {
    const Soup ball = test::icosphere(2), inner = test::inside_out(test::icosphere(2, 1 - 1e-12));
    const ChildResult result =
        test::run_kerf({"mesh", write("balls.off", test::join(ball, inner)), "-o", folder_.file("out"), "-n", "1", "-q",
                        "--mesher", "tetgen", "--tetgen-switches", "q1.4"});
    EXPECT_EQ(result.exit_code, 4) << result.log;
    EXPECT_NE(result.log.find("could not be meshed: TetGen stopped with code 3: it found facets that intersect"),
              std::string::npos)
        << result.log;
}

// No bad input: between the shells the sum of cones has no digits that agree to 1e-10, but the mesh is right.
TEST_F(BadInput, ShellsTooNearForTheirVolumeAreMeshed) {
    const Soup ball = test::icosphere(2), inner = test::inside_out(test::icosphere(2, 1 - 1e-9));
    const std::string input = write("balls.off", test::join(ball, inner)), out = folder_.file("out");
    const ChildResult result = test::run_kerf({"mesh", input, "-o", out, "-n", "1", "-q"});
    EXPECT_EQ(result.exit_code, 0) << result.log;
    EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
    const auto laws = nlohmann::json::parse(test::bytes_of_file(out + "/report.json"))["verification"];
    EXPECT_GT(laws["volume_rel_error"], 1e-10);
    EXPECT_LE(laws["volume_rel_error"], laws["volume_rel_bound"]);
    EXPECT_LT(laws["volume_rel_bound"], 1e-4);  // much less than a cell has
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
TEST_F(BadInput, PartsNoNumber) { expect_refused(good_, 2, {"--parts", "'many'"}, {"-n", "many"}); }
TEST_F(BadInput, UnknownOption) { expect_refused(good_, 2, {"--frobnicate"}, {"--frobnicate"}); }
TEST_F(BadInput, UnknownChoice) { expect_refused(good_, 2, {"--balance", "luck", "volume"}, {"--balance", "luck"}); }
TEST_F(BadInput, UnitOfAFileThatHasNone) {
    for (const char* command : {"mesh", "decompose", "check", "remesh"}) {
        std::vector<std::string> arguments = {command, good_, "--unit", "mm"};
        if (arguments[0] != "check")
            arguments.insert(arguments.end(), {"-o", folder_.file(arguments[0] == "remesh" ? "out.obj" : "out")});
        expect_message(test::run_kerf(arguments), 2, {"hollow_box", "names no unit", "--scale 0.001"});
    }
    expect_refused(good_, 2, {"names no unit"}, {"--unit", "inch"});
}
TEST_F(BadInput, ScaleOutOfRange) {
    for (const char* scale : {"0", "-1"}) expect_refused(good_, 2, {"--scale is ", "positive"}, {"--scale", scale});
    for (const char* command : {"check", "remesh"}) {
        std::vector<std::string> arguments = {command, good_, "--scale", "-0.5"};
        if (arguments[0] != "check") arguments.insert(arguments.end(), {"-o", folder_.file("out.obj")});
        expect_message(test::run_kerf(arguments), 2, {"--scale is -0.5"});
    }
}
TEST_F(BadInput, ValueOutOfRange) { expect_refused(good_, 2, {"--radius-edge is 0.5"}, {"--radius-edge", "0.5"}); }

// Neither silently none nor silently all.
TEST_F(BadInput, NumbersBeyondTheirType) {
    for (const std::string option :
         {"--size", "--max-volume", "--radius-edge", "--timeout", "--weld", "--feature-angle", "--scale"})
        for (const std::string value : {"nan", "inf", "-inf", "1e-400", "1e400", "", "1x"})
            expect_refused(good_, 2, {option}, {option, value});
    for (const std::string option : {"-n", "--workers", "--attempts", "--memory", "--optimise-surface"})
        for (const std::string value : {"99999999999999999999", "1.5", "nan"})
            expect_refused(good_, 2, {}, {option, value});
    expect_refused(good_, 2, {"--size is 1e-300", "cube"}, {"--size", "1e-300"});
    expect_refused(good_, 2, {"--workers is 2147483647", "4096"}, {"--workers", "2147483647"});
}

TEST_F(BadInput, SwitchesThatAskForSomethingElse) {
    for (const std::string switches : {"r", "o2", "h", "q1.2k", "zz", "q1.2 a"})
        expect_refused(good_, 2, {"--tetgen-switches", switches}, {"--tetgen-switches", switches});
}

// At once, and with the size that would do.
TEST_F(BadInput, SizesBeyondAllBudgets) {
    for (const std::string size : {"1e-5", "1e-4", "1e-100"})
        expect_refused(good_, 5, {"tetrahedra", "Use --size 0.0", "or larger"}, {"-n", "2", "--size", size});
    expect_refused(good_, 5, {"whose files take", "another disk"}, {"-n", "946", "--size", "0.0013"});
}

// Before the first facet: remeshing for what cannot be filled, or held, would fill the memory first.
TEST_F(BadInput, SizesBeyondAllBudgetsAreNotRemeshedFor) {
    for (const std::string size : {"1e-4", "1e-100"}) {
        expect_refused(good_, 5, {"tetrahedra", "Use --size 0.0", "or larger"},
                       {"-n", "2", "--size", size, "--surface", "remesh"});
        expect_message(test::run_kerf({"remesh", good_, "-o", folder_.file("out.stl"), "--size", size}), 5,
                       {"facets", "there is memory for", "Use --size 0.0", "or larger"});
    }
    EXPECT_TRUE(folder_.names().empty());
}

TEST_F(BadInput, TextThatIsNone) {
    const std::string text =
        "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n"
        " endfacet\n";
    std::string utf16 = "\xFF\xFE";
    for (const char c : text) utf16 += {c, '\0'};
    expect_refused(write("utf16.stl", utf16), 3, {"utf16.stl", "UTF-16", "ASCII or UTF-8"});
    expect_refused(write("utf16_without_mark.stl", utf16.substr(2)), 3, {"UTF-16"});
    std::string zero = text;
    zero[100] = '\0';
    expect_refused(write("zero.stl", zero), 3, {"zero.stl", "byte 100 is zero"});
}

TEST_F(BadInput, PipesAndDevices) {
    ASSERT_EQ(::mkfifo(folder_.file("pipe").c_str(), 0600), 0);
    expect_refused(folder_.file("pipe"), 7, {"a pipe or a device"});
    expect_refused("/dev/zero", 7, {"a pipe or a device"});
    expect_refused(good_, 7, {"a pipe or a device"}, {"--config", "/dev/zero"});
    expect_refused(good_, 7, {"it is a folder"}, {"--config", folder_.file("")});
}

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
    expect_message(test::run_kerf({}), 2, {"Which command?", "mesh, decompose"});
    expect_message(test::run_kerf({"mesh"}), 2, {"kerf mesh needs INPUT", "Example: kerf mesh part.stl"});
    expect_message(test::run_kerf({"saw", good_}), 2, {"'saw' is not a command"});
    expect_message(test::run_kerf({good_}), 2, {"kerf check " + good_, "kerf mesh " + good_ + " -o hollow_box-mesh"});
    expect_message(test::run_kerf({"no.stl"}), 2, {"kerf check no.stl"});
    std::filesystem::create_directory(folder_.file("folder"));
    expect_message(test::run_kerf({folder_.file("folder")}), 2, {"is a folder", "kerf verify"});
}

// The printed options, read again, print themselves; the command line wins over the file.
TEST_F(BadInput, ConfigFileGivesOptions) {
    const auto printed = [&](std::vector<std::string> options) {
        options.insert(options.begin(), "mesh");
        options.push_back("--print-config");
        const ChildResult result = test::run_kerf(options);
        EXPECT_EQ(result.exit_code, 0) << result.log;
        return test::output_of(result);
    };
    const std::string odd = folder_.file("line\nend \"quoted\" \xC3\xA4 back\\slash");
    const std::vector<std::string> given = {"-n", "3", "--size", "0.25", "--cut", "volume", "--stl", "-q", "-o", odd};
    const std::string text = printed(given);
    const std::string config = folder_.file("kerf.toml");
    for (const std::string& again : {text, printed({})}) {
        std::ofstream(config) << again;
        EXPECT_EQ(printed({"--config", config}), again);
    }
    std::ofstream(config) << text;
    std::vector<std::string> more = given;
    more[1] = "5";
    EXPECT_EQ(printed({"--config", config, "-n", "5"}), printed(more));

    std::ofstream(config) << "surface = \"keep\"\n";
    EXPECT_EQ(printed({"--config", config, "--surface", "remesh"}), printed({"--surface", "remesh"}));
    EXPECT_NE(printed({"--config", config}), printed({"--surface", "remesh"}));

    std::ofstream(config) << "improve = false\n";
    EXPECT_EQ(printed({"--config", config}), printed({"--no-improve"}));
    EXPECT_EQ(printed({"--config", config, "--improve"}), printed({}));
    EXPECT_NE(printed({"--config", config}), printed({}));
    std::ofstream(config) << "improve = true\n";
    EXPECT_EQ(printed({"--config", config, "--no-improve"}), printed({"--no-improve"}));

    const std::vector<std::pair<std::string, std::string>> mistakes = {
        {"parts = 2\nsice = 1\n", "line 2: 'sice'"},
        {"parts = \"many\"\n", "line 1: --parts is 'many'"},
        {"\nsize = nan\n", "line 2: --size"},
        {"parts = 2\ngrowth = 99\n", "line 2: --growth"},
        {"stl = 1\n", "line 1: --stl is '1'"},
        {"cut = \"saw\"\n", "line 1: --cut is 'saw'"},
        {"parts = [2]\n", "line 1"},
        {"size = 1\nparts 2\n", "line 2"}};
    for (const auto& [mistake, words] : mistakes) {
        std::ofstream(config) << mistake;
        expect_message(test::run_kerf({"mesh", good_, "-o", folder_.file("out"), "--config", config}), 2, {words});
    }
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

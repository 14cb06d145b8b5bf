// What the program writes, and what it must never touch: files of others, inputs, devices, streams that are closed.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/file_contents.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

class Outputs : public testing::Test {
 protected:
    void SetUp() override {
        fs::copy_file(test::asset_path("cube"), input_);
        std::ofstream(file("thesis.txt")) << "years of work";
    }
    std::string file(const std::string& name) const { return folder_.file(name); }

    ChildResult mesh(const std::vector<std::string>& more, const std::string& output = "out") const {
        std::vector<std::string> arguments = {"mesh", input_, "-o", file(output), "-n", "2", "--workers", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::run_kerf(arguments);
    }
    // Nothing at all may change.
    void expect_refused(const std::vector<std::string>& command, const std::vector<std::string>& words) const {
        const auto before = test::contents_below(file(""));
        const ChildResult result = test::run_kerf(command);
        EXPECT_EQ(result.exit_code, 7) << result.log;
        for (const std::string& word : words) EXPECT_NE(result.log.find(word), std::string::npos) << result.log;
        EXPECT_TRUE(test::contents_below(file("")) == before);
    }
    // A shell command in which K is the program and I the input.
    ChildResult shell(const std::string& command) const {
        const test::Surroundings around({input_, "-o", file("out"), "-o", file("code"), "-o", file("log")});
        ChildResult result = test::run_program("/bin/sh", {"-c", "K='" + test::kerf_program() + "'; I='" + input_ +
                                                                     "'; cd '" + file("") + "' && " + command});
        EXPECT_EQ(around.changes(), "");
        return result;
    }

    test::TemporaryFolder folder_;
    const std::string input_ = folder_.file("input.stl");
};

TEST_F(Outputs, AFolderWithFilesOfOthersIsNotReplaced) {
    ASSERT_EQ(mesh({}).exit_code, 0);
    fs::copy_file(input_, file("out/in.stl"));
    expect_refused({"mesh", file("out/in.stl"), "-o", file("out"), "-n", "2"}, {"in.stl", "lies in the output"});
    fs::remove(file("out/in.stl"));
    fs::rename(file("thesis.txt"), file("out/thesis.txt"));
    expect_refused({"mesh", input_, "-o", file("out"), "-n", "2"}, {"thesis.txt"});
    expect_refused({"decompose", input_, "-o", file("out"), "-n", "2"}, {"thesis.txt"});
    fs::rename(file("out/thesis.txt"), file("thesis.txt"));
    EXPECT_EQ(mesh({}).exit_code, 0);
}

TEST_F(Outputs, TheInputIsNeverOverwritten) {
    fs::create_hard_link(input_, file("hard"));
    fs::create_symlink(input_, file("soft"));
    for (const std::string name : {"input.stl", "hard", "soft"})
        for (const std::string option : {"--report", "--trace", "--events"}) {
            SCOPED_TRACE(option + " " + name);
            expect_refused({"mesh", input_, "-o", file("out"), "-n", "2", option, file(name)},
                           {option, "is the input"});
        }
    expect_refused({"check", input_, "--offenders", file("soft")}, {"--offenders", "is the input"});
    expect_refused({"mesh", input_, "-o", input_, "-n", "2"}, {"input.stl"});
}

TEST_F(Outputs, TwoAtOnePlaceAreRefused) {
    fs::create_symlink("a", file("link"));
    std::ofstream(file("kerf.toml")) << "parts = 2\n";
    const std::vector<std::string> options = {"--report", "--trace", "--events"};
    const auto before = test::contents_below(file(""));
    for (const std::string& one : options)
        for (const std::string& other : options)
            for (const char* name : {"a", "./a", "link"}) {
                if (one == other) continue;
                const ChildResult result = mesh({one, file("a"), other, file(name)});
                EXPECT_EQ(result.exit_code, 2) << result.log;
                EXPECT_NE(result.log.find("one of them would be lost"), std::string::npos) << result.log;
            }
    for (const std::string& option : options) {
        const ChildResult result = mesh({"--config", file("kerf.toml"), option, file("kerf.toml")});
        EXPECT_EQ(result.exit_code, 7) << result.log;
        EXPECT_NE(result.log.find(option), std::string::npos) << result.log;
    }
    EXPECT_TRUE(test::contents_below(file("")) == before);
    EXPECT_EQ(mesh({"--report", "/dev/null", "--trace", "/dev/null"}).exit_code, 0) << "a device takes both";
}

TEST_F(Outputs, WhatCannotBeWrittenIsSaidBeforeTheWork) {
    for (const std::string option : {"--report", "--trace", "--events"}) {
        expect_refused({"mesh", input_, "-o", file("out"), option, file("no/file")}, {option, "no/file"});
        expect_refused({"mesh", input_, "-o", file("out"), option, file("")}, {option, "directory"});
    }
}

TEST_F(Outputs, LinksAreFollowedAndPipesAreWrittenTo) {
    std::ofstream(file("older.json")) << "{\n  \"schema\": 1,\n  \"kerf\": \"";
    fs::create_symlink("older.json", file("report"));
    fs::create_symlink("missing.json", file("other"));
    ASSERT_EQ(mesh({"--report", file("report")}).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(file("report")));
    EXPECT_EQ(test::bytes_of_file(file("older.json")), test::bytes_of_file(file("out/report.json")));
    ASSERT_EQ(mesh({"--report", file("other")}).exit_code, 0);
    EXPECT_EQ(test::bytes_of_file(file("missing.json")), test::bytes_of_file(file("out/report.json")));
    ASSERT_EQ(mesh({"--report", "/dev/null"}).exit_code, 0);
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_EQ(mesh({"--report", "/dev/full"}).exit_code, 7);
    const ChildResult piped = shell("$K mesh $I -o out -n 2 -q --report /dev/stdout | cat");
    EXPECT_EQ(test::output_of(piped), test::bytes_of_file(file("out/report.json"))) << piped.log;
}

// Each output over what each command writes, and over what none does.
TEST_F(Outputs, FilesOfAnotherKindAreNotReplaced) {
    ASSERT_EQ(mesh({}, "run").exit_code, 0);
    const std::string run = file("run");
    struct Output {
        std::string name;
        std::vector<std::string> command;  // the file follows
    };
    const std::vector<std::string> meshing = {"mesh", input_, "-o", file("out"), "-n", "2", "--workers", "1", "-q"};
    std::vector<Output> outputs = {{"a.obj", {"repair", input_, "-o"}},  // of one kind with the STL
                                   {"b.html", {"report", run, "-o"}},
                                   {"c.svg", {"quality", run, "--picture"}},
                                   {"d.vtu", {"check", input_, "--offenders"}},
                                   {"e.stl", {"remesh", input_, "-q", "-o"}}};
    for (const char* ending : {"msh", "mesh", "inp", "su2", "vtk", "unv", "feb", "med", "cgns"})
        outputs.push_back({std::string("merged.") + ending, {"merge", run, "-o"}});
    for (const char* option : {"--report", "--trace", "--events"}) {
        outputs.push_back({option + 2, meshing});
        outputs.back().command.push_back(option);
    }
    const auto with_file = [&](const Output& output) {
        std::vector<std::string> all = output.command;
        all.push_back(file(output.name));
        return all;
    };
    std::vector<std::string> contents = {"years of work"};
    for (const Output& output : outputs)
        for (const char* time : {"first", "again"}) {
            const ChildResult result = test::run_kerf(with_file(output));
            EXPECT_EQ(result.exit_code, 0) << time << ", " << output.name << result.log;
        }
    for (const Output& output : outputs) contents.push_back(test::bytes_of_file(file(output.name)));
    for (std::size_t i = 0; i < outputs.size(); ++i)
        for (const std::size_t other : {std::size_t{0}, (i + 1) % outputs.size() + 1}) {
            SCOPED_TRACE(outputs[i].name + (other == 0 ? " for text" : " for " + outputs[other - 1].name));
            std::ofstream(file(outputs[i].name), std::ios::binary) << contents[other];
            expect_refused(with_file(outputs[i]), {outputs[i].name, "would be lost"});
        }
}

TEST_F(Outputs, AConfigWritesNothingButARun) {
    for (const std::string option : {"report", "trace", "events"}) {
        std::ofstream(file("kerf.toml")) << "parts = 2\n" << option << " = \"" << file("elsewhere") << "\"\n";
        const ChildResult result = mesh({"--config", file("kerf.toml")});
        EXPECT_EQ(result.exit_code, 2) << result.log;
        EXPECT_NE(result.log.find("line 2: '" + option + "'"), std::string::npos) << result.log;
        EXPECT_EQ(test::output_of(test::run_kerf({"mesh", "--print-config"})).find("\n" + option), std::string::npos);
    }
    EXPECT_FALSE(fs::exists(file("elsewhere")) || fs::exists(file("out")));
}

TEST_F(Outputs, AFolderIsNotMadeWithTheNameOfAFile) {
    ASSERT_EQ(mesh({}).exit_code, 0);
    for (const std::string name : {"x.foo", "x.stl", "x.v2"}) {
        for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
                 {"mesh", input_}, {"decompose", input_}, {"export", file("out"), "--format", "su2"}}) {
            std::vector<std::string> all = command;
            all.insert(all.end(), {"-o", file(name)});
            const ChildResult result = test::run_kerf(all);
            EXPECT_EQ(result.exit_code, 2) << result.log;
            EXPECT_NE(result.log.find(name + "/"), std::string::npos) << result.log;
        }
        EXPECT_FALSE(fs::exists(file(name)));
    }
    EXPECT_EQ(mesh({}, "x.foo/").exit_code, 0);
    EXPECT_EQ(mesh({}, "x.foo").exit_code, 0) << "the folder is there";
    EXPECT_EQ(mesh({}, "size.0.5").exit_code, 0);
}

TEST_F(Outputs, NamesMayBeAsLongAsTheDiskAllows) {
    const std::string longest = std::string(248, 'a') + ".stl";
    fs::copy_file(input_, file(longest));
    EXPECT_EQ(test::run_kerf({"check", file(longest)}).exit_code, 0);
    for (const std::size_t length : {200, 250, 255}) {
        const ChildResult result = mesh({}, std::string(length, 'b'));
        EXPECT_EQ(result.exit_code, length == 200 ? 0 : 7) << result.log;
    }
}

// What was in the file that the shell has opened stays, and what follows comes behind.
TEST_F(Outputs, StandardStreamsAreNotReplaced) {
    for (const std::string name : {"/dev/stdout", "/dev/fd/1", "fd:1", "/proc/self/fd/1"}) {
        SCOPED_TRACE(name);
        std::ofstream(file("log")) << "before\n";
        const bool is_report = name != "fd:1";
        shell(std::string("$K mesh $I -o out -n 2 -q ") + (is_report ? "--report " : "--events ") + name +
              " >>log; echo after >>log");
        const std::string log = test::bytes_of_file(file("log"));
        EXPECT_TRUE(log.starts_with("before\n{") && log.ends_with("}\nafter\n")) << log;
    }
}

TEST_F(Outputs, AnInputBesideTheOutputThatTheRunWouldRemoveIsRefused) {
    for (const std::string suffix : {".failed", ".kerf-partial", ".kerf-partial-older", ".kerf-partial-removed"}) {
        fs::create_directory(file("out" + suffix));
        const std::string inside = file("out" + suffix + "/part_0011.smesh");
        fs::copy_file(input_, inside);
        expect_refused({"mesh", inside, "-o", file("out"), "-n", "2"}, {"lies in the output"});
        fs::remove_all(file("out" + suffix));
    }
}

TEST_F(Outputs, WriteProtectedFilesAreNotReplaced) {
    if (::geteuid() == 0) return;  // whom no permission binds
    std::ofstream(file("report")) << "older";
    fs::permissions(file("report"), fs::perms::owner_read);
    expect_refused({"mesh", input_, "-o", file("out"), "--report", file("report")}, {"--report", "Permission denied"});
}

TEST_F(Outputs, ALinkToNothingYetIsFollowed) {
    fs::create_symlink("nowhere", file("out"));
    EXPECT_EQ(mesh({}).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(file("out")));
    EXPECT_TRUE(fs::exists(file("nowhere/report.json")));
}

// A run does not fail because nobody listens.
TEST_F(Outputs, ProgressNeverFailsARun) {
    for (const std::string ending : {"2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-", "2>&1 | head -1"}) {
        SCOPED_TRACE(ending);
        const std::string run = "$K mesh $I -o out -n 2";
        const bool is_piped = ending.find('|') != std::string::npos;
        const ChildResult result =
            shell(is_piped ? "(" + run + "; echo $? >code) " + ending : run + " " + ending + "; echo $? >code");
        EXPECT_EQ(test::bytes_of_file(file("code")), "0\n") << result.log;
        EXPECT_EQ(test::run_kerf({"verify", file("out")}).exit_code, 0);
    }
    shell("$K mesh nothing.stl -o no 2>&-; echo $? >code");
    EXPECT_EQ(test::bytes_of_file(file("code")), "7\n");
}

// Data that was asked for and cannot be written is an error; a reader that leaves has seen enough.
TEST_F(Outputs, DataThatIsLostIsAnError) {
    ASSERT_EQ(mesh({}).exit_code, 0);
    for (const std::string command : {"check $I --json", "check $I", "verify out", "mesh --print-config", "--help"}) {
        SCOPED_TRACE(command);
        const ChildResult full = shell("$K " + command + " >/dev/full; echo $? >code");
        EXPECT_EQ(test::bytes_of_file(file("code")), "7\n");
        EXPECT_NE(full.log.find("standard output"), std::string::npos) << full.log;
        shell("$K " + command + " >&- ; echo $? >code");
        EXPECT_EQ(test::bytes_of_file(file("code")), "7\n");
        shell("($K " + command + "; echo $? >code) | true");
        EXPECT_EQ(test::bytes_of_file(file("code")), "0\n");
    }
}

// Any bytes but '/' and zero make a name.
TEST_F(Outputs, PathsMayBeAnyBytes) {
    const std::string odd = "\xFF\xFE bytes:%41\n.stl";
    fs::copy_file(input_, file(odd));
    const ChildResult run = test::run_kerf({"mesh", file(odd), "-o", file("out\xC0"), "-n", "2"});
    EXPECT_EQ(run.exit_code, 0) << run.log;
    const ChildResult verified = test::run_kerf({"verify", file("out\xC0")});
    EXPECT_EQ(verified.exit_code, 0);
    EXPECT_NE(test::output_of(verified).find("Every law holds."), std::string::npos) << test::output_of(verified);
}

// The result of a name must not depend on where it is looked at from.
TEST_F(Outputs, RelativePathsAreStoredAbsolute) {
    ASSERT_EQ(shell("$K mesh input.stl -o out -n 2").exit_code, 0);
    const ChildResult verified =
        test::run_program("/bin/sh", {"-c", "cd / && '" + test::kerf_program() + "' verify '" + file("out") + "'"});
    EXPECT_NE(test::output_of(verified).find("Every law holds."), std::string::npos) << test::output_of(verified);
}

}  // namespace
}  // namespace kerf

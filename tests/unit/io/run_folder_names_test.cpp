// The files of runs with thousands of parts lie in folders of a few hundred.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "support/file_contents.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

// Names of a part in a run and while it is under way, relative to the partial folder.
std::vector<std::string> names_of(NodeId leaf) {
    return {"parts/" + stored_part_file_name(leaf),
            "parts/" + part_file_name(leaf),
            "parts/" + part_surface_file_name(leaf),
            "parts/" + part_stl_file_name(leaf),
            "failed/" + failed_part_file_name(leaf),
            job_file_name(leaf),
            journal_file_name(leaf),
            begun_file_name(leaf)};
}

// A run of up to 1,024 parts has leaves below 2,048.
TEST(RunFolderNames, OfAThousandPartsLieInOneFolder) {
    for (int leaf = 1; leaf < 2048; ++leaf)
        for (const std::string& name : names_of(NodeId(leaf)))
            EXPECT_EQ(std::count(name.begin(), name.end(), '/'), name.starts_with("work/") ? 2 : 1) << name;
}

// A tree of a thousand parts may have leaves on both sides of the first number that has a folder.
TEST(RunFolderNames, NoFolderIsNamedAsAFileBesideIt) {
    std::set<std::string> names;
    for (int leaf = 1; leaf < 9000; ++leaf)
        for (const std::string& name : names_of(NodeId(leaf))) names.insert(name);
    for (const std::string& name : names) EXPECT_FALSE(names.contains(fs::path(name).parent_path())) << name;
}

TEST(RunFolderNames, OfThousandsOfPartsNoFolderHoldsMoreThanAThousandNames) {
    for (const int parts : {4000, 4096}) {
        std::map<fs::path, int> count;
        std::set<std::string> all;
        for (int leaf = parts; leaf < 2 * parts; ++leaf) {
            for (const std::string& name : names_of(NodeId(leaf))) {
                EXPECT_TRUE(is_named_like_run_file(name)) << name;
                ++count[fs::path(name).parent_path()];
                all.insert(name);
            }
        }
        EXPECT_EQ(all.size(), 8 * static_cast<std::size_t>(parts));
        for (const auto& [folder, names] : count) {
            EXPECT_LE(names, 1000) << folder;
            EXPECT_TRUE(is_named_like_run_file(folder.string() + "/")) << folder;
        }
    }
    for (const char* foreign : {"parts/4000/notes.txt", "parts/mine/part_4123.vtu", "work/journal/4000/mine"})
        EXPECT_FALSE(is_named_like_run_file(foreign)) << foreign;
}

void write_mark(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

// A run whose report lists these files.
void write_run(const RunFolder& folder, int exit_code, const std::vector<std::string>& files) {
    nlohmann::ordered_json report = {{"files", nlohmann::json::array()}, {"exit_code", exit_code}};
    for (const std::string& file : files) {
        write_mark(folder.file(file), exit_code == 0 ? "new" : "failed");
        report["files"].push_back({{"path", file}});
    }
    write_mark(folder.file("report.json"), sealed(report.dump(2) + "\n"));
}

TEST(RunFolderOfThousands, WaitsForTheNextRunAndLeavesNothing) {
    const test::TemporaryFolder temporary;
    const std::string path = temporary.file("run");
    const std::vector<NodeId> leaves = {NodeId(8), NodeId(4123), NodeId(5000)};
    std::vector<std::string> parts;
    for (const NodeId leaf : leaves) parts.push_back("parts/" + stored_part_file_name(leaf));
    {
        RunFolder folder = RunFolder::create(path);
        folder.make_room(leaves);
        for (const NodeId leaf : leaves) write_mark(folder.journal_file(leaf), "finished");
        for (const NodeId leaf : leaves) write_mark(folder.begun_file(leaf), "");
        write_mark(folder.saved_run_file(), "options");
        write_run(folder, 4, parts);
        folder.commit(false);
    }
    EXPECT_EQ(test::bytes_of_file(path + "/work/journal/4000/4123"), "finished");
    EXPECT_FALSE(fs::exists(path + "/work/taken"));
    {
        RunFolder folder = RunFolder::create(path, [](const std::string&) { return true; });
        EXPECT_EQ(folder.finished_parts(), 3u);
        folder.keep_only({NodeId(4123)});
        EXPECT_EQ(folder.finished_parts(), 1u);
        EXPECT_EQ(test::bytes_of_file(folder.stored_part_file(NodeId(4123))), "failed");
        EXPECT_FALSE(fs::exists(folder.file("parts/5000")));
        write_run(folder, 0, {parts[1]});
        folder.commit(true);
    }
    EXPECT_FALSE(fs::exists(path + "/work"));
    EXPECT_EQ(test::bytes_of_file(path + "/parts/4000/part_4123.part"), "new");
    {
        RunFolder folder = RunFolder::create(path);
        write_run(folder, 0, {});
        folder.commit(true);
    }
    EXPECT_FALSE(fs::exists(path + "/parts/4000")) << "nothing of an older run stays";
    EXPECT_EQ(temporary.names(), std::vector<std::string>{"run"});
}

}  // namespace
}  // namespace kerf

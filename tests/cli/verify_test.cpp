// kerf verify on good runs, damaged files and folders that are no runs.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/io/folder_files.h"
#include "files/io/run_manifest.h"
#include "files/part/vtu_reader.h"
#include "files/part/vtu_writer.h"
#include "support/assets.h"
#include "support/file_contents.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class Verify : public testing::Test {
 protected:
    void SetUp() override {
        const ChildResult run = test::run_kerf(
            {"mesh", test::asset_path("hollow_box"), "-o", folder_.file("out"), "-n", "2", "-q", "--fields", "all"});
        ASSERT_EQ(run.exit_code, 0) << run.log;
        std::filesystem::copy(folder_.file("out"), folder_.file("good"), std::filesystem::copy_options::recursive);
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
    // Everything below a copy of the run may be changed.
    void restore() const {
        std::filesystem::remove_all(folder_.file("out"));
        std::filesystem::copy(folder_.file("good"), folder_.file("out"), std::filesystem::copy_options::recursive);
    }
    void expect_broken(const std::string& words) {
        const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
        EXPECT_EQ(result.exit_code, 8) << test::output_of(result);
        EXPECT_NE(test::output_of(result).find(words), std::string::npos) << test::output_of(result);
    }

    test::TemporaryFolder folder_;
};

TEST_F(Verify, PrintsJsonOrNothing) {
    const std::vector<std::string> json = {"verify", folder_.file("out"), "--json"};
    const std::vector<std::string> quiet = {"verify", folder_.file("out"), "-q"};
    auto found = nlohmann::json::parse(test::output_of(test::run_kerf(json)));
    EXPECT_EQ(found.at("path"), folder_.file("out"));
    EXPECT_TRUE(found.at("passed").get<bool>() && found.at("compared_with_input").get<bool>());
    EXPECT_EQ(found.at("parts"), 2);
    EXPECT_GT(found.at("tets"), 0);
    EXPECT_EQ(found.at("differences").size(), 0u);
    const ChildResult silent = test::run_kerf(quiet);
    EXPECT_EQ(silent.exit_code, 0);
    EXPECT_EQ(test::output_of(silent) + silent.log, "");

    overwrite<double>("Points", 0, 100);
    const ChildResult broken = test::run_kerf(json);
    EXPECT_EQ(broken.exit_code, 8);
    found = nlohmann::json::parse(test::output_of(broken));
    EXPECT_FALSE(found.at("passed").get<bool>());
    EXPECT_GT(found.at("differences").size(), 0u);
    EXPECT_NE(test::output_of(test::run_kerf(quiet)).find("NOT valid"), std::string::npos);

    restore();
    const std::string merged = folder_.file("mesh.msh");
    const ChildResult written = test::run_kerf({"merge", folder_.file("out"), "-o", merged, "--json"});
    const auto file = nlohmann::json::parse(test::output_of(written));
    EXPECT_EQ(file.at("output"), merged);
    EXPECT_EQ(file.at("bytes"), std::filesystem::file_size(merged));
    EXPECT_GT(file.at("tets"), 0);
    EXPECT_EQ(written.log, "");
    const ChildResult none = test::run_kerf({"merge", folder_.file("out"), "-o", merged, "-q"});
    EXPECT_EQ(none.exit_code, 0);
    EXPECT_EQ(test::output_of(none) + none.log, "");
}

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

TEST_F(Verify, TruncatedPartIsFound) {
    std::filesystem::resize_file(part(), std::filesystem::file_size(part()) / 2);
    const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
    EXPECT_EQ(result.exit_code, 8);
    EXPECT_NE(test::output_of(result).find("part_0002.vtu"), std::string::npos) << test::output_of(result);
}

void flip_bit(const std::string& path, std::uintmax_t byte) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(byte));
    const char flipped = static_cast<char>(file.peek() ^ 1);
    file.seekp(static_cast<std::streamoff>(byte));
    file.put(flipped);
}

// Any bit of any file.
TEST_F(Verify, AnyFlippedBitIsFound) {
    for (const std::string& name : list_files(folder_.file("good"))) {
        const std::uintmax_t size = std::filesystem::file_size(folder_.file("good/" + name));
        for (int i = 0; i < 9; ++i) {
            const std::uintmax_t byte = i == 8 ? size - 1 : size * static_cast<std::uintmax_t>(i) / 8;
            SCOPED_TRACE(name + " byte " + std::to_string(byte));
            restore();
            flip_bit(folder_.file("out/" + name), byte);
            const ChildResult result = test::run_kerf({"verify", folder_.file("out")});
            EXPECT_EQ(result.exit_code, 8) << test::output_of(result) << result.log;
            EXPECT_NE((test::output_of(result) + result.log).find(name), std::string::npos)
                << test::output_of(result) << result.log;
        }
    }
}

TEST_F(Verify, FilesThatAreMissingAddedOrExchangedAreFound) {
    namespace fs = std::filesystem;
    for (const std::string name : {"mesh.pvtu", "parts/part_0003.surface.vtu"}) {
        restore();
        fs::remove(folder_.file("out/" + name));
        expect_broken(name + " is missing");
    }
    restore();
    fs::copy_file(part(), folder_.file("out/parts/part_0009.vtu"));
    expect_broken("parts/part_0009.vtu is no file of the run");
    restore();
    fs::rename(part(), folder_.file("part"));
    fs::rename(folder_.file("out/parts/part_0003.vtu"), part());
    fs::rename(folder_.file("part"), folder_.file("out/parts/part_0003.vtu"));
    expect_broken("says that it is part 3");
}

// Whatever a run keeps, in whichever order and formats: a file that is cut short or missing is named, and beside it
// another one, which comes after it.
TEST_F(Verify, AllFilesThatDifferAreNamed) {
    namespace fs = std::filesystem;
    const std::string last = "parts/part_0003.surface.vtu";
    for (const auto& [order, formats] : {std::pair{"1", "vtu"}, {"1", "su2"}, {"2", "vtu"}, {"2", "msh"}}) {
        const std::string run = folder_.file(std::string("of_") + order + formats), out = folder_.file("damaged");
        ASSERT_EQ(test::run_kerf({"mesh", test::asset_path("cube"), "-o", run, "-n", "2", "--size", "0.5", "--order",
                                  order, "--format", formats, "-q"})
                      .exit_code,
                  0);
        const auto expect_named = [&](const std::string& name, const auto& damage) {
            fs::remove_all(out);
            fs::copy(run, out, fs::copy_options::recursive);
            fs::resize_file(out + "/" + last, 100);
            damage(out + "/" + name);
            const ChildResult result = test::run_kerf({"verify", out});
            EXPECT_EQ(result.exit_code, 8) << name << test::output_of(result) << result.log;
            for (const std::string& differs : {name, last})
                EXPECT_NE(test::output_of(result).find("  " + differs + " is "), std::string::npos)
                    << name << test::output_of(result) << result.log;
        };
        for (const std::string& name : list_files(run)) {
            if (name == "report.json" || name == last || name.ends_with('/')) continue;
            SCOPED_TRACE(run);
            expect_named(name, [](const std::string& path) { fs::resize_file(path, fs::file_size(path) / 2); });
            expect_named(name, [](const std::string& path) { fs::remove(path); });
        }
    }
}

// Hashes and all: then it is said why a part cannot be read, or its nodes.
TEST_F(Verify, DamageThatHashesDoNotTellIsNamed) {
    const std::string run = folder_.file("of_order_2");
    ASSERT_EQ(test::run_kerf(
                  {"mesh", test::asset_path("cube"), "-o", run, "-n", "2", "--order", "2", "--format", "msh", "-q"})
                  .exit_code,
              0);
    for (const std::string name : {"parts/curved_nodes.bin", "parts/part_0002.part"}) {
        const std::string out = folder_.file("damaged"), report = out + "/report.json";
        std::filesystem::remove_all(out);
        std::filesystem::copy(run, out, std::filesystem::copy_options::recursive);
        flip_bit(out + "/" + name, std::filesystem::file_size(out + "/" + name) - 1);
        auto json = nlohmann::ordered_json::parse(test::bytes_of_file(report));
        json.erase("report_hash");
        for (auto& file : json["files"]) file["hash"] = describe_file(out, file["path"]).hash;
        std::ofstream(report) << sealed(json.dump(2) + "\n");
        const ChildResult result = test::run_kerf({"verify", out});
        EXPECT_EQ(result.exit_code, 8) << test::output_of(result) << result.log;
        EXPECT_NE(test::output_of(result).find(name + " is damaged"), std::string::npos) << test::output_of(result);
        EXPECT_NE(test::output_of(result).find("laws of the whole were not checked"), std::string::npos)
            << test::output_of(result);
    }
}

// Somebody changes a file and all hashes with it: what follows from the mesh is found all the same.
TEST_F(Verify, WhatFollowsFromTheMeshIsComputedAgain) {
    const auto hash_again = [&] {
        const std::string path = folder_.file("out/report.json");
        const std::string text = test::bytes_of_file(path);
        auto report = nlohmann::ordered_json::parse(text);
        report.erase("report_hash");
        for (auto& file : report["files"]) {
            const RunFile now = describe_file(folder_.file("out"), file["path"]);
            file["hash"] = now.hash;
            file["bytes"] = now.bytes;
        }
        std::ofstream(path) << sealed(report.dump(2) + "\n");
    };
    hash_again();
    ASSERT_EQ(test::run_kerf({"verify", folder_.file("out")}).exit_code, 0);
    const auto expect_found = [&](const std::string& words) {
        hash_again();
        expect_broken(words);
        restore();
    };
    for (const std::string array :
         {"MinDihedralAngle", "MaxDihedralAngle", "RadiusEdgeRatio", "AspectRatio", "Shape"}) {
        overwrite<float>(array, 7, 0.5f);
        expect_found("do not follow from its mesh");
    }
    const std::int64_t last = read_cell_counts(part()).tets + read_cell_counts(part()).facets - 1;
    for (const std::int8_t patch : {5, -1, 127}) {
        overwrite<std::int8_t>("Patch", last - 300, patch);
        expect_found("without a patch");
    }
    std::string text = test::bytes_of_file(folder_.file("out/parts/part_0002.surface.vtu"));
    text.replace(text.find("GlobalVertexId"), 14, "GlobalVertexIe");
    std::ofstream(folder_.file("out/parts/part_0002.surface.vtu"), std::ios::binary) << text;
    expect_found("is not the surface of its part");
    std::ofstream(folder_.file("out/mesh.pvtu")) << "junk";
    expect_found("mesh.pvtu does not name the parts");
    auto report = nlohmann::ordered_json::parse(test::bytes_of_file(folder_.file("out/report.json")));
    report["totals"]["tets"] = 1;
    std::ofstream(folder_.file("out/report.json")) << report.dump(2) << "\n";
    expect_found("other totals");
    report = nlohmann::ordered_json::parse(test::bytes_of_file(folder_.file("out/report.json")));
    report["mesh_hash"] = std::string(32, '0');
    std::ofstream(folder_.file("out/report.json")) << report.dump(2) << "\n";
    expect_found("another mesh_hash");
}

// A mesh whose input is gone, or another, may be valid, but nobody has seen that: a code of its own says so.
TEST_F(Verify, WithoutItsInputItEndsWithACode) {
    const std::string input = folder_.file("input.stl"), moved = folder_.file("moved.stl");
    std::filesystem::copy_file(test::asset_path("cube"), input);
    ASSERT_EQ(test::run_kerf({"mesh", input, "-o", folder_.file("of_copy"), "-n", "2", "-q"}).exit_code, 0);
    const auto expect = [&](std::vector<std::string> arguments, int code, const std::string& words) {
        arguments.insert(arguments.begin(), {"verify", folder_.file("of_copy")});
        const ChildResult result = test::run_kerf(arguments);
        EXPECT_EQ(result.exit_code, code) << test::output_of(result);
        EXPECT_NE(test::output_of(result).find(words), std::string::npos) << test::output_of(result);
    };
    expect({}, 0, "Every law holds.");
    std::filesystem::copy_file(input, moved);
    flip_bit(input, 10);
    expect({}, 7, "its bytes are others");
    expect({"--without-input"}, 0, "was not compared with the input");
    std::filesystem::remove(input);
    expect({}, 7, "--input FILE");
    expect({"--input", moved}, 0, "Every law holds.");
    expect({"--input", test::asset_path("hollow_box")}, 7, "its bytes are others");
}

// Somebody changes a name in every file of the parts, and all hashes with it.
TEST_F(Verify, NamesOfPatchesAreComparedWithTheInput) {
    const std::string input = folder_.file("two.obj"), out = folder_.file("of_obj");
    std::ofstream(input) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng floor\nf 1 3 2\ng walls\nf 1 2 4\nf 2 3 4\n"
                            "f 3 1 4\n";
    ASSERT_EQ(test::run_kerf({"mesh", input, "-o", out, "-n", "1", "-q"}).exit_code, 0);
    std::string text = test::bytes_of_file(input);
    text.replace(text.find("walls"), 5, "sides");
    std::ofstream(input) << text;
    auto report = nlohmann::ordered_json::parse(test::bytes_of_file(out + "/report.json"));
    report.erase("report_hash");
    report["input"]["hash"] = describe_file("", input).hash;
    std::ofstream(out + "/report.json") << sealed(report.dump(2) + "\n");
    const ChildResult result = test::run_kerf({"verify", out});
    EXPECT_EQ(result.exit_code, 8) << test::output_of(result);
    EXPECT_NE(test::output_of(result).find("other names of patches than the input"), std::string::npos)
        << test::output_of(result);
}

TEST_F(Verify, FolderThatIsNoRunIsRefused) {
    const ChildResult result = test::run_kerf({"verify", folder_.file("none")});
    EXPECT_EQ(result.exit_code, 7);
    EXPECT_NE(result.log.find("report.json"), std::string::npos) << result.log;
}

}  // namespace
}  // namespace kerf

// Meshes that must not change unnoticed. mesh_hashes.txt has a line "asset parts hash" for each.
//
// A change of the method changes them on purpose: KERF_UPDATE_GOLDENS=1 rewrites the file, and the difference is
// reviewed with the change. Nothing else writes it.
#include <cstdlib>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/places.h"
#include "support/run_in_process.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

const std::string golden_file = test::source_folder() + "/tests/golden/mesh_hashes.txt";

using Hashes = std::map<std::string, std::string>;  // of "asset parts"

const std::vector<std::pair<std::string, std::int32_t>> cases = {
    {"bearing_cap_14k", 1}, {"bearing_cap_14k", 8}, {"cube", 1},        {"cube", 8},
    {"hollow_box", 1},      {"hollow_box", 8},      {"knee_tibial", 1}, {"knee_tibial", 8}};

std::string key(const std::string& asset, std::int32_t parts) { return asset + " " + std::to_string(parts); }

Hashes read_goldens() {
    Hashes hashes;
    std::ifstream file(golden_file);
    std::string asset, parts, hash;
    while (file >> asset >> parts >> hash) hashes[asset + " " + parts] = hash;
    return hashes;
}

Hashes compute() {
    Hashes hashes;
    const test::TemporaryFolder folder;
    for (const auto& [asset, parts] : cases)
        hashes[key(asset, parts)] = test::run_parts(test::asset_path(asset), folder.file("out"), parts).mesh.hash;
    return hashes;
}

void write_goldens(const Hashes& hashes) {
    std::ofstream file(golden_file);
    for (const auto& [mesh, hash] : hashes) file << mesh << ' ' << hash << '\n';
}

// Empty if both have the same meshes with the same hashes, else what differs and the lines to take over.
std::string difference(const Hashes& golden, const Hashes& computed) {
    std::string text;
    for (const auto& [mesh, hash] : computed) {
        const auto it = golden.find(mesh);
        if (it == golden.end())
            text += "no golden hash; candidate: " + mesh + " " + hash + "\n";
        else if (it->second != hash)
            text += "golden " + it->second + "; candidate: " + mesh + " " + hash + "\n";
    }
    for (const auto& [mesh, hash] : golden)
        if (!computed.contains(mesh)) text += "golden hash of a mesh that is not made: " + mesh + "\n";
    return text;
}

TEST(GoldenMeshes, HaveNotChanged) {
    const Hashes computed = compute();
    if (std::getenv("KERF_UPDATE_GOLDENS")) {
        write_goldens(computed);
        FAIL() << golden_file << " was rewritten; review the difference and run again.";
    }
    EXPECT_EQ(difference(read_goldens(), computed), "");
}

TEST(GoldenMeshes, ComparisonCanFail) {
    const Hashes golden = {{"cube 1", "0123"}, {"cube 8", "4567"}};
    EXPECT_EQ(difference(golden, golden), "");
    EXPECT_EQ(difference(golden, {{"cube 1", "0123"}, {"cube 8", "4568"}}), "golden 4567; candidate: cube 8 4568\n");
    EXPECT_EQ(difference({}, {{"cube 1", "0123"}}), "no golden hash; candidate: cube 1 0123\n");
    EXPECT_EQ(difference(golden, {{"cube 1", "0123"}}), "golden hash of a mesh that is not made: cube 8\n");
}

TEST(GoldenMeshes, AnotherMeshHasAnotherHash) {
    const test::TemporaryFolder folder;
    EXPECT_NE(test::run_parts(test::asset_path("cube"), folder.file("out"), 2).mesh.hash,
              test::run_parts(test::asset_path("cube"), folder.file("out"), 3).mesh.hash);
}

}  // namespace
}  // namespace kerf

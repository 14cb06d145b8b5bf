// Real CAD files, where a folder with them is at hand (see corpus/corpus_test.cpp): each is closed and right in its
// volume, or known by what is wrong with it.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "files/cad/cad_import.h"
#include "files/io/file_bytes.h"
#include "run/prepare/input.h"
#include "support/places.h"

namespace kerf {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> corpus() {
    const char* named = std::getenv("KERF_CORPUS");
    const fs::path folder = (named ? fs::path(named) : fs::path(test::source_folder()) / "../shared/data") / "cad";
    std::vector<std::string> paths;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (cad_format(read_file(entry.path())) != CadFormat::none) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

// What is known of a file: whether its solids touch, the bound of its volume where faces do not meet exactly in the
// file itself, and some words of the refusal of what cannot be imported as it is.
struct Known {
    bool touches = false;
    double volume_tolerance = CadOptions::volume_tolerance;
    std::string refusal = {};
};

std::optional<Known> known(const std::string& path) {
    static const std::map<std::string, Known> files = {
        {"CrankArm.brep", {.volume_tolerance = 2e-4}},
        {"asm_microgen_octettruss.step", {.touches = true}},
        {"asm_openmc_oblate_ellipsoids.step", {.touches = true}},
        {"asm_trimesh_box_sides.STEP", {.refusal = "'box_sides/box_base' and 'box_sides/side_long' overlap near"}},
        {"conical.step", {}},
        {"cube-in.step", {}},
        {"dm1-oc-214.stp", {.touches = true}},
        {"frame.step", {}},
        {"gmsh_mesh_T106_V3.step", {.refusal = "solid 'body' is not closed"}},
        {"m6screw.step", {}},
        {"model1.igs", {}},
        {"red_cube_blue_cylinder.step", {}}};
    const auto found = files.find(fs::path(path).filename());
    return found == files.end() ? std::nullopt : std::optional(found->second);
}

// The words of the refusal; none if there is none.
std::string refusal_of(const std::string& bytes, const std::string& path) {
    try {
        import_cad(bytes, path, {});
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

class CadCorpus : public testing::TestWithParam<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CadCorpus);
INSTANTIATE_TEST_SUITE_P(Files, CadCorpus, testing::ValuesIn(corpus()), [](const auto& test) {
    std::string name = fs::path(test.param).filename();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
});

TEST_P(CadCorpus, IsClosedNamedAndOfTheRightVolume) {
    const std::string bytes = read_file(GetParam());
    const std::optional<Known> in_table = known(GetParam());
    if (!in_table) {  // the folder grows without this repository: imported, or refused in words
        std::cout << "no table has " << GetParam() << '\n' << refusal_of(bytes, GetParam()) << '\n';
        return;
    }
    const Known& expected = *in_table;
    if (!expected.refusal.empty()) {
        EXPECT_NE(refusal_of(bytes, GetParam()).find(expected.refusal), std::string::npos);
        return;
    }
    if (expected.touches) {
        EXPECT_THROW(import_cad(bytes, GetParam(), {.no_imprint = true}), Error);
    }
    for (const bool unite : {false, true}) {
        if (unite && !expected.touches) continue;
        const CadBody body = import_cad(bytes, GetParam(), {.unite = unite});
        EXPECT_EQ(!body.soup.sides.empty(), expected.touches && !unite);
        EXPECT_NEAR(body.volume / body.exact_volume, 1, expected.volume_tolerance) << body.soup.notes.front();
        const std::set<std::string> names(body.soup.patch_names.begin(), body.soup.patch_names.end());
        EXPECT_EQ(names.size(), body.soup.patch_names.size());
        const CheckedSoup checked = check_soup(body.soup);
        EXPECT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
    }
}

}  // namespace
}  // namespace kerf

// Real CAD files, where a folder with them is at hand (see corpus/corpus_test.cpp): each is closed and right in its
// volume, or known by what is wrong with it.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "cad/cad_import.h"
#include "core/error.h"
#include "io/file_bytes.h"
#include "prepare/input.h"
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

// Files whose solids touch, and bounds of the volume where faces do not meet exactly in the file itself.
struct Known {
    bool touches = false;
    double volume_tolerance = CadOptions::volume_tolerance;
};

Known known(const std::string& path) {
    const std::string name = fs::path(path).filename();
    if (name == "dm1-oc-214.stp") return {.touches = true};
    if (name == "CrankArm.brep") return {.volume_tolerance = 2e-4};
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
    const Known expected = known(GetParam());
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

// Problems with a button for each remedy, the tree sorted and folded, the worst interfaces, refused tries: as a user
// works with them.
#include <algorithm>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "io/surface_reader.h"
#include "support/assets.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/model/advice.h"
#include "viewer/words_on_screen.h"

namespace kerf::test {
namespace {

using namespace view;

bool is_offered(Driver& driver, const std::string& label) {
    const std::optional<ItemRect> item = driver.app().widgets().find(label);
    return item && item->enabled;
}

// --- problems ---

TEST(Problems, EveryOptionThatARemedyNamesIsAdvised) {
    const std::regex option("--([a-z-]+[a-z])");
    std::set<std::string> all;
    for (std::size_t kind = 0; kind < defect_kind_count; ++kind)
        for (const Severity severity : {Severity::error, Severity::repaired, Severity::warning}) {
            const std::string text =
                remedy({.kind = static_cast<DefectKind>(kind), .severity = severity, .facets = {}, .vertices = {}});
            std::set<std::string> named, advised;
            for (std::sregex_iterator i(text.begin(), text.end(), option), end; i != end; ++i) named.insert((*i)[1]);
            for (const OptionText& advice : advised_options(text)) {
                advised.insert(advice.name);
                EXPECT_TRUE(advice.text.empty() || options_with({}, advice)) << words_of(advice);
            }
            EXPECT_EQ(advised, named) << text;
            all.merge(named);
        }
    EXPECT_EQ(all, (std::set<std::string>{"fill-holes", "keep-largest", "surface", "voids", "weld"}));
}

class ProblemButtons : public testing::Test {
 protected:
    void open(const Soup& soup) {
        write_off(folder_.file("bad.off"), soup.vertices, soup.facets);
        Driver::Options options;
        options.parts = 2;
        options.volume = false;
        driver_ = std::make_unique<Driver>(options);
        driver_->open(folder_.file("bad.off"));
        ASSERT_TRUE(driver_->document().has_problems());
    }
    void run_by(const std::string& button) {
        driver_->click(button);
        driver_->await("the run", [&] { return driver_->document().trace && !driver_->app().session().busy(); });
        driver_->settle();
        EXPECT_FALSE(driver_->document().has_problems()) << "it was checked again";
        EXPECT_TRUE(driver_->app().widgets().find("node 1")) << "the tree is in their place";
        EXPECT_EQ(driver_->document().progress.message, "");
    }

    const TemporaryFolder folder_;
    std::unique_ptr<Driver> driver_;
};

TEST_F(ProblemButtons, FillAHole) {
    Soup soup = read_surface(asset_path("cube"));
    soup.facets.erase(soup.facets.begin() + 100);
    open(soup);
    EXPECT_TRUE(is_offered(*driver_, "Run with --keep-largest"));
    EXPECT_TRUE(is_offered(*driver_, "Run with --weld 1e-05")) << "the cube is 1 long";
    run_by("Run with --fill-holes 3");
    EXPECT_EQ(driver_->document().input_facets, 4660);
}

// Every facet has corners of its own, a little off.
TEST_F(ProblemButtons, WeldACrackWithinATypedDistance) {
    const Soup whole = test::icosphere(4);
    Soup soup = whole;
    soup.vertices.clear();
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (std::int32_t& v : soup.facets[f]) {
            soup.vertices.push_back(whole.vertices[static_cast<std::size_t>(v)] *
                                    (1 + 1e-4 * static_cast<double>(f % 3)));
            v = static_cast<std::int32_t>(soup.vertices.size()) - 1;
        }
    open(soup);
    driver_->click("--weld");
    driver_->key(key_of('A'), true);
    driver_->type("nonsense");
    driver_->settle();
    EXPECT_FALSE(is_offered(*driver_, "Run with --weld nonsense"));
    driver_->key(key_of('A'), true);
    driver_->type("0.001");
    driver_->settle();
    run_by("Run with --weld 0.001");
    EXPECT_EQ(driver_->document().input_vertices, std::ssize(whole.vertices));
}

TEST_F(ProblemButtons, MakeAVoidOrLeaveItOut) {
    open(test::join(read_surface(asset_path("cube")), test::icosphere(1, 0.2, Vec3::Constant(0.5))));
    EXPECT_TRUE(is_offered(*driver_, "Run with --keep-largest"));
    run_by("Run with --voids parity");
    EXPECT_EQ(driver_->document().input_facets, 4660 + 80);
    EXPECT_LT(driver_->document().volume, 0.98);
}

}  // namespace
}  // namespace kerf::test

// What is wrong with a file or a surface, and a button for each remedy, as a user works with them.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "files/io/cad_body.h"
#include "files/io/program_finder.h"
#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "viewer/app/keys.h"
#include "viewer/driver.h"
#include "viewer/model/advice.h"

namespace kerf::test {
namespace {

using namespace view;

TEST(Problems, EveryOptionThatARemedyNamesIsAdvised) {
    const std::regex option("--([a-z-]+[a-z])");
    std::set<std::string> all;
    for (std::size_t kind = 0; kind < defect_kind_count; ++kind)
        for (const Severity severity : {Severity::error, Severity::repaired, Severity::warning}) {
            const std::string text =
                advice({.kind = static_cast<DefectKind>(kind), .severity = severity, .facets = {}, .vertices = {}});
            std::set<std::string> named, advised;
            for (std::sregex_iterator i(text.begin(), text.end(), option), end; i != end; ++i) named.insert((*i)[1]);
            for (const OptionText& advice : advised_options(text)) {
                advised.insert(advice.name);
                EXPECT_TRUE(advice.text.empty() || options_with({}, advice)) << words_of(advice);
            }
            EXPECT_EQ(advised, named) << text;
            all.merge(named);
        }
    EXPECT_EQ(all, (std::set<std::string>{"fill-holes", "fill-voids", "keep-largest", "region", "repair", "surface",
                                          "voids", "weld"}));
}

TEST(Problems, BodiesThatNearlyTouchAreWeldedByALittleMoreThanTheirDistance) {
    CheckedSoup checked{box(), {}, {}, 0};
    checked.diagnosis.defects.push_back(
        {DefectKind::body_gap, Severity::error, {0, 1}, {}, Vec3::Zero(), 1e-4, {"bone", "cement"}});
    EXPECT_EQ(usual_value("weld", {}, &checked), "0.00012");
    EXPECT_NE(place(checked.diagnosis.defects[0], checked.soup).find("'bone' and 'cement', up to 0.0001 apart"),
              std::string::npos);
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
    EXPECT_TRUE(driver_->offers("Run with --keep-largest"));
    EXPECT_TRUE(driver_->offers("Run with --weld 1e-05")) << "the cube is 1 long";
    run_by("Run with --fill-holes 3");
    EXPECT_EQ(driver_->document().input_facets, 4660);
}

// The selection takes room below the list, but not all of it.
TEST_F(ProblemButtons, LeaveRoomForTheList) {
    Soup soup = read_surface(asset_path("cube"));
    for (std::size_t i = 1; i <= 20; ++i) soup.facets.erase(soup.facets.begin() + static_cast<std::ptrdiff_t>(200 * i));
    open(soup);
    driver_->click("defect 3");
    driver_->settle();
    ASSERT_EQ(driver_->state().selection.kind, Selection::Kind::defect);
    int seen = 0;
    for (int i = 1; i <= 20; ++i) {
        const auto entry = driver_->app().widgets().find(fmt::format("defect {}", i));
        seen += entry && entry->visible;
    }
    EXPECT_GE(seen, 5);
    EXPECT_TRUE(driver_->app().widgets().find("defect 3")->visible);
}

// Every facet has corners of its own, a little off.
TEST_F(ProblemButtons, WeldACrackWithinATypedDistance) {
    const Soup whole = test::icosphere(3);
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
    EXPECT_FALSE(driver_->offers("Run with --weld nonsense"));
    driver_->key(key_of('A'), true);
    driver_->type("0.001");
    driver_->settle();
    run_by("Run with --weld 0.001");
    EXPECT_EQ(driver_->document().input_vertices, std::ssize(whole.vertices));

    // Who reloads, or asks for it from the beginning, is not told of it again.
    driver_->key(key_of('R'), true);
    driver_->await("the run", [&] { return driver_->document().trace && !driver_->app().session().busy(); });
    EXPECT_FALSE(driver_->document().has_problems());
    RunRequest welded;
    welded.input_options.repairs.weld_tolerance = 0.001;
    for (const RunRequest& options : {RunRequest(), welded}) {
        driver_->app().session().open(folder_.file("bad.off"), options);
        driver_->await("its check", [&] { return driver_->document().checked != nullptr; });
        EXPECT_EQ(driver_->document().has_problems(), options.input_options.repairs.weld_tolerance == 0);
    }
}

TEST_F(ProblemButtons, MakeAVoidOrLeaveItOut) {
    open(test::join(read_surface(asset_path("cube")), test::icosphere(1, 0.2, Vec3::Constant(0.5))));
    EXPECT_TRUE(driver_->offers("Run with --keep-largest"));
    run_by("Run with --voids parity");
    EXPECT_EQ(driver_->document().input_facets, 4660 + 80);
    EXPECT_LT(driver_->document().volume, 0.98);
}

// A shell script in the place of kerf-cad, which opens a file with --unite only.
class RefusingCad {
 public:
    explicit RefusingCad(const std::string& step) {
        std::ofstream(folder_.file("two.step")) << step;
        CadBody body;
        const Soup tetrahedron = test::tetrahedron();
        body.soup = tetrahedron;
        body.soup.patch.assign(body.soup.facets.size(), 0);
        body.soup.patch_names = {"one/face 1"};
        body.file_hash = digest_of(step);
        write("united", {0, "", body});
        write("refused", {3, "two.step: they touch. Join what touches by --unite, or choose one by --solid N.", {}});
        const std::string program = folder_.file("kerf-cad");
        std::ofstream(program) << "#!/bin/sh\ncase \"$*\" in *--unite*) a=united;; *) a=refused;; esac\ncat '"
                               << folder_.file("") << "'$a\n";
        std::filesystem::permissions(program, std::filesystem::perms::owner_all);
        setenv(programs_variable, folder_.file("").c_str(), 1);
    }
    ~RefusingCad() { unsetenv(programs_variable); }
    std::string file() const { return folder_.file("two.step"); }

 private:
    void write(const std::string& name, const CadAnswer& answer) const {
        const Bytes bytes = to_cad_bytes(answer);
        const std::string text(bytes.begin(), bytes.end());
        std::ofstream(folder_.file(name), std::ios::binary) << text;
    }
    const TemporaryFolder folder_;
};

TEST(ProblemsOfAFile, AreMendedByOpeningItAgain) {
    const RefusingCad cad("ISO-10303-21;\nHEADER;\nENDSEC;\nEND-ISO-10303-21;\n");
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    driver.open(cad.file());
    EXPECT_NE(driver.document().error.find("they touch"), std::string::npos) << driver.document().error;
    EXPECT_TRUE(driver.app().widgets().find("--solid")) << "its number is the user's";
    EXPECT_FALSE(driver.offers("Open with --solid"));
    driver.click("Open with --unite");
    driver.await("the surface", [&] { return driver.document().input_facets == 4; });
    EXPECT_EQ(driver.document().error, "");
    EXPECT_TRUE(driver.document().options.input_options.cad.unite) << "a run reads it so, too";
    const auto before = driver.document().soup;
    driver.key(key_of('R'), true);
    driver.await("the surface, by the same options",
                 [&] { return driver.document().soup && driver.document().soup != before; });
}

// Hundreds of warnings would hide the one error.
TEST(Problems, WarningsAreNotDrawnBesideErrors) {
    const TemporaryFolder folder;
    Soup bar = box({0, 0, 0}, {1000, 1, 1}, {1, 1, 1});
    Driver::Options options;
    options.auto_run = false;
    Driver driver(options);
    write_off(folder.file("bar.off"), bar.vertices, bar.facets);
    driver.open(folder.file("bar.off"));
    EXPECT_GT(driver.drawn(LayerKind::warning_places).points, 0) << "needles";
    bar.facets.pop_back();
    write_off(folder.file("open.off"), bar.vertices, bar.facets);
    driver.open(folder.file("open.off"));
    EXPECT_GT(driver.drawn(LayerKind::defect_places).points, 0);
    EXPECT_EQ(driver.drawn(LayerKind::warning_places).points, 0);
}

}  // namespace
}  // namespace kerf::test

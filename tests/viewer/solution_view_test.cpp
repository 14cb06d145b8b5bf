// How solutions are looked at: one scale for all, marks, numbers on lines, the value under the mouse, motion, arrows.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/file_contents.h"
#include "support/places.h"
#include "viewer/panels/text.h"
#include "viewer/render/line_labels.h"
#include "viewer/scene/inside/arrows.h"
#include "viewer/scene/selection.h"
#include "viewer/solved_cube.h"

namespace kerf::test {
namespace {

using namespace view;

class SolvedCubeLookedAt : public SolvedCube {
 protected:
    static const BuiltScene& scene() { return driver_->app().scene(); }
    // Where a point of a picture is, by the value there, which is x.
    static std::optional<double> value_at(float x, float y) {
        driver_->move_to(x, y);
        const auto& probe = driver_->app().facts().probe;
        if (!probe) return std::nullopt;
        const std::string line = probe->text.substr(0, probe->text.find('\n'));
        return std::strtod(line.substr(line.rfind(' ')).c_str(), nullptr);
    }
    static double x_of_probe() {
        const std::string& text = driver_->app().facts().probe->text;
        return std::strtod(text.substr(text.find('(') + 1).c_str(), nullptr);
    }
};

TEST_F(SolvedCubeLookedAt, AScaleThatIsGivenStays) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.coloring.range = ValueRange{0, 1.5};
    for (const int load_case : {0, 1, 2, 3, 0})
        for (const double deform : {0.0, 0.5}) {
            state.deformation.load_case = load_case;
            state.deformation.factor = deform;
            driver_->settle();
            EXPECT_EQ(scene().scene.scale.low, 0);
            EXPECT_EQ(scene().scene.scale.high, 1.5f);
        }
    driver_->open(folder_->file("out/solution"));
    driver_->settle();
    EXPECT_EQ(driver_->state().coloring.by, ColorBy::displacement) << "of the next step, too";
    EXPECT_EQ(driver_->state().coloring.range, (ValueRange{0, 1.5}));
    driver_->open(folder_->file("out/mesh"));
    driver_->settle();
    EXPECT_EQ(driver_->state().coloring.by, ColorBy::part);
    EXPECT_FALSE(driver_->state().coloring.range);
    driver_->open(folder_->file("out"));
}

// Values are x, wherever they are cut.
TEST_F(SolvedCubeLookedAt, TheLeastAndTheLargestValueAreMarkedWhereTheyAre) {
    ViewState& state = driver_->state();
    state.coloring.extremes = true;
    for (const ColorBy color : {ColorBy::displacement, ColorBy::von_mises, ColorBy::stress_xx})
        for (const auto& [clipped, explode] : {std::pair(false, 0.0), {true, 0.0}, {false, 0.5}}) {
            state.coloring.by = color;
            state.explosion.amount = explode;
            state.clip = {clipped, ClipStyle::smooth, Vec3::UnitX(), 0.375, false};
            driver_->settle();
            const std::vector<PlacedValue>& marked = scene().legend.marked;
            ASSERT_EQ(marked.size(), 2u);
            EXPECT_NEAR(marked[0].value, 0, 1e-6);
            EXPECT_NEAR(marked[1].value, clipped ? 0.375 : 1, 1e-5);
            EXPECT_EQ(marked[1].value, scene().legend.extremes->high);
            if (explode > 0) continue;  // parts have moved
            for (const PlacedValue& one : marked) EXPECT_NEAR(one.place.x(), one.value, 1e-5);
            EXPECT_EQ(driver_->drawn(LayerKind::extremes).points, 2);
        }
    state.explosion.amount = 0;
    state.clip.on = false;
    driver_->settle();
    const auto& labels = driver_->app().facts().labels;
    EXPECT_TRUE(std::any_of(labels.begin(), labels.end(), [](const ValueLabel& l) { return l.text == "largest 1"; }));
    state.coloring.by = ColorBy::shape;
    driver_->settle();
    EXPECT_EQ(scene().legend.marked.size(), 2u) << "of cells, too";
}

TEST_F(SolvedCubeLookedAt, NumbersOnLinesAreTheirValues) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::von_mises;
    state.coloring.isolines = true;
    state.coloring.range = ValueRange{0, 1};
    driver_->show_panels(true);
    driver_->settle();
    driver_->show_panels(false);
    driver_->settle();
    const std::vector<ValueLabel> labels = driver_->app().facts().labels;
    EXPECT_GE(labels.size(), 6u);
    driver_->show_panels(true);
    state.panels = {};
    for (bool* panel : {&state.panels.tree, &state.panels.display, &state.panels.timeline, &state.panels.problems})
        *panel = false;
    driver_->settle();
    ASSERT_FALSE(driver_->app().facts().labels.empty());
    for (const ValueLabel& label : std::vector<ValueLabel>(driver_->app().facts().labels)) {
        const auto value = value_at(label.x, label.y);
        ASSERT_TRUE(value);
        EXPECT_NEAR(*value, std::strtod(label.text.c_str(), nullptr), 0.01) << label.text;
    }
    state.look.numbers = false;
    driver_->settle();
    EXPECT_TRUE(driver_->app().facts().labels.empty());
    driver_->move_to(-1000, -1000);
    driver_->show_panels(false);
}

// Of lines that anybody may have drawn.
TEST(NumbersOnLines, DoNotOverlapAndStayInside) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(0, 600), step(-6, 6);
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<SeenSegment> segments;
        for (int line = 0; line < 12; ++line) {
            Eigen::Vector2f at(place(random), place(random)), along(step(random), step(random));
            for (int i = 0; i < 60; ++i) {
                const Eigen::Vector2f next = at + along + Eigen::Vector2f(step(random), step(random)) / 4;
                segments.push_back({static_cast<float>(line % 9), at, next});
                at = next;
            }
        }
        const Eigen::Vector2f size(30, 14);
        const LabelArea area{{20, 30}, {560, 540}};
        const std::vector<LabelArea> taken = {{{200, 200}, {330, 260}}};
        const auto labels = places_on_lines(
            segments, [&](float) { return size; }, area, 150, taken);
        EXPECT_GE(labels.size(), 3u);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            EXPECT_TRUE(((labels[i].place - size / 2 - area.low).array() >= 0).all());
            EXPECT_TRUE(((area.high - labels[i].place - size / 2).array() >= 0).all());
            EXPECT_TRUE(std::any_of(segments.begin(), segments.end(), [&](const SeenSegment& s) {
                return s.value == labels[i].value && (s.from + s.to) / 2 == labels[i].place;
            }));
            EXPECT_TRUE(((labels[i].place + size / 2).array() <= taken[0].low.array()).any() ||
                        ((labels[i].place - size / 2).array() >= taken[0].high.array()).any());
            for (std::size_t k = 0; k < i; ++k) {
                const Eigen::Vector2f distance = (labels[i].place - labels[k].place).cwiseAbs();
                EXPECT_TRUE(distance.x() >= size.x() || distance.y() >= size.y());
            }
        }
    }
}

// Without a click, of what is drawn already.
TEST_F(SolvedCubeLookedAt, TheMouseTellsTheValueUnderIt) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.deformation.factor = 0.5;
    driver_->show_panels(true);
    for (bool* panel : {&state.panels.tree, &state.panels.display, &state.panels.timeline, &state.panels.problems})
        *panel = false;
    for (const bool clipped : {false, true}) {
        state.clip = {clipped, ClipStyle::smooth, Vec3::UnitY(), 0.5, true};
        driver_->settle();
        const std::int64_t made = driver_->app().geometry_made();
        int told = 0;
        for (float x = 40; x < 440; x += 45)
            for (float y = 60; y < 330; y += 45)
                if (const auto value = value_at(x, y)) {
                    EXPECT_NEAR(*value, x_of_probe(), 0.006) << "the place is that of the body at rest";
                    EXPECT_GE(*value, -1e-6);
                    EXPECT_LE(*value, 1.0001);
                    ++told;
                }
        EXPECT_GT(told, 5);
        EXPECT_EQ(driver_->app().geometry_made(), made) << "nothing is built for it";
    }
    EXPECT_EQ(state.selection.kind, Selection::Kind::none);
    driver_->move_to(-1000, -1000);
    EXPECT_FALSE(driver_->app().facts().probe);
    driver_->show_panels(false);
}

TEST(Motion, GoesThereAndBack) {
    for (int i = 0; i <= 64; ++i) {
        const double phase = i / 64.0;
        EXPECT_EQ(share_of_motion(Motion::still, phase), 1);
        for (const Motion motion : {Motion::swing, Motion::rise}) {
            const double share = share_of_motion(motion, phase);
            EXPECT_EQ(share, share_of_motion(motion, 1 - phase)) << "bit for bit";
            EXPECT_LE(share, 1);
            EXPECT_GE(share, motion == Motion::swing ? -1 : 0);
        }
    }
    EXPECT_EQ(share_of_motion(Motion::swing, 0.5), -1);
    EXPECT_EQ(share_of_motion(Motion::rise, 0.5), 0);
    EXPECT_EQ(motion_from_name(name(Motion::rise)), Motion::rise);
}

TEST_F(SolvedCubeLookedAt, ItsDeformationMoves) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.deformation.factor = 0.5;
    state.deformation.motion = Motion::swing;
    std::optional<Eigen::AlignedBox3d> box;
    for (const double phase : {0.0, 0.125, 0.25, 0.5, 0.875}) {
        state.deformation.phase = phase;
        driver_->settle();
        double farthest = 0;
        for_corners([&](const Vec3& p, float) { farthest = std::max(farthest, p.x()); });
        EXPECT_NEAR(farthest, 1 + 0.5 * share_of_motion(Motion::swing, phase), 1e-5);
        EXPECT_EQ(scene().legend.values->high, 1);
        if (!box) box = scene().box;
        EXPECT_TRUE(scene().box.isApprox(*box, 1e-12)) << "all pictures are of one size";
    }
    driver_->show_panels(true);
    driver_->settle();
    driver_->click("Play");
    EXPECT_TRUE(driver_->app().facts().moving);
    EXPECT_FALSE(driver_->app().settled());
    state.deformation.speed = 1;
    for (int i = 0; i < 70; ++i) driver_->frame();
    const std::int64_t made = driver_->app().geometry_made();
    const double before = state.deformation.phase;
    double change = 0;
    for (int i = 0; i < 70; ++i) {
        driver_->frame();
        change = std::max(change, std::abs(state.deformation.phase - before));
    }
    EXPECT_GT(change, 0.4);
    EXPECT_EQ(driver_->app().geometry_made(), made) << "each phase is made once";
    driver_->click("Pause");
    EXPECT_FALSE(driver_->app().facts().moving);
    driver_->show_panels(false);
}

TEST_F(SolvedCubeLookedAt, ModesAreChosenLikeCases) {
    const auto solution = find_solution(folder_->file("out"));
    EXPECT_EQ(solution->cases[3].title(), "Mode 2, 30 Hz");
    EXPECT_EQ(solution->cases[1].title(), "fast");
    EXPECT_NEAR(solution->cases[3].largest_displacement, 2, 1e-6) << "of the files";
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.deformation.load_case = 3;
    driver_->settle();
    for_corners([&](const Vec3& p, float value) { EXPECT_NEAR(value, 2 * p.x(), 1e-5); });
    state.coloring.by = ColorBy::von_mises;
    driver_->settle();
    EXPECT_FALSE(scene().legend.values) << "a mode has none";
    EXPECT_FALSE(driver_->app().session().pending());
    const auto surface = driver_->app().session().fetched().part_surface(NodeId(2));
    ASSERT_TRUE(surface);
    const Selection vertex = {Selection::Kind::vertex, NodeId(2), 0, surface->vertices[0]};
    const std::string text = describe_selection(driver_->app().session(), vertex, 3);
    EXPECT_NE(text.find(fmt::format("{:.6g} long", 2 * surface->vertices[0].x())), std::string::npos) << text;
    EXPECT_EQ(text.find("stress"), std::string::npos) << text;
}

TEST_F(SolvedCubeLookedAt, APeriodIsPictures) {
    const auto run = [&](std::vector<std::string> more) {
        more.insert(more.begin(),
                    {"screenshot", folder_->file("out"), "-o", folder_->file("mode.png"), "--resolution", "200x160"});
        return run_program(test::kerf_program(), more);  // its pictures have other names than its output
    };
    ASSERT_EQ(run({"--load-case", "Mode 2", "--frames", "4"}).exit_code, 0);
    EXPECT_FALSE(std::filesystem::exists(folder_->file("mode.png")));
    EXPECT_FALSE(std::filesystem::exists(folder_->file("mode_005.png")));
    const auto picture = [&](int i) { return bytes_of_file(folder_->file(fmt::format("mode_{:03}.png", i))); };
    EXPECT_EQ(picture(2), picture(4)) << "there and back";
    EXPECT_NE(picture(1), picture(2));
    EXPECT_NE(picture(1), picture(3));
    ASSERT_EQ(run({"--load-case", "Mode 2", "--deform", "auto", "--motion", "swing"}).exit_code, 0);
    EXPECT_EQ(bytes_of_file(folder_->file("mode.png")), picture(1));
    const ChildResult no_solution =
        run_kerf({"screenshot", folder_->file("out/mesh"), "-o", folder_->file("mode.png"), "--frames", "3"});
    EXPECT_EQ(no_solution.exit_code, 2);
    EXPECT_NE(no_solution.log.find("--frames need a solution"), std::string::npos) << no_solution.log;
}

TEST_F(SolvedCubeLookedAt, ArrowsAreAsLongAsDisplacements) {
    ViewState& state = driver_->state();
    state.coloring.by = ColorBy::displacement;
    state.deformation.vectors = true;
    for (const int load_case : {0, 2}) {
        state.deformation.load_case = load_case;
        driver_->settle();
        const Layer* layer = scene().scene.find(LayerKind::vectors);
        ASSERT_TRUE(layer);
        const std::vector<Segment>& lines = layer->geometry->segments;
        ASSERT_GT(lines.size(), 100u);
        ASSERT_EQ(lines.size() % 5, 0u);
        const auto place = [&](const std::array<float, 3>& p) { return scene().frame.to_file(Vec3(p[0], p[1], p[2])); };
        for (std::size_t i = 0; i < lines.size(); i += 5) {
            const Vec3 from = place(lines[i].from), along = place(lines[i].to) - from;
            const Vec3 expected = (load_case == 0 ? Vec3::UnitX() : Vec3::UnitY()) * from.x() * std::sqrt(3) / 14;
            EXPECT_NEAR((along - expected).norm(), 0, 1e-5);
        }
    }
}

// However many there are.
TEST(Arrows, AreSomeOfMany) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0, 1);
    std::vector<Arrow> arrows;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p(place(random), place(random), place(random));
        arrows.push_back({p, Vec3::UnitX(), p});
    }
    const std::vector<Arrow> some = spread(arrows, std::sqrt(3.0));
    EXPECT_LE(some.size(), 1000u);
    EXPECT_GE(some.size(), 400u);
    std::vector<Arrow> fewer(arrows.begin(), arrows.begin() + 5);
    EXPECT_EQ(spread(fewer, 1e-9).size(), 5u);
}

}  // namespace
}  // namespace kerf::test

// A session that repairs what it has opened: what it shows is what a command makes of the file, before and after.
#include <algorithm>
#include <chrono>

#include <gtest/gtest.h>

#include "files/io/file_bytes.h"
#include "run/prepare/repaired_file.h"
#include "support/places.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"
#include "surface/repair/repair_step.h"
#include "viewer/model/advice.h"
#include "viewer/model/repaired_places.h"
#include "viewer/model/session.h"
#include "viewer/model/surface_values.h"
#include "viewer/model/timeline.h"

namespace kerf::view {
namespace {

// Facets have corners of their own, apart by at most `gap`; one is there twice.
Soup cracked_sphere(double gap) {
    Soup soup = test::icosphere(2);
    const Soup whole = soup;
    soup.vertices.clear();
    for (std::size_t f = 0; f < soup.facets.size(); ++f)
        for (std::int32_t& v : soup.facets[f]) {
            soup.vertices.push_back(whole.vertices[static_cast<std::size_t>(v)] *
                                    (1 + gap * static_cast<double>(f % 3) / 2));
            v = static_cast<std::int32_t>(soup.vertices.size()) - 1;
        }
    soup.facets.push_back(soup.facets.front());
    soup.patch.push_back(0);
    return soup;
}

// A prism without its upper end.
Soup open_prism() {
    Soup soup = test::prism(24, 1, 4);
    std::vector<char> is_end;
    for (const Triangle& t : soup.facets)
        is_end.push_back(std::all_of(t.begin(), t.end(), [&](std::int32_t v) { return soup.vertices[v].z() == 4; }));
    drop_facets(soup, is_end);
    drop_unused_vertices(soup);
    return soup;
}

class RepairSession : public testing::Test {
 protected:
    void open(const Soup& soup) {
        test::write_off(path_, soup.vertices, soup.facets);
        session_.open(path_);
        settle();
        ASSERT_TRUE(session_.repairs().can_repair()) << session_.document().error;
    }
    void settle() {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (session_.busy() || session_.pending()) {
            ASSERT_LT(std::chrono::steady_clock::now(), end);
            session_.wait(0.05);
        }
        session_.poll();
    }
    static InputOptions by(const std::string& plan) {
        InputOptions options;
        options.repairs.plan = plan;
        return options;
    }
    void repair(const std::string& plan) {
        session_.repairs().repair(by(plan));
        EXPECT_TRUE(session_.repairs().is_repairing());
        EXPECT_TRUE(session_.document().progress.running);
        settle();
        EXPECT_FALSE(session_.document().progress.running);
    }
    std::shared_ptr<const NodeSurface> surface(NodeId node) {
        session_.fetched().surface(node);
        settle();
        return session_.fetched().surface(node);
    }
    float farthest(NodeId node) {
        const auto of = surface(node);
        session_.fetched().values_on(of, ColorBy::deviation);
        settle();
        const auto values = session_.fetched().values_on(of, ColorBy::deviation);
        if (!values || values->values.size() != of->facets.size()) return -1;
        return *std::max_element(values->values.begin(), values->values.end());
    }
    // Whatever way led to them.
    void expect_what_a_command_makes() {
        const Document& document = session_.document();
        const CheckedSoup made = check_input(path_, document.options.input_options);
        EXPECT_EQ(document.checked->soup.facets, made.soup.facets);
        EXPECT_EQ(document.checked->soup.vertices, made.soup.vertices);
        EXPECT_EQ(to_text(document.checked->ladder), to_text(made.ladder));
        EXPECT_EQ(document.unrepaired != nullptr, made.soup.facets != check_input(path_).soup.facets);
        EXPECT_EQ(surface(root_node)->facets, document.unrepaired ? made.soup.facets : read_.facets);
    }

    const test::TemporaryFolder folder_;
    const std::string path_ = folder_.file("dirty.off");
    const Soup read_ = cracked_sphere(1e-3);
    Session session_{test::kerf_program()};
};

TEST_F(RepairSession, EveryOptionThatMendsHasASurfaceBeforeIt) {
    open(test::join(open_prism(), test::box(Vec3::Constant(9), Vec3::Constant(10))));
    const auto mend = [&](const auto& set) {
        InputOptions options;
        set(options.repairs);
        session_.repairs().repair(options);
        settle();
        EXPECT_EQ(steps_of(session_.document(), root_node).front().stage, Stage::before_repair);
        EXPECT_TRUE(session_.repairs().can_undo());
    };
    mend([](RepairOptions& repairs) { repairs.weld_tolerance = 0.5; });
    mend([](RepairOptions& repairs) { repairs.fill_hole_edges = 24; });
    mend([](RepairOptions& repairs) { repairs.keep_largest = true; });
    mend([](RepairOptions& repairs) { repairs.plan = "holes"; });
    mend([](RepairOptions& repairs) { repairs.cap = true; });
    mend([](RepairOptions& repairs) { repairs.thicken = 0.01; });
}

TEST_F(RepairSession, ShowsWhatACommandMakesOfTheFileAndWhatItWas) {
    open(read_);
    const auto before = surface(root_node);
    ASSERT_TRUE(session_.document().has_problems());
    EXPECT_FALSE(session_.fetched().surface(not_repaired)) << "nothing is repaired yet";
    EXPECT_TRUE(why_without_values(session_.document(), ColorBy::deviation));
    for (const char* plan : {"weld=0.01", "weld=0.01,clean", "exact", "near", "full", "none"}) {
        SCOPED_TRACE(plan);
        repair(plan);
        EXPECT_EQ(session_.document().options.input_options.repairs.plan, plan);
        expect_what_a_command_makes();
        const Document& document = session_.document();
        const Step first = steps_of(document, root_node).front();
        EXPECT_EQ(first.stage, document.unrepaired ? Stage::before_repair : Stage::input);
        if (!document.unrepaired) continue;
        EXPECT_EQ(surface(not_repaired)->facets.size(), read_.facets.size());
        for (const NodeId node : {root_node, not_repaired}) {
            EXPECT_GE(farthest(node), 0) << node.value();
            EXPECT_LE(farthest(node), 0.02) << node.value();
        }
    }
    EXPECT_EQ(surface(root_node)->facets, before->facets) << "none";
}

TEST_F(RepairSession, GoesBackAndForth) {
    open(read_);
    EXPECT_FALSE(session_.repairs().can_undo());
    repair("weld=0.01");
    const auto welded = session_.document().checked;
    const auto welded_surface = surface(root_node);
    repair("weld=0.01,clean");
    const auto cleaned = session_.document().checked;
    EXPECT_FALSE(session_.repairs().can_redo());
    session_.repairs().undo();
    EXPECT_EQ(session_.document().checked, welded);
    EXPECT_EQ(session_.document().options.input_options.repairs.plan, "weld=0.01");
    EXPECT_EQ(surface(root_node), welded_surface) << "at once";
    session_.repairs().undo();
    EXPECT_FALSE(session_.repairs().can_undo());
    EXPECT_TRUE(session_.document().has_problems());
    EXPECT_FALSE(session_.document().unrepaired);
    EXPECT_EQ(surface(root_node)->facets.size(), read_.facets.size());
    session_.repairs().redo();
    session_.repairs().redo();
    EXPECT_EQ(session_.document().checked, cleaned);
    session_.repairs().redo();  // there is nothing more
    EXPECT_EQ(session_.document().checked, cleaned);
    session_.repairs().undo();
    repair("clean");
    EXPECT_FALSE(session_.repairs().can_redo()) << "what was undone is forgotten";
    session_.repairs().undo();
    EXPECT_EQ(session_.document().checked, welded);
}

TEST_F(RepairSession, EndsWhenItIsCancelledAndChangesNothing) {
    open(read_);
    const auto checked = session_.document().checked;
    for (const bool by_run : {false, true}) {
        session_.repairs().repair(by("full"));
        by_run ? session_.cancel_run() : session_.repairs().cancel();
        EXPECT_FALSE(session_.repairs().is_repairing());
        EXPECT_FALSE(session_.document().progress.running);
        ASSERT_FALSE(session_.failures().empty());
        EXPECT_EQ(session_.failures().back(), "The repair was cancelled.");
    }
    settle();
    EXPECT_EQ(session_.document().checked, checked);
    EXPECT_EQ(session_.document().options.input_options.repairs.plan, "");
    session_.repairs().repair(by("full"));
    session_.open(path_);  // something else is open before it ends
    settle();
    EXPECT_EQ(session_.document().options.input_options.repairs.plan, "");
    session_.repairs().repair(by("weld=1e9"));  // or it fails
    settle();
    EXPECT_FALSE(session_.document().progress.running);
}

// A file that is opened with repairs has what it was before, too.
TEST_F(RepairSession, IsThereFromTheBeginningOn) {
    test::write_off(path_, read_.vertices, read_.facets);
    RunRequest options;
    options.input_options.repairs.plan = "weld=0.01";
    session_.open(path_, options);
    settle();
    expect_what_a_command_makes();
    ASSERT_TRUE(session_.document().unrepaired);
    EXPECT_TRUE(session_.repairs().can_undo());
    session_.repairs().undo();
    EXPECT_FALSE(session_.document().unrepaired);
    EXPECT_EQ(session_.document().options.input_options.repairs.plan, "");
}

TEST_F(RepairSession, SavesWhatKerfRepairWrites) {
    open(read_);
    repair("weld=0.01");
    for (const char* ending : {".obj", ".stl", ".vtp"}) {
        const std::string own = folder_.file(std::string("own") + ending);
        repair_file(path_, session_.document().options.input_options, own);
        session_.repairs().save(folder_.file(std::string("saved") + ending));
        settle();
        EXPECT_EQ(session_.document().surface_saved_as, folder_.file(std::string("saved") + ending));
        EXPECT_EQ(read_file(own), read_file(session_.document().surface_saved_as));
    }
    session_.repairs().save(folder_.file("surface.step"));
    settle();
    ASSERT_FALSE(session_.failures().empty());
    EXPECT_NE(session_.failures().back().find(".vtp or .vtk"), std::string::npos);
}

// Its result is kept, and the surface can be repaired again.
TEST_F(RepairSession, GoesOnBehindARun) {
    open(read_);
    repair("near");
    ASSERT_FALSE(session_.document().has_problems());
    RunRequest options = session_.document().options;
    options.parts = 2;
    session_.start_run(options, false);
    settle();
    ASSERT_TRUE(session_.document().trace) << session_.document().progress.message;
    EXPECT_EQ(steps_of(session_.document(), root_node).front().stage, Stage::before_repair);
    EXPECT_EQ(surface(not_repaired)->facets.size(), read_.facets.size());
    session_.repairs().undo();
    EXPECT_FALSE(session_.document().trace);
    EXPECT_TRUE(session_.document().has_problems());
    EXPECT_EQ(surface(root_node)->facets.size(), read_.facets.size());
    ASSERT_TRUE(session_.other_document());
    EXPECT_TRUE(session_.other_document()->trace);
    session_.repairs().redo();
    expect_what_a_command_makes();
}

TEST_F(RepairSession, WrapsAndUnwraps) {
    open(read_);
    InputOptions options;
    options.wrap = true;
    options.wrapping.gap = Length::percent(10);
    session_.repairs().repair(options);
    settle();
    ASSERT_TRUE(session_.document().checked->wrapped);
    expect_what_a_command_makes();
    EXPECT_FALSE(session_.document().has_problems());
    ASSERT_TRUE(surface(not_repaired));
    EXPECT_GE(farthest(root_node), 0);
    EXPECT_LE(farthest(root_node), (1 + 1e-6) * session_.document().checked->wrapped->distance_to_input);
    session_.repairs().undo();
    EXPECT_FALSE(session_.document().options.input_options.wraps());
    EXPECT_FALSE(session_.document().unrepaired);
}

TEST(RepairWords, AddWhatIsMissing) {
    EXPECT_EQ(with_repairs("", "near"), "near");
    EXPECT_EQ(with_repairs("near", "near"), "near");
    EXPECT_EQ(with_repairs("full", "near"), "full");
    EXPECT_EQ(with_repairs("weld=0.1", "weld,stitch"), "weld=0.1,stitch");
    for (const RepairStepRow& a : rows_with_words())
        for (const RepairStepRow& b : rows_with_words()) {
            const std::string both = with_repairs(a.name, b.name);
            const RepairPlan plan = parse_repair_plan("repair", both);
            EXPECT_TRUE(plan.find(a.kind) && plan.find(b.kind)) << both;
            EXPECT_EQ(with_repairs(both, a.name), both);
            EXPECT_EQ(with_repairs(both, b.name), both);
        }
}

TEST(RepairedPlaces, AreFoundByTheNumbersOfTheFile) {
    Soup soup = test::icosphere(1);
    EXPECT_EQ(facets_of_file(soup, {3, 1, 1000, -1}), (std::vector<std::int32_t>{3, 1}));
    for (std::size_t f = 0; f < soup.facets.size(); ++f) soup.polygon.push_back(static_cast<std::int32_t>(f / 2) * 10);
    EXPECT_EQ(facets_of_file(soup, {20, 5}), (std::vector<std::int32_t>{4, 5}));
    const Vec3 corner = soup.vertices[static_cast<std::size_t>(soup.facets[4][0])];
    const double radius = radius_around(soup, {4}, corner, 2);
    EXPECT_GT(radius, 0.5);
    EXPECT_LE(radius, 1);
    EXPECT_EQ(radius_around(soup, {}, corner, 2), 0.04);
}

}  // namespace
}  // namespace kerf::view

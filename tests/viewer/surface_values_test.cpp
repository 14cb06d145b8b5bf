// Values on surfaces, features, and what messages advise.
#include "viewer/model/surface_values.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "run/prepare/slivers.h"
#include "support/places.h"
#include "support/shapes.h"
#include "support/surface_files.h"
#include "support/temporary_folder.h"
#include "viewer/model/advice.h"
#include "viewer/model/inside/node_surface.h"
#include "viewer/model/session.h"
#include "viewer/model/timeline.h"

namespace kerf::view {
namespace {

NodeSurface moved(NodeSurface surface, const Vec3& by) {
    for (Vec3& p : surface.vertices) p += by;
    return surface;
}

TEST(Distances, AreNoLongerThanTheMove) {
    constexpr unsigned seed = 5;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-0.05, 0.05);
    for (const Soup& soup : {test::icosphere(2), test::box(), test::torus(3, 1, 20, 9), test::prism(9, 1, 20)}) {
        const NodeSurface surface = node_surface_of(soup);
        for (const float distance : distances_of_facets(surface, surface)) EXPECT_LT(distance, 1e-12);
        const Vec3 by(number(random), number(random), number(random));
        float largest = 0;
        for (const float distance : distances_of_facets(moved(surface, by), surface)) {
            EXPECT_LE(distance, by.norm() * (1 + 1e-6));
            largest = std::max(largest, distance);
        }
        EXPECT_GT(largest, 0.5 * by.norm());
    }
}

TEST(Distances, AreThoseOfTheFacet) {
    const NodeSurface box = node_surface_of(test::box()), other = moved(box, {0, 0, 0.25});
    const std::vector<float> distances = distances_of_facets(other, box);
    for (std::size_t f = 0; f < distances.size(); ++f) {
        const Triangle& t = other.facets[f];
        const auto z = [&](std::size_t k) { return other.vertices[static_cast<std::size_t>(t[k])].z(); };
        const bool reaches_top = std::max({z(0), z(1), z(2)}) > 1;
        EXPECT_FLOAT_EQ(distances[f], reaches_top || std::max({z(0), z(1), z(2)}) < 0.5 ? 0.25f : 0.f);
    }
    NodeSurface with_interface = box;
    with_interface.interface_of[3] = root_node;
    EXPECT_TRUE(std::isnan(distances_of_facets(with_interface, box)[3]));
}

TEST(Features, AreSharpEdgesAndBordersOfPatches) {
    for (const int n : {1, 2, 5})
        EXPECT_EQ(feature_edges(node_surface_of(test::box({0, 0, 0}, {1, 2, 3}, n))).size(), 12u * n);
    EXPECT_TRUE(feature_edges(node_surface_of(test::icosphere(3))).empty());
    EXPECT_EQ(feature_edges(node_surface_of(test::prism(60, 1, 2))).size(), 120u) << "not between the sides";
    EXPECT_EQ(feature_edges(node_surface_of(test::prism(6, 1, 2))).size(), 18u);
    NodeSurface sphere = node_surface_of(test::icosphere(1));
    sphere.patch[7] = 1;
    EXPECT_EQ(feature_edges(sphere).size(), 3u);
    sphere.interface_of[7] = root_node;
    EXPECT_TRUE(feature_edges(sphere).empty()) << "of an interface";
}

TEST(Lengths, AreThoseOfTheField) {
    SizeSources sources;
    sources.growth = 0.3;
    sources.spheres = {{Vec3(1, 1, 1), 0.2, 0.05}};
    const NodeSurface box = node_surface_of(test::box({0, 0, 0}, {1, 1, 1}, 4));
    const SizeField field(0, sources);
    const std::vector<float> lengths = lengths_at_vertices(box, field);
    ASSERT_EQ(lengths.size(), box.vertices.size());
    for (std::size_t v = 0; v < lengths.size(); ++v)
        EXPECT_FLOAT_EQ(lengths[v], static_cast<float>(field.at(box.vertices[v])));
    for (const float length : lengths_at_vertices(box, SizeField())) EXPECT_TRUE(std::isnan(length));
}

// Of every option that needs no number, whatever its value.
TEST(Advice, IsTheOptionThatATextNames) {
    RunRequest options;
    for (const OptionField& field : option_fields(options)) {
        const std::string begin = "Try kerf mesh --not-ours x --" + field.name;
        if (const auto* choice = std::get_if<OptionField::Choice>(&field.value)) {
            for (const std::string& value : choice->names) {
                const auto advice = advised_option(begin + " " + value + ", or leave it.");
                ASSERT_TRUE(advice) << field.name << " " << value;
                EXPECT_EQ(advice->name + " " + advice->text, field.name + " " + value);
                RunRequest changed;
                set_options(changed, {*advice}, "it");
                EXPECT_TRUE(is_set(changed, *advice));
            }
            EXPECT_FALSE(advised_option(begin + " maybe"));
            EXPECT_FALSE(advised_option(begin));
        } else {
            EXPECT_EQ(advised_option(begin + ".").has_value(), std::holds_alternative<bool*>(field.value)) << begin;
        }
    }
    EXPECT_FALSE(advised_option("close it with --surface remesh or --voids parity")) << "two of them";
    EXPECT_FALSE(advised_option(""));
}

TEST(Advice, IsInWhatProblemsSay) {
    const Soup bad = test::prism(60, 1, 20);
    const auto of_slivers =
        advised_option(sliver_note(find_slivers(bad.vertices, bad.facets), "kerf mesh /a--b/c.stl --surface remesh"));
    ASSERT_TRUE(of_slivers);
    EXPECT_EQ(words_of(*of_slivers), "Remesh the surface");
    EXPECT_FALSE(is_set(RunRequest(), *of_slivers));
    const auto of_needle = advised_option(
        advice({.kind = DefectKind::needle, .severity = Severity::warning, .facets = {}, .vertices = {}}));
    ASSERT_TRUE(of_needle);
    EXPECT_EQ(words_of(*of_needle), "Remesh the surface");
}

class RemeshedRun : public testing::Test {
 protected:
    template <class Condition>
    bool reach(Condition condition) {
        for (int i = 0; i < 600 && !condition(); ++i) session_.wait(0.1);
        return condition();
    }
    bool settle() {
        return reach([&] { return !session_.busy() && !session_.pending(); });
    }
    template <class Ask>
    auto get(Ask ask) {
        auto result = ask();
        reach([&] { return (result = ask()) || (!session_.pending() && !session_.busy()); });
        return result;
    }
    void open(const std::string& path) {
        session_.open(path);
        ASSERT_TRUE(settle());
    }
    void run(bool volume) {
        RunRequest options = session_.document().options;
        options.parts = 2;
        options.workers.count = 2;
        options.remeshing = Remeshing::always;
        options.deviation = Length::percent(0.1);
        options.output = folder_.file("run");
        options.outputs.trace_file = folder_.file("run.trace");
        session_.start_run(options, volume);
        ASSERT_TRUE(settle());
        ASSERT_EQ(session_.document().progress.message, "");
    }
    // Both surfaces and their distances, as every way to open the run has to show them.
    void expect_both_surfaces() {
        ASSERT_TRUE(session_.document().remeshed);
        EXPECT_EQ(steps_of(session_.document(), root_node).front(), (Step{Stage::before_remeshing, -1}));
        EXPECT_EQ(steps_of(session_.document(), NodeId(2)).front(), (Step{Stage::input, -1}));
        const auto before = get([&] { return session_.fetched().surface(not_remeshed); });
        const auto after = get([&] { return session_.fetched().surface(root_node); });
        ASSERT_TRUE(before && after);
        EXPECT_EQ(before->facets.size(), soup_.facets.size());
        EXPECT_GT(after->facets.size(), 2 * soup_.facets.size());
        const double allowed = 1e-3 * Vec3(2, 2, 4).norm();
        for (const auto& surface : {before, after}) {
            const auto values = get([&] { return session_.fetched().values_on(surface, ColorBy::deviation); });
            ASSERT_TRUE(values);
            EXPECT_EQ(values->surface, surface);
            ASSERT_EQ(values->values.size(), surface->facets.size());
            EXPECT_LE(*std::max_element(values->values.begin(), values->values.end()), allowed);
            EXPECT_EQ(session_.fetched().values_on(surface, ColorBy::deviation), values) << "kept";
        }
        EXPECT_FALSE(session_.fetched().values_on(after, ColorBy::size)) << "none is asked for";
        EXPECT_STREQ(why_without_values(session_.document(), ColorBy::size),
                     "No size is asked for: --size and its like do that.");
        EXPECT_EQ(why_without_values(session_.document(), ColorBy::deviation), nullptr);
    }

    test::TemporaryFolder folder_;
    Soup soup_ = test::prism(24, 1, 4);
    Session session_{test::kerf_program()};
};

TEST_F(RemeshedRun, ShowsWhatWasThereBefore) {
    const std::string path = folder_.file("prism.stl");
    std::ofstream(path) << test::to_ascii_stl(soup_);
    open(path);
    ASSERT_EQ(session_.document().notes.size(), 1u);
    const auto advice = advised_option(session_.document().notes[0]);
    ASSERT_TRUE(advice);
    EXPECT_EQ(words_of(*advice), "Remesh the surface");
    EXPECT_FALSE(session_.document().remeshed);
    EXPECT_FALSE(session_.fetched().surface(not_remeshed));
    EXPECT_TRUE(why_without_values(session_.document(), ColorBy::deviation));
    run(true);
    EXPECT_TRUE(session_.document().notes.empty()) << "the advice was followed";
    expect_both_surfaces();
    const auto part = get([&] { return session_.fetched().part_surface(NodeId(2)); });
    const auto of_part = get([&] { return session_.fetched().values_on(part, ColorBy::deviation); });
    ASSERT_TRUE(of_part);
    for (std::size_t f = 0; f < part->facets.size(); ++f)
        EXPECT_EQ(std::isnan(of_part->values[f]), part->is_interface(static_cast<std::int32_t>(f)));
    open(folder_.file("run"));
    expect_both_surfaces();
    open(folder_.file("run.trace"));
    expect_both_surfaces();
    std::filesystem::remove(path);
    open(folder_.file("run.trace"));
    EXPECT_FALSE(session_.document().remeshed) << "there is nothing to compare with";
}

TEST_F(RemeshedRun, KnowsTheSizesThatWereAskedFor) {
    const std::string path = folder_.file("box.off");
    std::ofstream(path) << test::to_off(test::box({0, 0, 0}, {1, 1, 1}, 3));
    open(path);
    RunRequest options = session_.document().options;
    options.parts = 2;
    options.sizes.size = 0.5;
    options.sizes.inside = {"sphere:1,1,1,0.2=0.1"};
    session_.start_run(options, false);
    ASSERT_TRUE(settle());
    const auto surface = get([&] { return session_.fetched().surface(root_node); });
    const auto values = get([&] { return session_.fetched().values_on(surface, ColorBy::size); });
    ASSERT_TRUE(values);
    for (std::size_t v = 0; v < values->values.size(); ++v) {
        const double outside = std::max(0.0, (surface->vertices[v] - Vec3::Ones()).norm() - 0.2);
        EXPECT_NEAR(values->values[v], std::min(0.5, 0.1 + 0.3 * outside), 1e-6);
    }
}

}  // namespace
}  // namespace kerf::view

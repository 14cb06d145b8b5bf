// What the decomposition reaches on the assets: every cut is made, nearly all of them on the first try, with plane and
// well-shaped interfaces and parts of the same size. And it is valid wherever the body lies, however large it is, and
// in whatever order its file lists it.
#include <algorithm>
#include <map>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/bytes.h"
#include "support/assets.h"
#include "support/decomposition_laws.h"

namespace kerf {
namespace {

constexpr std::int32_t facets_for_a_part = 300;

DecomposeOptions in_parts(std::int32_t parts) {
    DecomposeOptions options;
    options.parts = parts;
    options.threads = 2;
    return options;
}

// One decomposition, without its surfaces.
struct Outcome {
    std::string asset;
    std::int32_t parts = 0;
    std::vector<TreeNode> cuts;         // those tried
    std::vector<std::size_t> vertices;  // of each leaf
    std::string broken_laws;
};

std::vector<Outcome> decompose_assets() {
    std::vector<Outcome> outcomes;
    for (const std::string& asset : test::asset_names()) {
        const Surface surface = test::asset_surface(asset);
        for (const std::int32_t parts : {2, 3, 5, 8, 16, 32, 64, 128}) {
            if (parts * facets_for_a_part > surface.facet_count()) continue;
            const Decomposition whole = test::decompose_whole(surface, in_parts(parts));
            Outcome outcome{asset, parts, {}, {}, test::broken_laws(whole, surface.arrays())};
            std::copy_if(whole.nodes.begin(), whole.nodes.end(), std::back_inserter(outcome.cuts),
                         [](const TreeNode& node) { return node.cut_tried; });
            for (const Leaf& leaf : whole.leaves) outcome.vertices.push_back(leaf.surface.vertices.size());
            outcomes.push_back(std::move(outcome));
        }
    }
    return outcomes;
}

class Assets : public testing::Test {
 protected:
    static const std::vector<Outcome>& outcomes() {
        static const std::vector<Outcome> all = decompose_assets();
        return all;
    }
    static std::vector<TreeNode> all_cuts() {
        std::vector<TreeNode> cuts;
        for (const Outcome& outcome : outcomes()) cuts.insert(cuts.end(), outcome.cuts.begin(), outcome.cuts.end());
        return cuts;
    }
};

TEST_F(Assets, ReachEveryNumberOfPartsWithoutAFailedCut) {
    for (const Outcome& outcome : outcomes()) {
        SCOPED_TRACE(outcome.asset + " in " + std::to_string(outcome.parts) + " parts");
        EXPECT_EQ(outcome.broken_laws, "");
        EXPECT_EQ(outcome.vertices.size(), static_cast<std::size_t>(outcome.parts));
        EXPECT_EQ(outcome.cuts.size(), static_cast<std::size_t>(outcome.parts - 1));
        for (const TreeNode& cut : outcome.cuts) EXPECT_TRUE(cut.cut_made) << "node " << cut.id.value();
    }
}

TEST_F(Assets, NearlyAllCutsNeedOneTryOrNoOtherPlane) {
    const std::vector<TreeNode> cuts = all_cuts();
    std::map<CutStrategy, double> share;
    for (const TreeNode& cut : cuts) share[cut.strategy] += 1 / static_cast<double>(cuts.size());
    EXPECT_GE(share[CutStrategy::first_try], 0.65);
    EXPECT_GE(share[CutStrategy::first_try] + share[CutStrategy::local_repair], 0.85);
    EXPECT_LT(share[CutStrategy::soft], 0.05);
    EXPECT_EQ(share[CutStrategy::straight], 0);
}

TEST_F(Assets, InterfacesAreHardlyLargerThanPlaneSections) {
    for (const std::int32_t parts : {8, 32}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        double sum = 0, count = 0;
        for (const Outcome& outcome : outcomes()) {
            if (outcome.parts != parts) continue;
            double interface = 0, section = 0;
            for (const TreeNode& cut : outcome.cuts) interface += cut.interface_area, section += cut.section_area;
            sum += interface / section;
            ++count;
        }
        EXPECT_GE(count, 3);
        EXPECT_LE(sum / count, 1.05);
    }
}

TEST_F(Assets, InterfacesAreWellShaped) {
    std::vector<double> dihedral, angle;
    for (const TreeNode& cut : all_cuts()) {
        dihedral.push_back(cut.quality.dihedral_deg);
        angle.push_back(cut.quality.angle_deg);
    }
    const auto middle = dihedral.begin() + static_cast<std::ptrdiff_t>(dihedral.size() / 2);
    std::nth_element(dihedral.begin(), middle, dihedral.end());
    EXPECT_GE(*middle, 25);
    EXPECT_GE(*std::min_element(angle.begin(), angle.end()), 20);
}

TEST_F(Assets, WorkBalanceGivesPartsOfTheSameSize) {
    const std::map<std::int32_t, double> bounds = {{8, 1.05}, {64, 1.10}};
    std::size_t checked = 0;
    for (const Outcome& outcome : outcomes()) {
        const auto bound = bounds.find(outcome.parts);
        if (outcome.asset != "bearing_cap_52k" || bound == bounds.end()) continue;
        SCOPED_TRACE(testing::Message() << outcome.parts << " parts");
        double sum = 0;
        for (const std::size_t vertices : outcome.vertices) sum += static_cast<double>(vertices);
        const auto most = static_cast<double>(*std::max_element(outcome.vertices.begin(), outcome.vertices.end()));
        EXPECT_LE(most * outcome.parts / sum, bound->second);
        ++checked;
    }
    EXPECT_EQ(checked, bounds.size());
}

// The laws themselves: each damage of a valid decomposition is noticed.
TEST(DecompositionLaws, NoticeEveryDamage) {
    const Surface surface = test::asset_surface("cube");
    const SurfaceArrays input = surface.arrays();
    const Decomposition whole = test::decompose_whole(surface, in_parts(4));
    ASSERT_EQ(test::broken_laws(whole, input), "");
    const auto broken = [&](auto damage) {
        Decomposition damaged = whole;
        damage(damaged, damaged.leaves[1].surface);
        return test::broken_laws(damaged, input) != "";
    };
    EXPECT_TRUE(broken([](Decomposition& d, auto&) { d.leaves.pop_back(); }));
    EXPECT_TRUE(broken([](Decomposition& d, auto&) { d.leaves[2] = d.leaves[1]; }));
    EXPECT_TRUE(broken([](Decomposition& d, auto&) { d.leaves[1].volume *= 1.001; }));
    EXPECT_TRUE(broken([](Decomposition& d, auto&) { ++d.nodes.front().interface_vertices; }));
    EXPECT_TRUE(broken([](Decomposition& d, auto&) { d.divided_facets.push_back({3, {}, root_node, {}}); }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { s.facets.pop_back(), s.facet_key.pop_back(); }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { s.vertices.back() += Vec3::Constant(1e-9); }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { s.vertex_key.back() += 1; }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { std::swap(s.facets.front(), s.facets.back()); }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { s.patch.front() += 1; }));
    EXPECT_TRUE(broken([](Decomposition&, SurfaceArrays& s) { s.facet_key.front() = make_key(NodeId(1), 0); }));
}

// The bearing cap, and what it may become without being another body.
class BearingCap : public testing::Test {
 protected:
    static const SurfaceArrays& cap() {
        static const SurfaceArrays arrays = test::asset_surface("bearing_cap_14k").arrays();
        return arrays;
    }
    static double size() {
        Eigen::AlignedBox3d box;
        for (const Vec3& p : cap().vertices) box.extend(p);
        return box.diagonal().norm();
    }
    template <class Map>
    static SurfaceArrays mapped(Map map) {
        SurfaceArrays arrays = cap();
        for (Vec3& p : arrays.vertices) p = map(p);
        return arrays;
    }
    static void expect_laws(const SurfaceArrays& arrays) {
        const Surface surface(arrays);
        for (const std::int32_t parts : {8, 32}) {
            SCOPED_TRACE(testing::Message() << parts << " parts");
            const Decomposition whole = test::decompose_whole(surface, in_parts(parts));
            EXPECT_EQ(whole.leaves.size(), static_cast<std::size_t>(parts));
            EXPECT_EQ(test::broken_laws(whole, arrays), "");
        }
    }
};

TEST_F(BearingCap, MayBeTurned) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        std::normal_distribution<double> normal;
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
        expect_laws(mapped([&](const Vec3& p) -> Vec3 { return turn * p; }));
    }
}

TEST_F(BearingCap, MayBeMirrored) {
    for (int axis = 0; axis < 3; ++axis) {
        SCOPED_TRACE(testing::Message() << "axis " << axis);
        SurfaceArrays arrays = cap();
        for (Vec3& p : arrays.vertices) p[axis] = -p[axis];
        for (Triangle& t : arrays.facets) std::swap(t[1], t[2]);
        expect_laws(arrays);
    }
}

TEST_F(BearingCap, MayLieFarAway) {
    for (const Vec3& direction : {Vec3(1, 0, 0), Vec3(-1, 1, 1)}) {
        SCOPED_TRACE(testing::Message() << "towards " << direction.transpose());
        const Vec3 offset = 1e6 * size() * direction;
        expect_laws(mapped([&](const Vec3& p) -> Vec3 { return p + offset; }));
    }
}

TEST_F(BearingCap, MayHaveAnySize) {
    for (const double scale : {1e-6, 1e6}) {
        SCOPED_TRACE(scale);
        expect_laws(mapped([&](const Vec3& p) -> Vec3 { return scale * p; }));
    }
}

TEST_F(BearingCap, MayBeListedInAnyOrder) {
    for (const unsigned seed : {1u, 2u}) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        SurfaceArrays arrays = cap();
        std::vector<std::int32_t> place(arrays.vertices.size());
        std::iota(place.begin(), place.end(), 0);
        std::shuffle(place.begin(), place.end(), random);
        for (std::size_t v = 0; v < place.size(); ++v) arrays.vertices[place[v]] = cap().vertices[v];
        for (Triangle& t : arrays.facets) {
            t = {place[t[0]], place[t[1]], place[t[2]]};
            std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random() % 3), t.end());
        }
        std::shuffle(arrays.facets.begin(), arrays.facets.end(), random);  // all facets have the same patch
        expect_laws(arrays);
    }
}

TEST_F(BearingCap, GivesTheSameLeavesAgain) {
    const auto leaves = [] {
        return to_bytes(test::decompose_whole(test::asset_surface("bearing_cap_14k"), in_parts(32)).leaves);
    };
    EXPECT_TRUE(leaves() == leaves());
}

}  // namespace
}  // namespace kerf

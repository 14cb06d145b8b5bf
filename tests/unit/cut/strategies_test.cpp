// Every strategy of the ladder, on a body that needs it, and one body whose cut steps down the ladder as remedies are
// taken away.
#include <gtest/gtest.h>

#include "support/assets.h"
#include "support/decomposition_laws.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr double out_of_reach_deg = 61;  // every triangle has a smaller angle

// The first cut; that the whole tree is valid is checked, too.
TreeNode first_cut(const Surface& surface, const DecomposeOptions& options) {
    const Decomposition whole = test::decompose_whole(surface, options);
    EXPECT_EQ(test::broken_laws(whole, surface.arrays()), "");
    return whole.nodes.front();
}
TreeNode first_cut(const Soup& soup, const DecomposeOptions& options) {
    return first_cut(test::to_surface(soup), options);
}

void expect_strategy(CutStrategy expected, const TreeNode& node) {
    EXPECT_EQ(node.strategy, expected) << name(node.strategy) << ", not " << name(expected);
    EXPECT_EQ(node.cut_made, expected != CutStrategy::whole);
    EXPECT_EQ(node.method, expected == CutStrategy::straight ? ContourMethod::straight : ContourMethod::min_cut);
}

TEST(Strategies, SphereNeedsOneTry) {
    const TreeNode node = first_cut(test::icosphere(3), test::in_parts(2));
    expect_strategy(CutStrategy::first_try, node);
    EXPECT_EQ(node.tries, 1);
}

TEST(Strategies, WingInABoxNeedsLocalRepair) {
    const TreeNode node = first_cut(test::asset_surface("wing_in_box"), test::in_parts(7));
    expect_strategy(CutStrategy::local_repair, node);
    EXPECT_GT(node.tries, 1);
}

TEST(Strategies, PorousFrameNeedsAnotherPlaneWhereNothingIsRepaired) {
    DecomposeOptions options = test::in_parts(5);
    options.cut.repairs = 0;
    const TreeNode node = first_cut(test::porous_frame(2, 2), options);
    expect_strategy(CutStrategy::plane_step, node);
    EXPECT_GT(node.tries, 1);
}

TEST(Strategies, BlockWithCavitiesNeedsAnotherAxisWherePlanesStay) {
    DecomposeOptions options = test::in_parts(7);
    options.cut.repairs = 0;
    options.cut.plane_steps = 0;
    const TreeNode node = first_cut(test::block_with_cavities({5, 3, 1}), options);
    expect_strategy(CutStrategy::other_axis, node);
    EXPECT_GT(node.tries, 1);
}

TEST(Strategies, ThinPlateIsLeftWithASoftCut) {
    const CutOptions thresholds;
    const TreeNode node = first_cut(test::box(Vec3::Zero(), Vec3(100, 100, 0.5), {40, 40, 1}), test::in_parts(2));
    expect_strategy(CutStrategy::soft, node);
    EXPECT_TRUE(node.quality.dihedral_deg < thresholds.good_dihedral_deg ||
                node.quality.angle_deg < thresholds.good_angle_deg || node.quality.gap_rel < thresholds.good_gap_rel);
}

TEST(Strategies, BoxOfTwelveFacetsNeedsAStraightCutOrStaysWhole) {
    DecomposeOptions options = test::in_parts(2);
    expect_strategy(CutStrategy::straight, first_cut(test::box(), options));
    options.facets = FacetPolicy::keep;
    const TreeNode kept = first_cut(test::box(), options);
    expect_strategy(CutStrategy::whole, kept);
    EXPECT_FALSE(kept.cut_tried);
}

TEST(Strategies, CoarseFrameIsTriedInVainAndThenCutStraightOrStaysWhole) {
    DecomposeOptions options = test::in_parts(2);
    const Soup frame = test::porous_frame(2, 1);
    const TreeNode straight = first_cut(frame, options);
    expect_strategy(CutStrategy::straight, straight);
    options.facets = FacetPolicy::keep;
    const TreeNode kept = first_cut(frame, options);
    expect_strategy(CutStrategy::whole, kept);
    EXPECT_TRUE(kept.cut_tried);
    EXPECT_GT(kept.tries, 1);
    EXPECT_GT(straight.tries, kept.tries);  // those in vain count
}

TEST(Strategies, RemediesTakenAwayLeadDownTheLadder) {
    const Surface block(test::to_arrays(test::block_with_cavities({5, 2, 1})));
    DecomposeOptions options = test::in_parts(7);
    expect_strategy(CutStrategy::local_repair, first_cut(block, options));
    options.cut.repairs = 0;
    expect_strategy(CutStrategy::plane_step, first_cut(block, options));
    options.cut.plane_steps = 0;
    expect_strategy(CutStrategy::other_axis, first_cut(block, options));
    options.cut.good_angle_deg = out_of_reach_deg;
    expect_strategy(CutStrategy::soft, first_cut(block, options));
    options.cut.contour = ContourMethod::straight;
    expect_strategy(CutStrategy::straight, first_cut(block, options));
    options.facets = FacetPolicy::keep;
    expect_strategy(CutStrategy::whole, first_cut(block, options));
}

}  // namespace
}  // namespace kerf

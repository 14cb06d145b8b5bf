#include "cut/decompose/inside/region_tree.h"

#include <numeric>

#include <gtest/gtest.h>

#include "base/core/bytes.h"
#include "cut/decompose/decomposition.h"
#include "support/voxel_regions.h"

namespace kerf {
namespace {

using Cube = std::array<std::int32_t, 3>;

// Bars of 1, 2, ... cubes.
test::VoxelBody bars(std::int32_t count) {
    return test::voxel_body({count, count, 1}, [](Cube cube) { return cube[1] <= cube[0] ? cube[0] : -1; });
}

void visit(const RegionTree& tree, const RegionTree::Node& node, std::vector<std::int32_t>& leaves) {
    EXPECT_EQ(tree.first_leaf(node), std::accumulate(leaves.begin(), leaves.end(), 0));
    if (node.regions == 1) {
        leaves.push_back(tree.leaves(node));
        return;
    }
    const auto [lower, upper] = tree.halves(node);
    EXPECT_EQ(lower.id, child_of(node.id, 0));
    EXPECT_EQ(tree.leaves(lower) + tree.leaves(upper), tree.leaves(node));
    visit(tree, lower, leaves);
    visit(tree, upper, leaves);
}

TEST(RegionTree, SharesLeavesOutByLoad) {
    const Complex complex = test::to_complex(bars(6));
    const DecomposeOptions options;
    const Array<RegionIndex, RegionMeasures> measures = measure_regions(complex, options);
    for (const RegionIndex r : measures.ids()) EXPECT_NEAR(measures[r].volume, 1.0 + r.value(), 1e-12);
    std::vector<std::int32_t> before;
    for (const std::int32_t parts : {6, 7, 12, 21, 60}) {
        const RegionTree tree(complex, measures, parts);
        std::vector<std::int32_t> leaves;
        visit(tree, tree.root(), leaves);
        EXPECT_EQ(leaves.size(), 6U);
        EXPECT_EQ(std::accumulate(leaves.begin(), leaves.end(), 0), parts);
        EXPECT_GE(*std::min_element(leaves.begin(), leaves.end()), 1);
        for (std::size_t r = 0; r < before.size(); ++r) EXPECT_GE(leaves[r], before[r]) << "more parts, fewer leaves";
        before = leaves;
    }
}

TEST(RegionTree, BranchesOfARankAreThoseOfTheWhole) {
    const Complex complex = test::to_complex(
        test::voxel_body({8, 8, 8}, test::refined([](Cube c) { return c[0] + 2 * c[1] + 4 * c[2]; }, 4)));
    DecomposeOptions options;
    options.parts = 19;
    const Decomposition whole = decompose(complex, options, {0, options.parts});
    ASSERT_EQ(whole.nodes.front().regions, 8);
    EXPECT_TRUE(whole.nodes.front().is_divided() && !whole.nodes.front().cut_made);
    for (const LeafRange range : {LeafRange{0, 1}, {3, 9}, {9, 19}}) {
        const Decomposition some = decompose(complex, options, range);
        std::size_t next = 0;
        for (const Leaf& leaf : whole.leaves) {
            if (!range.contains(leaf.first_leaf)) continue;
            ASSERT_LT(next, some.leaves.size());
            EXPECT_EQ(some.leaves[next].region, leaf.region);
            EXPECT_TRUE(to_bytes(some.leaves[next++]) == to_bytes(leaf));
        }
        EXPECT_EQ(next, some.leaves.size());
    }
    options.threads = 3;
    EXPECT_TRUE(to_bytes(decompose(complex, options, {0, 19}).leaves) == to_bytes(whole.leaves));
}

}  // namespace
}  // namespace kerf

// Whole trees of straight cuts obey every law, for any ranges of leaves, also where cuts along edges came before.
#include "cut/decompose/straight_division.h"

#include <limits>

#include <gtest/gtest.h>

#include "base/core/bytes.h"
#include "base/core/error.h"
#include "support/assets.h"
#include "support/decomposition_laws.h"
#include "support/shapes.h"

namespace kerf {
namespace {

struct Part {
    std::string name;
    Soup soup;
};
std::ostream& operator<<(std::ostream& out, const Part& part) { return out << part.name; }

std::vector<Part> parts() {
    using namespace test;
    return {{"box", box()},
            {"cylinder_with_few_sides", prism(7, 1, 5)},
            {"cylinder_with_slivers", prism(60, 1, 20)},
            {"plate_with_hole", plate_with_hole(24)},
            {"two_shells", join(box(), translated(prism(12, 0.5, 3), Vec3(3, 0, 0)))},
            {"hollow_box", nested_boxes(2)}};
}

class StraightDivision : public testing::TestWithParam<Part> {
 protected:
    StraightDivision() : surface_(test::to_arrays(GetParam().soup)) {}
    Surface surface_;
};
INSTANTIATE_TEST_SUITE_P(Parts, StraightDivision, testing::ValuesIn(parts()),
                         [](const auto& param) { return param.param.name; });

TEST(TreeNodes, AreNumberedAsFarAsThereAreNumbers) {
    NodeId node = root_node;
    for (int depth = 0; depth < 30; ++depth) {
        const auto [below, above] = children_of(node);
        EXPECT_EQ(parent_of(below), node);
        EXPECT_EQ(above, sibling_of(below));
        node = above;
    }
    EXPECT_EQ(node.value(), std::numeric_limits<std::int32_t>::max());
    for (const NodeId deepest : {node, NodeId(1 << 30)}) {
        try {
            children_of(deepest);
            FAIL() << "no error";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
        }
    }
}

TEST_P(StraightDivision, ReachesAnyNumberOfPartsAndObeysEveryLaw) {
    for (const std::int32_t parts : {2, 3, 8, 17}) {
        SCOPED_TRACE(testing::Message() << parts << " parts");
        const Decomposition whole = test::decompose_whole(surface_, test::in_parts(parts));
        EXPECT_EQ(whole.leaves.size(), static_cast<std::size_t>(parts));
        EXPECT_EQ(test::broken_laws(whole, surface_.arrays()), "");
        EXPECT_FALSE(whole.divided_facets.empty());
    }
}

// All but the clock.
Bytes bytes_of(std::vector<TreeNode> nodes) {
    for (TreeNode& node : nodes) node.seconds = 0;
    return to_bytes(nodes);
}

void expect_same_in_ranges(const Surface& surface, const DecomposeOptions& options) {
    const Decomposition by_edges = decompose(surface, options, {0, options.parts});
    const Decomposition whole = divide_straight(by_edges, options, {0, options.parts});
    for (const std::int32_t step : {1, 3}) {
        std::size_t next = 0;
        for (std::int32_t first = 0; first < options.parts; first += step) {
            SCOPED_TRACE(testing::Message() << "leaves from " << first << " in steps of " << step);
            const Decomposition some = divide_straight(by_edges, options, {first, first + step});
            EXPECT_TRUE(bytes_of(some.nodes) == bytes_of(whole.nodes));
            EXPECT_EQ(some.divided_facets.size(), whole.divided_facets.size());
            for (const Leaf& leaf : some.leaves) {
                ASSERT_LT(next, whole.leaves.size());
                EXPECT_TRUE(to_bytes(leaf) == to_bytes(whole.leaves[next++]));
            }
        }
        EXPECT_EQ(next, whole.leaves.size());
    }
}

TEST_P(StraightDivision, RangesOfLeavesAreThoseOfTheWhole) { expect_same_in_ranges(surface_, test::in_parts(8)); }

// So many parts that they become too small for contours of edges.
class MixedTree : public testing::Test {
 protected:
    const Surface surface_ = test::asset_surface("hollow_box");
    const DecomposeOptions options_ = test::in_parts(240);
};

TEST_F(MixedTree, ObeysEveryLaw) {
    const Decomposition whole = test::decompose_whole(surface_, options_);
    EXPECT_EQ(whole.leaves.size(), static_cast<std::size_t>(options_.parts));
    EXPECT_EQ(test::broken_laws(whole, surface_.arrays()), "");
    const auto count = [&](ContourMethod method) {
        return std::count_if(whole.nodes.begin(), whole.nodes.end(),
                             [&](const TreeNode& node) { return node.cut_made && node.method == method; });
    };
    EXPECT_GT(count(ContourMethod::min_cut), 20);
    EXPECT_GT(count(ContourMethod::straight), 5);
}

TEST_F(MixedTree, RangesOfLeavesAreThoseOfTheWhole) {
    const Decomposition by_edges = decompose(surface_, options_, {0, options_.parts});
    const Decomposition whole = divide_straight(by_edges, options_, {0, options_.parts});
    const Decomposition some = divide_straight(by_edges, options_, {100, 120});
    ASSERT_EQ(some.leaves.size(), 20u);
    for (std::size_t i = 0; i < some.leaves.size(); ++i)
        EXPECT_TRUE(to_bytes(some.leaves[i]) == to_bytes(whole.leaves[100 + i]));
}

}  // namespace
}  // namespace kerf

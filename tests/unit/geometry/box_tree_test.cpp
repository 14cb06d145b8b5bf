#include "base/geometry/box_tree.h"

#include <numeric>
#include <random>
#include <thread>

#include <gtest/gtest.h>

#include "base/core/threads.h"

namespace kerf {
namespace {

// Nested, disjoint, equal and flat boxes.
std::vector<Eigen::AlignedBox3d> some_boxes(std::mt19937& random, std::size_t count) {
    std::vector<Eigen::AlignedBox3d> boxes;
    const auto coordinate = [&](std::uint32_t most) { return static_cast<double>(random() % most); };
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector3d low(coordinate(20), coordinate(20), coordinate(20));
        boxes.emplace_back(low, low + Eigen::Vector3d(coordinate(9), coordinate(9), coordinate(9)));
    }
    return boxes;
}

TEST(BoxTree, FindsTheBoxesAroundEachBoxAndThoseThatMeetIt) {
    std::mt19937 random(1);
    for (const std::size_t count : {0, 1, 4, 5, 300}) {
        const std::vector<Eigen::AlignedBox3d> boxes = some_boxes(random, count);
        const BoxTree tree(boxes);
        for (const Eigen::AlignedBox3d& box : some_boxes(random, 100)) {
            std::vector<std::int32_t> expected;
            for (std::size_t i = 0; i < count; ++i)
                if (boxes[i].contains(box)) expected.push_back(static_cast<std::int32_t>(i));
            EXPECT_EQ(tree.around(box), expected);
            std::vector<std::int32_t> meeting, found;
            for (std::size_t i = 0; i < count; ++i)
                if (boxes[i].intersects(box)) meeting.push_back(static_cast<std::int32_t>(i));
            tree.for_each_meeting(box, [&](std::int32_t i) { found.push_back(i); });
            std::sort(found.begin(), found.end());
            EXPECT_EQ(found, meeting);
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::vector<std::int32_t> around = tree.around(boxes[i]);
            EXPECT_TRUE(std::binary_search(around.begin(), around.end(), static_cast<std::int32_t>(i)));
        }
    }
}

// By the distances of the boxes, all of them and in the tree, whichever of equal ones is looked at first.
TEST(BoxHierarchy, FindsTheLeastAndStopsWhereItIsTold) {
    std::mt19937 random(2);
    for (const std::size_t count : {0, 1, 5, 300}) {
        const std::vector<Box> boxes = some_boxes(random, count);
        std::vector<std::int32_t> order(count);
        std::iota(order.begin(), order.end(), 0);
        const BoxHierarchy<> hierarchy = make_hierarchy(boxes, order);
        for (const Box& from : some_boxes(random, 50)) {
            const Vec3 p = from.min() + Vec3::Constant(0.5);
            double expected = 7;
            for (const Box& box : boxes) expected = std::min(expected, box.exteriorDistance(p));
            const auto of_node = [&](const BoxNode& node) { return node.box.exteriorDistance(p); };
            const auto of_item = [&](std::int32_t item) { return boxes[order[item]].exteriorDistance(p); };
            EXPECT_EQ(hierarchy.least(7, of_node, of_item), expected);
            EXPECT_EQ(hierarchy.least<FirstOfEqual::right>(7, of_node, of_item), expected);
            const auto is_within = [&](const BoxNode& node) { return of_node(node) <= expected; };
            EXPECT_EQ(hierarchy.any(is_within, [&](std::int32_t item) { return of_item(item) == expected; }),
                      expected < 7 || (count > 0 && of_node(hierarchy.nodes()[0]) == 7));
            std::vector<std::int32_t> seen;
            const auto all = [](const BoxNode&) { return true; };
            EXPECT_FALSE(hierarchy.any(all, [&](std::int32_t item) { return seen.push_back(item), false; }));
            EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
            EXPECT_EQ(seen.size(), count);
        }
    }
}

TEST(BoxHierarchy, IsTheSameForAnyNumberOfThreads) {
    std::mt19937 random(3);
    const std::vector<Box> boxes = some_boxes(random, 50'000);
    std::vector<std::vector<std::int32_t>> orders;
    std::vector<std::vector<BoxNode>> nodes;
    for (const int threads : {1, 2, 7}) {
        set_thread_limit(threads);
        std::vector<std::int32_t>& order = orders.emplace_back(boxes.size());
        std::iota(order.begin(), order.end(), 0);
        nodes.push_back(make_hierarchy(boxes, order).nodes());
    }
    set_thread_limit(static_cast<int>(std::thread::hardware_concurrency()));
    const auto are_equal = [](const BoxNode& a, const BoxNode& b) {
        return a.box.min() == b.box.min() && a.box.max() == b.box.max() && a.first == b.first && a.last == b.last &&
               a.left == b.left;
    };
    for (std::size_t i = 1; i < orders.size(); ++i) {
        EXPECT_EQ(orders[i], orders[0]);
        EXPECT_TRUE(std::equal(nodes[i].begin(), nodes[i].end(), nodes[0].begin(), nodes[0].end(), are_equal));
    }
}

}  // namespace
}  // namespace kerf

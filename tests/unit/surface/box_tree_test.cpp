#include "surface/box_tree.h"

#include <random>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace kerf

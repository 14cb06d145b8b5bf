#include "base/geometry/overlap_tree.h"

#include <numeric>
#include <random>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

namespace kerf {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

enum class Kind { uniform, clustered, flat, points, equal_centres, huge, tiny, far };

std::vector<Box> boxes_of(Kind kind, std::size_t count, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3 centre(unit(random), unit(random), unit(random)), half(unit(random), unit(random), unit(random));
        half *= 0.8 / std::cbrt(static_cast<double>(count + 1));
        if (kind == Kind::clustered) centre = (i % 3 == 0 ? 1.0 : 1e-5) * centre, half *= i % 3 == 0 ? 1.0 : 1e-5;
        if (kind == Kind::flat) centre.z() = half.z() = 0;
        if (kind == Kind::points) half.setZero(), centre = (4 * centre).array().floor();
        if (kind == Kind::equal_centres) centre.setZero(), half *= i % 2 == 0 ? 1 : 100;
        const double scale = kind == Kind::huge ? 1e308 : kind == Kind::tiny ? 1e-310 : 1;
        const Vec3 shift = Vec3::Constant(kind == Kind::far ? 1e9 : kind == Kind::huge ? -0.5 : 0);
        boxes.emplace_back(scale * (centre + shift - half), scale * (centre + shift + half));
    }
    return boxes;
}

// Each found once, and none that meet are missing. Floats may add a few, but no more than rounding explains.
void expect_all_pairs(const std::vector<Box>& boxes, const OverlapTree& tree, bool is_exact) {
    Pairs expected, found;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (boxes[i].intersects(boxes[j]))
                expected.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(j));
    EXPECT_FALSE(tree.any_pair({0, tree.leaf_count()}, [&](std::int32_t i, std::int32_t j) {
        found.emplace_back(std::minmax(i, j));
        return false;
    }));
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
    if (is_exact) {
        EXPECT_LE(found.size(), expected.size() + 1 + expected.size() / 1000);
    }
}

TEST(OverlapTree, FindsAllPairsOfBoxesThatMeet) {
    std::mt19937 random(1);
    for (const Kind kind : {Kind::uniform, Kind::clustered, Kind::flat, Kind::points, Kind::equal_centres, Kind::huge,
                            Kind::tiny, Kind::far})
        for (const std::size_t count : {0, 1, 2, 3, 4, 5, 8, 9, 10, 16, 17, 65, 300, 1000}) {
            SCOPED_TRACE(testing::Message() << "kind " << static_cast<int>(kind) << ", " << count << " boxes");
            const std::vector<Box> boxes = boxes_of(kind, count, random);
            const OverlapTree tree(count, [&](std::size_t i) { return boxes[i]; });
            expect_all_pairs(boxes, tree, kind != Kind::clustered && kind != Kind::tiny && kind != Kind::far);
        }
}

TEST(OverlapTree, FindsWhatMeetsABoxAndStopsWhereItIsTold) {
    std::mt19937 random(2);
    for (const std::size_t count : {0, 1, 4, 5, 300}) {
        const std::vector<Box> boxes = boxes_of(Kind::uniform, count, random);
        const OverlapTree tree(count, [&](std::size_t i) { return boxes[i]; });
        for (Box box : boxes_of(Kind::uniform, 100, random)) {
            if (random() % 4 == 0) box.translate(Vec3(0.9, -1.2, 0));
            std::vector<std::int32_t> expected, found;
            for (std::size_t i = 0; i < count; ++i)
                if (boxes[i].intersects(box)) expected.push_back(static_cast<std::int32_t>(i));
            EXPECT_FALSE(tree.any_meeting(box, [&](std::int32_t i) { return found.push_back(i), false; }));
            std::sort(found.begin(), found.end());
            EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
            EXPECT_LE(found.size(), expected.size() + 1);
            std::size_t asked = 0;
            EXPECT_EQ(tree.any_meeting(box, [&](std::int32_t) { return ++asked == 2; }), found.size() >= 2);
            EXPECT_EQ(asked, std::min<std::size_t>(2, found.size()));
        }
        std::size_t asked = 0;
        const bool is_stopped = tree.any_pair({0, tree.leaf_count()}, [&](auto...) { return ++asked == 3; });
        EXPECT_EQ(is_stopped, asked == 3);
        EXPECT_TRUE(count > 2 ? count < 300 || is_stopped : !is_stopped);
    }
}

TEST(OverlapTree, IsTheSameForAnyNumberOfThreads) {
    std::mt19937 random(3);
    const std::vector<Box> boxes = boxes_of(Kind::clustered, 100'000, random);
    Pairs first;
    for (const int threads : {1, 2, 7}) {
        set_thread_limit(threads);
        const OverlapTree tree(boxes.size(), [&](std::size_t i) { return boxes[i]; });
        Pairs found;
        tree.any_pair({0, tree.leaf_count()}, [&](auto... pair) { return found.emplace_back(pair...), false; });
        EXPECT_GT(found.size(), 10'000u);
        if (threads == 1) first = found;
        EXPECT_EQ(found, first);
    }
    set_thread_limit(static_cast<int>(std::thread::hardware_concurrency()));
}

TEST(MortonOrder, SortsCodesWhateverTheyHaveInCommon) {
    std::mt19937_64 random(4);
    for (const std::size_t count : {0, 1, 2, 4095, 4096, 50'000, 140'000})
        for (const int bits : {0, 3, 20, 31, 63}) {  // that differ: the lowest, or the highest of as many
            std::vector<MortonItem> items(count);
            const int shift = random() % 2 == 0 ? 0 : 63 - bits;
            for (std::size_t i = 0; i < count; ++i)
                items[i] = {(random() & ((std::uint64_t{1} << bits) - 1)) << shift, static_cast<std::int32_t>(i)};
            std::vector<MortonItem> expected = items;
            const auto key = [](const MortonItem& item) { return std::pair(item.code, item.item); };
            std::sort(expected.begin(), expected.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
            sort_by_code(items);
            EXPECT_TRUE(std::equal(items.begin(), items.end(), expected.begin(),
                                   [&](const auto& a, const auto& b) { return key(a) == key(b); }))
                << count << " codes, " << bits << " bits, shift " << shift;
        }
}

// Points of a box of side 2^-20 share the upper bits of their codes; the curve goes through a box before it leaves it.
TEST(MortonOrder, KeepsWhatLiesInOneCellTogether) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 0.999F);
    std::vector<std::array<float, 3>> points(10'000);
    for (auto& point : points) point = {unit(random), unit(random), unit(random)};
    const std::vector<std::int32_t> order = morton_order(points.size(), [&](std::size_t i) { return points[i]; });
    std::vector<std::int32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<std::int32_t>(i));
    for (const int cells : {2, 4, 8}) {
        int changes = 0;
        const auto cell_of = [&](std::int32_t i) {
            std::array<int, 3> cell;
            for (int axis = 0; axis < 3; ++axis)
                cell[axis] = static_cast<int>(points[i][axis] * static_cast<float>(cells));
            return cell;
        };
        for (std::size_t i = 1; i < order.size(); ++i) changes += cell_of(order[i]) != cell_of(order[i - 1]);
        EXPECT_LE(changes, cells * cells * cells + 8) << "but for points at borders, one change a cell";
    }
}

}  // namespace
}  // namespace kerf

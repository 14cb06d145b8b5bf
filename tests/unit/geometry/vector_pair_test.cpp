#include "base/geometry/vector_pair.h"

#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

namespace kerf {
namespace {

Vec3 first_of(const VectorPair& p) { return {p.x[0], p.y[0], p.z[0]}; }
Vec3 second_of(const VectorPair& p) { return {p.x[1], p.y[1], p.z[1]}; }

TEST(VectorPairs, DoToTheLastBitWhatIsDoneWithEachVector) {
    std::mt19937 random(1);
    const auto number = [&] { return 0x1p-31 * random() - 1; };
    const auto vector = [&]() -> Vec3 {
        const double x = number(), y = number(), z = number();
        return {x, y, z};
    };
    for (int i = 0; i < 1000; ++i) {
        const Vec3 a = vector(), b = vector(), c = vector(), d = vector();
        const VectorPair ab(a, b), cd(c, d);
        EXPECT_EQ(first_of(ab + cd), a + c);
        EXPECT_EQ(second_of(ab - cd), b - d);
        EXPECT_EQ(first_of(ab.cross(cd)), a.cross(c));
        EXPECT_EQ(second_of(ab.cross(cd)), b.cross(d));
        EXPECT_EQ(ab.dot(cd)[0], a.dot(c));
        EXPECT_EQ(ab.squared_norm()[1], b.squaredNorm());
        EXPECT_EQ(first_of(ab.squared_norm() * cd), a.squaredNorm() * c);
        EXPECT_EQ(first_of(swapped(ab)), b);
        EXPECT_EQ(second_of(firsts(ab, cd)), c);
        EXPECT_EQ(first_of(seconds(ab, cd)), b);
    }
}

TEST(VectorPairs, ChooseAmongNumbers) {
    const Pair p = {1, -4}, q = {-2, 3};
    EXPECT_EQ(smallest(p, q)[0], -2);
    EXPECT_EQ(largest(p, q)[1], 3);
    EXPECT_EQ(smallest_of(p), -4);
    EXPECT_EQ(largest_of(q), 3);
    EXPECT_EQ(absolute(p)[1], 4);
    EXPECT_EQ(both(5)[1], 5);
}

}  // namespace
}  // namespace kerf

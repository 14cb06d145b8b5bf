#include "base/core/ids.h"

#include <string>
#include <type_traits>
#include <unordered_set>

#include <gtest/gtest.h>

namespace kerf {
namespace {

using Apple = Id<struct AppleTag>;
using Pear = Id<struct PearTag>;

static_assert(!std::is_convertible_v<int, Apple> && !std::is_convertible_v<Apple, int>);
static_assert(!std::is_constructible_v<Apple, Pear> && !std::is_constructible_v<Apple, double>);
static_assert(sizeof(Apple) == 4);

TEST(Ids, CountAndCompare) {
    EXPECT_EQ(Apple(), Apple(0));
    EXPECT_LT(Apple(1), Apple(2U));
    int next = 3;
    for (const Apple apple : IdRange(Apple(3), Apple(6))) EXPECT_EQ(apple.value(), next++);
    EXPECT_EQ(next, 6);
    for (const Apple apple : ids<Apple>(0)) FAIL() << apple.value();
    EXPECT_EQ((std::unordered_set<Apple>{Apple(1), Apple(1), Apple(2)}.size()), 2U);
}

TEST(Ids, AreThePlacesInAnArray) {
    Array<Apple, std::string> names = {"cox", "gala"};
    names.push_back("fuji");
    std::string all;
    for (const Apple apple : names.ids()) all += names[apple] + " ";
    EXPECT_EQ(all, "cox gala fuji ");
    names[Apple(1)] = "elstar";
    EXPECT_EQ(names[1], "elstar");
}

}  // namespace
}  // namespace kerf

#include "files/part/inside/name_table.h"

#include <gtest/gtest.h>

#include <set>

#include "support/seeded_numbers.h"

namespace kerf {
namespace {

std::vector<std::string> random_names(std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) names.push_back("name " + std::to_string(i));
    return names;
}

TEST(NameTable, OfAPartHasWhatItUsesOfMany) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        test::SeededNumbers random(seed);
        const std::vector<std::string> all = random_names(NameTable::most_in_every_part + 1 + random.integer(0, 2000));
        std::vector<std::int32_t> used;
        for (int i = random.integer(0, 50); i > 0; --i)
            used.push_back(random.integer(-1, static_cast<int>(all.size()) - 1));
        const std::set<std::int32_t> wanted(used.begin(), used.end());
        const NameTable table = NameTable::of_part(all, used);
        EXPECT_EQ(table.size(), wanted.size() - wanted.count(-1));
        EXPECT_TRUE(table.agrees_with(all));
        for (std::int32_t number = -2; number <= std::ssize(all); ++number)
            EXPECT_EQ(table.has(number), number >= 0 && wanted.contains(number));
        const std::vector<std::string> filled = table.filled();
        ASSERT_EQ(std::ssize(filled), table.end());
        for (std::int32_t number = 0; number < table.end(); ++number)
            EXPECT_EQ(filled[number], table.has(number) ? all[number] : "");
    }
}

TEST(NameTable, OfAPartHasAllOfFew) {
    const std::vector<std::string> all = random_names(NameTable::most_in_every_part);
    EXPECT_EQ(NameTable::of_part(all, {3}), NameTable(all));
    EXPECT_TRUE(NameTable::of_part(all, {}).is_whole());
}

TEST(NameTable, SaysWhatIsDamaged) {
    const std::vector<std::string> all = random_names(4);
    EXPECT_FALSE(NameTable({1, 7}, {"name 1", "name 7"}).agrees_with(all));
    EXPECT_FALSE(NameTable({0, 2}, {"name 0", "name 3"}).agrees_with(all));
    for (const std::vector<std::int32_t>& numbers : {std::vector{-1, 2}, {2, 2}, {3, 1}})
        EXPECT_FALSE(NameTable::can_be(numbers));
}

}  // namespace
}  // namespace kerf

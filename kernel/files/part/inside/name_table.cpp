#include "files/part/inside/name_table.h"

#include <utility>

#include "base/core/check.h"
#include "base/core/error.h"

namespace kerf {

NameTable::NameTable(std::vector<std::int32_t> numbers, std::vector<std::string> names)
    : numbers_(std::move(numbers)), names_(std::move(names)) {
    KERF_CHECK(numbers_.size() == names_.size() && can_be(numbers_));
    if (end() == std::ssize(names_)) numbers_.clear();
}

NameTable NameTable::of_part(std::span<const std::string> all, std::vector<std::int32_t> used) {
    if (all.size() <= most_in_every_part) return std::vector<std::string>(all.begin(), all.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    used.erase(used.begin(), std::lower_bound(used.begin(), used.end(), 0));
    std::vector<std::string> names;
    for (const std::int32_t number : used) names.push_back(all[number]);
    return {std::move(used), std::move(names)};
}

std::vector<std::string> NameTable::filled() const {
    std::vector<std::string> all(end());
    for (std::size_t place = 0; place < size(); ++place) all[number(place)] = names_[place];
    return all;
}

bool NameTable::has(std::int32_t number) const {
    if (is_whole()) return number >= 0 && number < end();
    return std::binary_search(numbers_.begin(), numbers_.end(), number);
}

bool NameTable::agrees_with(std::span<const std::string> all) const {
    for (std::size_t place = 0; place < size(); ++place)
        if (std::cmp_greater_equal(number(place), all.size()) || all[number(place)] != names_[place]) return false;
    return true;
}

bool NameTable::can_be(std::span<const std::int32_t> numbers) {
    return (numbers.empty() || numbers.front() >= 0) &&
           std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) == numbers.end();
}

}  // namespace kerf

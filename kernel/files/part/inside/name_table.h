// Tables of names of patches or regions by their numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace kerf {

/// Names by numbers from 0: of all numbers, or only of those that are needed somewhere, as in a part of a mesh of many
/// regions.
class NameTable {
 public:
    /// The most names that every part has in full: whoever opens one file knows them all. With more, a part has those
    /// that it uses: in all parts together the names would grow as the square of the regions.
    static constexpr std::size_t most_in_every_part = 256;

    NameTable() = default;
    /// Takes all names: the first is that of number 0.
    NameTable(std::vector<std::string> names) : names_(std::move(names)) {}
    NameTable(std::initializer_list<std::string> names) : names_(names) {}
    /// Takes numbers and names, one of each; numbers ascend, each once, none below 0.
    NameTable(std::vector<std::int32_t> numbers, std::vector<std::string> names);

    /// Returns the table of a part that uses these numbers, in any order and often, of the names of all, in their
    /// order; numbers below 0 are passed over. O(#used log #used).
    static NameTable of_part(std::span<const std::string> all, std::vector<std::int32_t> used);

    bool empty() const { return names_.empty(); }
    std::size_t size() const { return names_.size(); }
    bool is_whole() const { return numbers_.empty(); }
    /// Returns the numbers of the names, ascending; empty where all numbers from 0 have a name.
    const std::vector<std::int32_t>& numbers() const { return numbers_; }
    const std::vector<std::string>& names() const { return names_; }
    std::int32_t number(std::int32_t place) const { return is_whole() ? place : numbers_[place]; }
    /// Returns the first number behind all that have a name.
    std::int32_t end() const { return names_.empty() ? 0 : number(names_.size() - 1) + 1; }
    /// Returns a name for each number below end(), empty where there is none.
    std::vector<std::string> filled() const;
    /// Tells whether a number has a name. O(log #names).
    bool has(std::int32_t number) const;
    /// Tells whether each name is that of its number in `all`.
    bool agrees_with(std::span<const std::string> all) const;

    /// Tells whether numbers ascend from 0 or above, as a table needs them.
    static bool can_be(std::span<const std::int32_t> numbers);
    /// Tells whether numbers and names fit together; false only after damaged bytes were read.
    bool is_consistent() const { return is_whole() || (numbers_.size() == names_.size() && can_be(numbers_)); }

    bool operator==(const NameTable&) const = default;

    template <class Archive>
    void archive(Archive& a) {
        a(numbers_, names_);
    }

 private:
    std::vector<std::int32_t> numbers_;
    std::vector<std::string> names_;
};

}  // namespace kerf

// One option: its names, its help, and the place of its value.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "base/core/user_number.h"

namespace kerf {

/// The headings under which help and manual list the options, in this order.
namespace option_group {
inline constexpr const char* input = "Input";
inline constexpr const char* air = "Air around the body";
inline constexpr const char* cuts = "Cuts";
inline constexpr const char* sizes = "Sizes";
inline constexpr const char* meshing = "Meshing";
inline constexpr const char* output = "Output";
inline constexpr const char* running = "Running";
inline constexpr const char* expert = "Expert";
inline constexpr const char* all[] = {input, air, cuts, sizes, meshing, output, running, expert};
}  // namespace option_group

/// One option: its name on the command line and in the config file, and the place of its value.
struct OptionField {
    /// An enumeration, by the names of its values.
    struct Choice {
        std::vector<std::string> names;
        std::function<int()> get;
        std::function<void(int)> set;
    };
    /// Memory in megabytes of 2^20 bytes; its text may have a unit, as 2G.
    struct Memory {
        std::int64_t* megabytes;
        std::int64_t& operator*() const { return *megabytes; }
    };
    /// A number of things; its text may have a unit, as 50k or 1.5M.
    struct Count {
        std::int64_t* number;
        std::int64_t& operator*() const { return *number; }
    };
    std::string name;        ///< without dashes
    std::string short_name;  ///< a letter, or empty
    std::string group;       ///< one of option_group
    std::string value_name;  ///< stands for the value in the help, as FILE; empty for flags and choices
    std::string help;        ///< one sentence with unit and default
    /// The value of an option that may be given several times; as one text, with semicolons between (join_items()).
    using List = std::vector<std::string>*;
    using Value = std::variant<std::int32_t*, Memory, Count, double*, Length*, bool*, std::string*, List, Choice>;
    Value value;
    bool shapes_parts = true;  ///< false: part files of a finished run do not depend on it, except parts over a time
                               ///< limit, which the run marks (PartOutcome::timed_out)
    NumberRange range = {};    ///< range of a number or a length

    /// Returns the value as text, numbers with all their digits. set_text() takes it back, and throws Error(usage),
    /// naming the option and its range or form, for a text that is no such value.
    std::string text() const;
    void set_text(const std::string& text) const;
    /// Throws Error(usage) for a number that is out of range.
    void check() const;
    bool is_number() const;  ///< whether it is a number, a length, memory or a count
};

/// Joins items with semicolons between them; semicolons within an item, and backslashes, get a backslash before them.
/// Empty items vanish. split_items() is the inverse.
std::string join_items(const std::vector<std::string>& items);
std::vector<std::string> split_items(const std::string& text);

/// An option as text, see OptionField::text().
struct OptionText {
    std::string name, text;

    template <class Archive>
    void archive(Archive& a) {
        a(name, text);
    }
};

}  // namespace kerf

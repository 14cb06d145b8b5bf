// Numbers and lengths as users write them: on the command line, in files of options, within other texts.
#pragma once

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"

namespace kerf {

/// The range of a number, and its description.
struct NumberRange {
    const char* words = "a number";  ///< the description, to follow "it must be"
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    bool or_zero = false;  ///< whether 0 may be given, too, for none or for the default
    bool is_open = false;  ///< whether `least` and `most` themselves are excluded

    bool contains(double x) const {
        if (or_zero && x == 0) return true;
        return std::isfinite(x) && (is_open ? x > least && x < most : x >= least && x <= most);
    }
};

/// A length in units of the input, or in percent of the diagonal of its bounding box, which is known only after
/// reading.
class Length {
 public:
    Length() = default;
    Length(double length) : number_(length) {}  // NOLINT: a number is a length
    static Length percent(double percent) {
        Length length(percent);
        length.is_percent_ = true;
        return length;
    }

    bool is_percent() const { return is_percent_; }
    /// The number as written: percent if is_percent().
    double number() const { return number_; }
    double of(double diagonal) const { return is_percent_ ? number_ / 100 * diagonal : number_; }
    /// The length. Requires that it is no percentage.
    operator double() const {  // NOLINT: so that it is used as the number that it is
        KERF_CHECK(!is_percent_);
        return number_;
    }
    std::string text() const { return fmt::format("{}{}", number_, is_percent_ ? "%" : ""); }

 private:
    double number_ = 0;
    bool is_percent_ = false;
};

/// Returns the number of which the whole text consists; nothing for any other text, for numbers that are not finite,
/// and for numbers that the type cannot hold.
template <class Number>
std::optional<Number> number_in(std::string_view text) {
    Number number = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(static_cast<double>(number))) return std::nullopt;
    return number;
}

/// Returns the numbers that make up the text with commas between them; nothing for any other text.
inline std::vector<double> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    while (true) {
        const std::size_t comma = text.find(',');
        const std::optional<double> number = number_in<double>(text.substr(0, comma));
        if (!number) return {};
        numbers.push_back(*number);
        if (comma == text.npos) return numbers;
        text.remove_prefix(comma + 1);
    }
}

/// Reads a length, "0.5" or "2%".
inline std::optional<Length> length_in(std::string_view text) {
    const bool is_percent = text.ends_with('%');
    const std::optional<double> number = number_in<double>(text.substr(0, text.size() - (is_percent ? 1 : 0)));
    if (!number) return std::nullopt;
    return is_percent ? Length::percent(*number) : Length(*number);
}

/// Throws Error(usage): "--size is '1,5', but it must be a length. Write 1.5." Texts that are no numbers are quoted.
[[noreturn]] inline void refuse_number(std::string_view option, std::string_view text, const char* range) {
    std::string point(text);
    if (const std::size_t comma = point.find(','); comma != point.npos) point[comma] = '.';
    const bool has_comma = point != text && length_in(point);
    const bool is_number = length_in(text).has_value();
    throw Error(ErrorCode::usage,
                fmt::format("--{} is {}, but it must be {}.{}", option, is_number ? text : fmt::format("'{}'", text),
                            range, has_comma ? fmt::format(" Write {}, with a point.", point) : ""));
}

/// Throws Error(usage) naming option, number and range, unless the number is in its range.
inline void require_in(const NumberRange& range, std::string_view option, double number) {
    if (!range.contains(number)) refuse_number(option, fmt::format("{}", number), range.words);
}

/// Returns the number of an option. Throws Error(usage), like require_in(), for a text that is no number or out of
/// range.
template <class Number>
Number parse_number(std::string_view option, std::string_view text, const NumberRange& range) {
    const std::optional<Number> number = number_in<Number>(text);
    if (!number || !range.contains(*number)) refuse_number(option, text, range.words);
    return *number;
}

/// Returns a length; `range` is that of the number before its %.
inline Length parse_length(std::string_view option, std::string_view text, const NumberRange& range) {
    const std::optional<Length> length = length_in(text);
    if (!length || !range.contains(length->number())) refuse_number(option, text, range.words);
    return *length;
}

}  // namespace kerf

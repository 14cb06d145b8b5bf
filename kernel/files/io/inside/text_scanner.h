// Reads words and numbers of a text, for the readers of text formats.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

#include "base/core/error.h"

namespace kerf {

/// The byte order mark that some programs put in front of a text.
inline constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";

namespace detail {

constexpr bool is_line_end(char c) { return c == '\n' || c == '\r'; }
constexpr bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

inline std::string_view without_plus(std::string_view word) {
    const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    return has_plus ? word.substr(1) : word;
}
// Parses the whole word, or returns an error.
template <class Number>
std::errc parse(std::string_view word, Number& value) {
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end != word.data() + word.size() ? std::errc::invalid_argument : error;
}
// Returns zero or infinity for a number beyond the doubles, by the power of ten of its first digit that is not 0.
inline double nearest_beyond_range(std::string_view number) {
    const bool is_negative = number.front() == '-';
    const std::size_t e = std::min(number.find_first_of("eE"), number.size());
    const std::size_t point = std::min(number.find('.'), e), first = number.find_first_of("123456789");
    std::int64_t exponent = 0;
    const std::string_view power = without_plus(number.substr(std::min(e + 1, number.size())));
    const bool is_huge_power = parse(power, exponent) == std::errc::result_out_of_range;
    const auto lead = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(first);
    const bool is_large = is_huge_power ? power.front() != '-' : exponent > -lead;
    const double magnitude = is_large ? std::numeric_limits<double>::infinity() : 0.0;
    return is_negative ? -magnitude : magnitude;
}

}  // namespace detail

/// Walks over a text word by word. Words are separated by blanks, tabs and line ends (LF, CR LF or CR); a comment runs
/// from the comment character to the end of its line. Numbers do not depend on the locale. Errors name file and line.
class TextScanner {
 public:
    /// Takes the text, the path for messages, and the character that begins comments; 0: the format has no comments.
    TextScanner(std::string_view text, const std::string& path, char comment = '\0')
        : text_(text), path_(path), comment_(comment) {}

    bool at_end() {
        skip(true);
        return position_ == text_.size();
    }
    /// Tells whether no word is left in the current line.
    bool at_line_end() {
        skip(false);
        return position_ == text_.size() || detail::is_line_end(text_[position_]);
    }
    /// Returns the first character of the next word, over line ends; there must be one.
    char peek() {
        skip(true);
        return text_[position_];
    }
    /// Returns the next word, over line ends; throws Error(input) at the end of the text.
    std::string_view next_word() {
        begin_word();
        return scan_word();
    }
    double next_real() {
        double value = 0;
        return take_plain_number(value, '\0') ? value : to_real(scan_word());
    }
    std::int64_t next_integer() {
        std::int64_t value = 0;
        return take_plain_number(value, '\0') ? value : to_integer(scan_word());
    }
    /// Returns the whole number that the next word is up to `mark`, or as a whole if `mark` is not in it.
    std::int64_t next_integer_before(char mark) {
        std::int64_t value = 0;
        if (take_plain_number(value, mark)) return value;
        const std::string_view word = scan_word();
        return to_integer(word.substr(0, word.find(mark)));
    }
    /// Returns the next index, which counts from `first` in the file, as one that counts from 0.
    std::int64_t next_index(std::int64_t first) {
        const std::int64_t index = next_integer();
        if (index < first)
            fail("an index is " + std::to_string(index) + ", but the file counts from " + std::to_string(first) +
                 ". Correct it or export the surface again.");
        return index - first;
    }
    /// Returns the next word, which must be a whole number that is not negative.
    std::int64_t next_count() { return to_count(next_word()); }
    /// Returns the nearest double of a word: infinite or zero for a number beyond the doubles; "nan" and "inf" are
    /// read, too.
    double to_real(std::string_view word) const {
        double value = 0;
        const std::string_view digits = detail::without_plus(word);
        const std::errc error = detail::parse(digits, value);
        if (error == std::errc::result_out_of_range) return detail::nearest_beyond_range(digits);
        if (error != std::errc()) refuse(word, "number", error);
        return value;
    }
    std::int64_t to_integer(std::string_view word) const {
        std::int64_t value = 0;
        const std::errc error = detail::parse(detail::without_plus(word), value);
        if (error != std::errc()) refuse(word, "whole number", error);
        return value;
    }
    std::int64_t to_count(std::string_view word) const {
        const std::int64_t count = to_integer(word);
        if (count < 0) fail("a number of elements is negative. Correct it or export the surface again.");
        return count;
    }
    /// Throws Error(input) if a word is left behind `last`, which names the end of the data that the file announced.
    void expect_end(const std::string& last) {
        if (at_end()) return;
        begin_word();
        fail("the file goes on after " + last + ". Correct the numbers or export the surface again.");
    }

    /// Returns the rest of the current line without surrounding blanks; the scanner stands at the next line then.
    std::string_view rest_of_line() {
        const std::size_t begin = position_;
        skip_line();
        std::string_view rest = text_.substr(begin, position_ - begin);
        while (!rest.empty() && detail::is_space(rest.back())) rest.remove_suffix(1);
        while (!rest.empty() && detail::is_space(rest.front())) rest.remove_prefix(1);
        return rest;
    }
    void skip_line() {
        const char* const end = text_.data() + text_.size();
        position_ = line_end(text_.data() + position_, end) - text_.data();
        if (text_.substr(position_, 2) == "\r\n") ++position_;
        if (position_ < text_.size()) ++position_;
    }
    std::size_t position() const { return position_; }
    /// Continues at a byte behind those that have been read.
    void go_to(std::size_t position) { position_ = position; }

    /// Throws Error(input) naming file and line of the last word before `what`.
    [[noreturn]] void fail(const std::string& what) const {
        std::int64_t line = 1;
        for (std::size_t i = 0; i < word_; ++i)
            line += text_[i] == '\n' || (text_[i] == '\r' && text_.substr(i + 1, 1) != "\n");
        throw Error(ErrorCode::input, path_ + ", line " + std::to_string(line) + ": " + what);
    }

 private:
    // Passes over blanks and comments. The loops walk by pointers of their own: through a member each step would be a
    // write to memory.
    void skip(bool over_line_ends) {
        const char *at = text_.data() + position_, *const end = text_.data() + text_.size();
        for (; at != end; ++at) {
            if (comment_ && *at == comment_) at = line_end(at, end);
            if (at == end || !detail::is_space(*at) || (!over_line_ends && detail::is_line_end(*at))) break;
        }
        position_ = at - text_.data();
    }
    static const char* line_end(const char* at, const char* end) {
        while (at != end && !detail::is_line_end(*at)) ++at;
        return at;
    }
    void begin_word() {
        if (at_end()) fail("the file ends too early. It is truncated: export or copy it again.");
        word_ = position_;
    }
    // Begins a word, and takes it if it is a number that from_chars() reads, ended by a blank, a comment or `mark`: one
    // walk instead of two. Returns false for all other words, which are scanned as words then.
    template <class Number>
    bool take_plain_number(Number& value, char mark) {
        begin_word();
        const char* const end = text_.data() + text_.size();
        const auto [at, error] = std::from_chars(text_.data() + position_, end, value);
        if (error != std::errc()) return false;
        if (at != end && mark && *at == mark) {
            scan_word();
            return true;
        }
        if (at != end && !detail::is_space(*at) && !(comment_ && *at == comment_)) return false;
        position_ = at - text_.data();
        return true;
    }
    std::string_view scan_word() {
        const char *const begin = text_.data() + position_, *at = begin, *const end = text_.data() + text_.size();
        const char comment = comment_ ? comment_ : ' ';
        while (at != end && !detail::is_space(*at) && *at != comment) ++at;
        position_ += at - begin;
        return {begin, at};
    }
    [[noreturn]] void refuse(std::string_view word, const char* kind, std::errc error) const {
        const std::string quoted = "\"" + std::string(word.substr(0, 40)) + "\"";
        fail((error == std::errc::result_out_of_range ? "the number " + quoted + " is too large"
                                                      : "a " + std::string(kind) + " is expected, not " + quoted) +
             ". Correct the line or export the surface again.");
    }

    std::string_view text_;
    const std::string& path_;
    char comment_;
    std::size_t position_ = 0;
    std::size_t word_ = 0;  // start of the last word
};

}  // namespace kerf

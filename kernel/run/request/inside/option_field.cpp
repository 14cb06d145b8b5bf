// A value is a variant of pointers to members of an option struct, and each kind of value has a function text_of() and
// one assign(), chosen by overloading: a new kind of option needs both, and nothing else. Text is the common form of
// all values, in config files, saved runs, reports and on command lines, so text_of() must give back every digit that
// assign() takes. Units are read but never written: memory is written in megabytes of 2^20 bytes, and counts as whole
// numbers.
#include "run/request/inside/option_field.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

// Returns megabytes of 2^20 bytes for "2G", "500M" or "1.5GiB", rounded up, or for a number of megabytes alone.
std::optional<std::int64_t> megabytes_in(std::string_view text) {
    if (const auto megabytes = number_in<std::int64_t>(text)) return megabytes;
    for (const std::string_view ending : {"B", "i"})
        if (text.ends_with(ending)) text.remove_suffix(1);
    constexpr std::string_view units = "KMGT";
    const std::size_t unit = text.empty() ? units.npos : units.find(text.back());
    if (unit == units.npos) return std::nullopt;
    const auto number = number_in<double>(text.substr(0, text.size() - 1));
    const double megabytes = number ? std::ceil(std::ldexp(*number, 10 * (static_cast<int>(unit) - 1))) : -1;
    if (!(megabytes >= 0 && megabytes < 0x1p62)) return std::nullopt;
    return static_cast<std::int64_t>(megabytes);
}

// Returns the number before the unit in thousands, millions or 10^9, for "50k", "1.5M" or "2G"; or a whole number
// alone.
std::optional<std::int64_t> count_in(std::string_view text) {
    if (const auto count = number_in<std::int64_t>(text)) return count;
    constexpr std::string_view units = "kKMG";
    constexpr double factors[] = {1e3, 1e3, 1e6, 1e9};
    const std::size_t unit = text.empty() ? units.npos : units.find(text.back());
    if (unit == units.npos) return std::nullopt;
    const auto number = number_in<double>(text.substr(0, text.size() - 1));
    const double count = number ? std::round(*number * factors[unit]) : -1;
    if (!(count >= 0 && count < 0x1p62)) return std::nullopt;
    return static_cast<std::int64_t>(count);
}

template <class T>
std::string text_of(const T* value) {
    return fmt::format("{}", *value);
}
std::string text_of(const OptionField::Memory& memory) { return fmt::format("{}", *memory); }
std::string text_of(const OptionField::Count& count) { return fmt::format("{}", *count); }
std::string text_of(const Length* length) { return length->text(); }
std::string text_of(const OptionField::List items) { return join_items(*items); }
std::string text_of(const OptionField::Choice& choice) { return choice.names[choice.get()]; }

// Sets the value. Throws Error(usage) for a text that is none.
template <class Number>
void assign(Number* value, const std::string& text, const OptionField& field) {
    *value = parse_number<Number>(field.name, text, field.range);
}
// Sets a whole number that may have had a unit.
void assign_whole(std::int64_t& value, std::optional<std::int64_t> number, const std::string& text,
                  const OptionField& field) {
    if (!number || !field.range.contains(*number)) refuse_number(field.name, text, field.range.words);
    value = *number;
}
void assign(const OptionField::Memory& memory, const std::string& text, const OptionField& field) {
    assign_whole(*memory, megabytes_in(text), text, field);
}
void assign(const OptionField::Count& count, const std::string& text, const OptionField& field) {
    assign_whole(*count, count_in(text), text, field);
}
void assign(Length* value, const std::string& text, const OptionField& field) {
    *value = parse_length(field.name, text, field.range);
}
void assign(bool* value, const std::string& text, const OptionField& field) {
    if (text != "true" && text != "false")
        throw Error(ErrorCode::usage, fmt::format("--{} is '{}', but it must be true or false.", field.name, text));
    *value = text == "true";
}
void assign(std::string* value, const std::string& text, const OptionField&) { *value = text; }
void assign(OptionField::List items, const std::string& text, const OptionField&) { *items = split_items(text); }
void assign(const OptionField::Choice& choice, const std::string& text, const OptionField& field) {
    const auto found = std::find(choice.names.begin(), choice.names.end(), text);
    if (found == choice.names.end())
        throw Error(ErrorCode::usage, fmt::format("--{} is '{}', but it must be one of {}.", field.name, text,
                                                  fmt::join(choice.names, ", ")));
    choice.set(found - choice.names.begin());
}

}  // namespace

std::string join_items(const std::vector<std::string>& items) {
    std::string text;
    for (const std::string& item : items) {
        if (item.empty()) continue;
        if (!text.empty()) text += ';';
        for (const char c : item) {
            if (c == ';' || c == '\\') text += '\\';
            text += c;
        }
    }
    return text;
}

std::vector<std::string> split_items(const std::string& text) {
    std::vector<std::string> items(1);
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == ';')
            items.emplace_back();
        else
            items.back() += text[i] == '\\' && i + 1 < text.size() ? text[++i] : text[i];
    }
    std::erase(items, "");
    return items;
}

std::string OptionField::text() const {
    return std::visit([](const auto& place) { return text_of(place); }, value);
}

void OptionField::set_text(const std::string& text) const {
    std::visit([&](const auto& place) { assign(place, text, *this); }, value);
}

void OptionField::check() const {
    const auto check_value = [&](const auto& place) {
        using Place = std::decay_t<decltype(place)>;
        if constexpr (std::is_same_v<Place, Length*>)
            require_in(range, name, place->number());
        else if constexpr (std::is_same_v<Place, double*> || std::is_same_v<Place, std::int32_t*> ||
                           std::is_same_v<Place, Memory> || std::is_same_v<Place, Count>)
            require_in(range, name, *place);
    };
    std::visit(check_value, value);
}

bool OptionField::is_number() const {
    return std::holds_alternative<std::int32_t*>(value) || std::holds_alternative<Memory>(value) ||
           std::holds_alternative<Count>(value) || std::holds_alternative<double*>(value) ||
           std::holds_alternative<Length*>(value);
}

}  // namespace kerf

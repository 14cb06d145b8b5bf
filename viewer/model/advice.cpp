#include "viewer/model/advice.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace kerf::view {

namespace {

// Letters, digits and dashes from a place on.
std::string word_at(const std::string& text, std::size_t begin) {
    std::size_t end = begin;
    while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '-')) ++end;
    return text.substr(begin, end - begin);
}

// The values that one can choose without asking; empty: none.
std::vector<std::string> choices_of(const OptionField& field) {
    if (const auto* choice = std::get_if<OptionField::Choice>(&field.value)) return choice->names;
    return {};
}

}  // namespace

std::optional<OptionText> advised_option(const std::string& text) {
    std::optional<OptionText> advice;
    RunOptions options;
    const std::vector<OptionField> fields = option_fields(options);
    for (std::size_t at = text.find("--"); at != text.npos; at = text.find("--", at + 2)) {
        const std::string option = word_at(text, at + 2);
        const auto field =
            std::find_if(fields.begin(), fields.end(), [&](const OptionField& f) { return f.name == option; });
        if (field == fields.end()) continue;  // of another program, or a path
        if (advice) return std::nullopt;
        if (std::holds_alternative<bool*>(field->value)) {
            advice = {option, "true"};
            continue;
        }
        const std::string value = word_at(text, std::min(text.size(), at + 3 + option.size()));
        const std::vector<std::string> choices = choices_of(*field);
        if (std::find(choices.begin(), choices.end(), value) == choices.end()) return std::nullopt;
        advice = {option, value};
    }
    return advice;
}

bool is_set(const RunOptions& options, const OptionText& option) {
    for (const OptionText& own : option_texts(options, false))
        if (own.name == option.name) return own.text == option.text;
    return false;
}

std::string words_of(const OptionText& advice) {
    if (advice.name == "surface" && advice.text == "remesh") return "Remesh the surface";
    if (advice.text == "true") return fmt::format("Run with --{}", advice.name);
    return fmt::format("Run with --{} {}", advice.name, advice.text);
}

}  // namespace kerf::view

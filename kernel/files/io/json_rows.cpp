#include "files/io/json_rows.h"

#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "files/io/json.h"

namespace kerf {

namespace {

using RowJson = nlohmann::ordered_json;

bool is_list_of_rows(const RowJson& value) { return value.is_array() && !value.empty() && value.front().is_object(); }

void append_rows(const RowJson& rows, std::string& text) {
    const char* before = "[\n    ";
    for (const RowJson& row : rows) {
        text += before;
        text += json_text(row);
        before = ",\n    ";
    }
    text += "\n  ]";
}

// Line ends within strings are escaped, so that all that are seen are of the layout.
void append_indented(const RowJson& value, std::string& text) {
    for (const char c : json_text(value, 2)) {
        text += c;
        if (c == '\n') text += "  ";
    }
}

}  // namespace

std::string text_with_rows(const RowJson& object) {
    std::string text;
    for (const auto& [name, value] : object.items()) {
        text += text.empty() ? "{\n  " : ",\n  ";
        text += json_text(RowJson(name)) + ": ";
        is_list_of_rows(value) ? append_rows(value, text) : append_indented(value, text);
    }
    return text.empty() ? "{}\n" : text + "\n}\n";
}

double to_six_digits(double number) {
    const std::string digits = fmt::format("{:.6g}", number);
    double shorter = number;
    std::from_chars(digits.data(), digits.data() + digits.size(), shorter);
    return shorter;
}

}  // namespace kerf

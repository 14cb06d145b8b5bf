// A config file is one flat table of TOML, keys being the names of options. Writing and reading go through the text of
// a field (run/request/inside/option_field.h), so that a value means the same here, on the command line and in a saved
// run; only quotes, lists and the point of floating-point numbers are TOML's own. toml++ sorts keys, so entries are put
// back into the order of the file. Paths are texts with escapes (files/io/path_text.h), because TOML must be UTF-8 and
// paths need not be.
#include "run/request/config_file.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include "base/core/error.h"
#include "files/io/file_bytes.h"
#include "files/io/path_text.h"

namespace kerf {

namespace {

// Returns a basic string of TOML.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            result += fmt::format("\\{}", c);
        else if (byte < 0x20 || byte == 0x7f)
            result += fmt::format("\\u{:04X}", byte);
        else
            result += c;
    }
    return result + '"';
}

// Returns a number of TOML: floating-point numbers have digits on both sides of a point, or an exponent.
std::string float_text(const std::string& text) { return text.find_first_of(".e") == text.npos ? text + ".0" : text; }

std::string value_text(const OptionField& field) {
    if (const auto* list = std::get_if<OptionField::List>(&field.value)) {
        std::string items;
        for (const std::string& item : **list)
            items += fmt::format("{}{}", items.empty() ? "" : ", ", quoted(path_text(item)));
        return "[" + items + "]";
    }
    const std::string text = field.text();
    const auto* length = std::get_if<Length*>(&field.value);
    if (std::holds_alternative<double*>(field.value) || (length && !(*length)->is_percent())) return float_text(text);
    const bool is_plain = std::holds_alternative<bool*>(field.value) || (field.is_number() && !length);
    return is_plain ? text : quoted(path_text(text));
}

bool has_value(const OptionField& field) {
    return !field.text().empty() && !(field.name == "parts" && field.text() == "0");
}

[[noreturn]] void refuse(const std::string& path, const toml::source_region& place, const std::string& what) {
    throw Error(ErrorCode::usage,
                fmt::format("{}, line {}: {}. It should have lines such as size = 0.5, as --print-config prints them.",
                            path, place.begin.line, what));
}

std::string text_of(const toml::node& node, const std::string& path, std::string_view key) {
    if (const auto text = node.value_exact<std::string>()) return path_of_text(*text);
    if (const toml::array* array = node.as_array()) {
        std::vector<std::string> items;
        for (const toml::node& item : *array) {
            const auto text = item.value_exact<std::string>();
            if (!text) refuse(path, item.source(), fmt::format("the list {} holds something else than texts", key));
            items.push_back(path_of_text(*text));
        }
        return join_items(items);
    }
    if (const auto flag = node.value_exact<bool>()) return *flag ? "true" : "false";
    if (const auto number = node.value_exact<std::int64_t>()) return fmt::format("{}", *number);
    if (const auto number = node.value_exact<double>()) return fmt::format("{}", *number);
    refuse(path, node.source(), fmt::format("the value of {} is neither a text nor a number", key));
}

}  // namespace

std::string to_config(const std::vector<OptionField>& fields) {
    std::string text;
    for (const OptionField& field : fields)
        text += has_value(field) ? fmt::format("# {}\n{} = {}\n", field.help, field.name, value_text(field))
                                 : fmt::format("# {}\n# {} =\n", field.help, field.name);
    return text;
}

std::vector<ConfigEntry> read_config(const std::string& path) {
    const std::string bytes = read_file(path);
    std::vector<std::pair<toml::source_position, ConfigEntry>> found;
    try {
        for (const auto& [key, node] : toml::parse(bytes))
            found.push_back({key.source().begin,
                             {{std::string(key.str()), text_of(node, path, key.str())},
                              fmt::format("{}, line {}", path, key.source().begin.line)}});
    } catch (const toml::parse_error& error) {
        refuse(path, error.source(), std::string(error.description()));
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<ConfigEntry> entries;
    for (auto& [place, entry] : found) entries.push_back(std::move(entry));
    return entries;
}

void set_option(const std::vector<OptionField>& fields, const ConfigEntry& entry) {
    const auto field =
        std::find_if(fields.begin(), fields.end(), [&](const OptionField& f) { return f.name == entry.name; });
    if (field == fields.end())
        throw Error(ErrorCode::usage, fmt::format("{}: '{}' is not an option. kerf mesh --print-config lists them.",
                                                  entry.place, entry.name));
    try {
        field->set_text(entry.text);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("{}: {}", entry.place, error.what()));
    }
}

}  // namespace kerf

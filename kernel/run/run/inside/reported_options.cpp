#include "run/run/inside/reported_options.h"

#include <nlohmann/json.hpp>

#include "files/io/json.h"
#include "files/io/path_text.h"

namespace kerf {

namespace {

std::string text_of_option(const nlohmann::json& value) {
    if (value.is_array()) {
        std::vector<std::string> items;
        for (const nlohmann::json& item : value) items.push_back(path_of_text(item));
        return join_items(items);
    }
    return value.is_number() || value.is_boolean() ? json_text(value) : path_of_text(value);
}

}  // namespace

RunRequest options_of_report(const nlohmann::json& options) {
    RunRequest result;
    for (const OptionField& field : option_fields(result))
        if (const auto value = options.find(field.name); value != options.end()) field.set_text(text_of_option(*value));
    return result;
}

}  // namespace kerf

#include "io/json.h"

#include <nlohmann/json.hpp>

namespace kerf {

namespace {

constexpr auto no_utf8 = nlohmann::json::error_handler_t::replace;

}  // namespace

nlohmann::json parse_json(std::string_view text) { return nlohmann::json::parse(text); }
nlohmann::ordered_json parse_ordered_json(std::string_view text) { return nlohmann::ordered_json::parse(text); }

nlohmann::json parse_json_or_null(std::string_view text) {
    nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
    return value.is_discarded() ? nlohmann::json() : value;
}

std::string json_text(const nlohmann::json& value, int indent) { return value.dump(indent, ' ', false, no_utf8); }
std::string json_text(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, no_utf8);
}

}  // namespace kerf

// JSON as text. The parser and the writer of nlohmann/json are templates, which every source that calls them would
// compile again, in two to four seconds: here they are compiled once. Sources that look into values, or make them,
// include nlohmann/json.hpp beside this.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace kerf {

/// The most arrays and objects within each other that parse_json() and its kin take.
inline constexpr int deepest_json = 200;

/// Returns the value of a text. Throws nlohmann::json::exception for a text that is no JSON, with the place in it, and
/// for more arrays and objects within each other than deepest_json: values of any depth are destroyed and written by
/// functions that call themselves.
nlohmann::json parse_json(std::string_view text);
/// Returns the value of a text as parse_json() does, with the members of objects in the order of the text.
nlohmann::ordered_json parse_ordered_json(std::string_view text);

/// Returns the value of a text, null where parse_json() throws.
nlohmann::json parse_json_or_null(std::string_view text);

/// Returns a value as text, with so many spaces of indentation a level; on one line without blanks if there are fewer
/// than 0. Numbers that are not finite are null, bytes that are no UTF-8 are replaced.
std::string json_text(const nlohmann::json& value, int indent = -1);
std::string json_text(const nlohmann::ordered_json& value, int indent = -1);

}  // namespace kerf

// Objects of JSON with long lists, as text that is short and can still be read.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace kerf {

/// Returns an object as text: its members with two spaces of indentation, but lists of objects among them with one
/// object a line, without blanks. The text ends with "\n}\n" unless the object is empty. Numbers that are not finite
/// are null, bytes that are no UTF-8 are replaced.
std::string text_with_rows(const nlohmann::ordered_json& object);

/// Returns the number to six digits: for results that are read, not computed with.
double to_six_digits(double number);

}  // namespace kerf

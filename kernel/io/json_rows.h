// Objects of JSON with long lists, as text that is short and can still be read.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace kerf {

/// The members of an object with two spaces of indentation, but lists of objects among them with one object a line,
/// without blanks. Ends with "\n}\n" unless it is empty. Numbers that are not finite are null, bytes that are no UTF-8
/// are replaced.
std::string text_with_rows(const nlohmann::ordered_json& object);

/// The number to six digits: of what is measured or described, and not computed with.
double to_six_digits(double number);

}  // namespace kerf

#include "files/io/json.h"

#include <nlohmann/json.hpp>

namespace kerf {

namespace {

constexpr auto no_utf8 = nlohmann::json::error_handler_t::replace;

class TooDeep : public nlohmann::json::exception {
 public:
    TooDeep() : exception(0, "arrays and objects lie too deep within each other") {}
};

// The depth of brackets outside of strings, whether or not they fit together.
void require_shallow(std::string_view text) {
    int depth = 0;
    bool is_in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') is_in_string = !is_in_string;
        if (is_in_string) {
            i += c == '\\';
        } else if (c == '[' || c == '{') {
            if (++depth > deepest_json) throw TooDeep();
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
}

}  // namespace

nlohmann::json parse_json(std::string_view text) {
    require_shallow(text);
    return nlohmann::json::parse(text);
}

nlohmann::ordered_json parse_ordered_json(std::string_view text) {
    require_shallow(text);
    return nlohmann::ordered_json::parse(text);
}

nlohmann::json parse_json_or_null(std::string_view text) {
    try {
        return parse_json(text);
    } catch (const nlohmann::json::exception&) {
        return nullptr;
    }
}

std::string json_text(const nlohmann::json& value, int indent) { return value.dump(indent, ' ', false, no_utf8); }
std::string json_text(const nlohmann::ordered_json& value, int indent) {
    return value.dump(indent, ' ', false, no_utf8);
}

}  // namespace kerf

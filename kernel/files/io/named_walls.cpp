#include "files/io/named_walls.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

// Returns the object. Throws Error(input) for bytes that are no JSON object, and for a patch that is there twice: a
// parser would keep one of the two.
Json parse_walls(std::string_view bytes, const std::string& path) {
    std::set<std::string> seen;
    std::string twice;
    const auto keep = [&](int depth, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::key && depth == 1 && !seen.insert(value.get<std::string>()).second)
            twice = value.get<std::string>();
        return true;
    };
    Json json = Json::parse(bytes, keep, false);
    if (json.is_discarded() || !json.is_object())
        throw Error(ErrorCode::input,
                    path +
                        ": this is no JSON object. Write two regions for each patch, null for the outside: "
                        R"({"wall": ["bone", "cement"], "outer": ["bone", null]}.)");
    if (!twice.empty()) throw Error(ErrorCode::input, fmt::format("{}: the patch '{}' is there twice.", path, twice));
    return json;
}

NamedWall to_wall(const std::string& patch, const Json& value, const std::string& path) {
    const auto is_side = [](const Json& side) {
        return side.is_null() || (side.is_string() && !side.get<std::string>().empty());
    };
    const bool is_pair = value.is_array() && value.size() == 2 && std::all_of(value.begin(), value.end(), is_side);
    if (!is_pair || value[0] == value[1])
        throw Error(ErrorCode::input, fmt::format("{}: the patch '{}' needs two different regions, such as "
                                                  R"(["bone", "cement"], or ["bone", null] towards the outside.)",
                                                  path, patch));
    const auto name_of = [](const Json& side) { return side.is_null() ? std::string() : side.get<std::string>(); };
    return {patch, {name_of(value[0]), name_of(value[1])}};
}

}  // namespace

std::vector<NamedWall> read_named_walls(std::string_view bytes, const std::string& path,
                                        const std::vector<std::string>& patch_names) {
    const Json json = parse_walls(bytes, path);
    for (const auto& [patch, value] : json.items())
        if (std::find(patch_names.begin(), patch_names.end(), patch) == patch_names.end())
            throw Error(ErrorCode::input, fmt::format("{}: there is no patch '{}'; those of the surface are {}.", path,
                                                      patch, fmt::join(patch_names, ", ")));
    std::vector<NamedWall> walls;
    for (const std::string& patch : patch_names) {
        if (!json.contains(patch))
            throw Error(ErrorCode::input,
                        fmt::format("{}: the patch '{}' is missing. Say what it bounds.", path, patch));
        walls.push_back(to_wall(patch, json[patch], path));
    }
    return walls;
}

}  // namespace kerf

#include "files/export/patch_types.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/name_pattern.h"

namespace kerf {

namespace {

constexpr std::array<std::string_view, 4> known_types = {"patch", "wall", "symmetry", "symmetryPlane"};

}  // namespace

std::vector<PatchType> parse_patch_types(std::span<const std::string> texts) {
    std::vector<PatchType> types;
    for (const std::string& text : texts) {
        const std::size_t at = text.rfind('=');
        const std::string type = at == text.npos ? "" : text.substr(at + 1);
        if (at == text.npos || at == 0 || std::find(known_types.begin(), known_types.end(), type) == known_types.end())
            throw Error(ErrorCode::usage, fmt::format("--patch-type is '{}'. Write NAME=TYPE, the name of a patch and "
                                                      "one of {}.",
                                                      text, fmt::join(known_types, ", ")));
        types.push_back({text.substr(0, at), type});
    }
    return types;
}

void require_patches(std::span<const PatchType> types, std::span<const std::string> patch_names) {
    for (const PatchType& each : types) matching_names("--patch-type", "patch", each.patch, patch_names);
}

void require_regions(std::size_t count) {
    if (count < 2)
        throw Error(ErrorCode::usage,
                    "--split-regions makes one mesh of each region, but the surface has one region. Leave it out.");
}

std::string type_of_patch(std::span<const PatchType> types, const std::string& patch) {
    const auto found = std::find_if(types.rbegin(), types.rend(),
                                    [&](const PatchType& each) { return matches_pattern(each.patch, patch); });
    return found == types.rend() ? "patch" : found->type;
}

}  // namespace kerf

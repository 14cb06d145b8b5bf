#include "fill/volume/meshers.h"

#include <array>

#include <fmt/format.h>

#include "base/core/error.h"

// The table has a line for each file of this folder that defines `const Mesher NAME_mesher`.
#define KERF_MESHERS(mesher) mesher(auto) mesher(lattice) mesher(tetgen)

namespace kerf {

#define KERF_DECLARE_MESHER(name) extern const Mesher name##_mesher;
KERF_MESHERS(KERF_DECLARE_MESHER)

namespace {
#define KERF_MESHER_ADDRESS(name) &name##_mesher,
constexpr std::array mesher_table = {KERF_MESHERS(KERF_MESHER_ADDRESS)};
}  // namespace

std::span<const Mesher* const> meshers() { return mesher_table; }

std::vector<std::string> mesher_names() {
    std::vector<std::string> names;
    for (const Mesher* mesher : mesher_table) names.emplace_back(mesher->name);
    return names;
}

const Mesher& find_mesher(std::string_view name) {
    for (const Mesher* mesher : mesher_table)
        if (mesher->name == name) return *mesher;
    throw Error(ErrorCode::usage,
                fmt::format("--mesher is '{}', which is none. There are {}.", name, fmt::join(mesher_names(), ", ")));
}

}  // namespace kerf

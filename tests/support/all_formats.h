// Values of --format that ask for everything.
#pragma once

#include <string>

#include "files/export/format.h"

namespace kerf::test {

/// Those that hold cells of this order.
inline std::string all_formats(int order = 1) {
    std::string names;
    for (const Format* format : formats())
        if (format->highest_order >= order) names += (names.empty() ? "" : ",") + std::string(format->name);
    return names;
}

}  // namespace kerf::test

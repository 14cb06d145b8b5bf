// The value of --format that asks for everything.
#pragma once

#include <string>

#include "export/format.h"

namespace kerf::test {

inline std::string all_formats() {
    std::string names;
    for (const Format* format : formats()) names += (names.empty() ? "" : ",") + std::string(format->name);
    return names;
}

}  // namespace kerf::test

// Names that are told from each other.
#pragma once

#include <set>
#include <string>

namespace kerf {

/// The name, or the first of NAME_2, NAME_3, ... that is not taken; it is taken then. O(log n) for each that is tried.
inline std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    std::string tried = name;
    for (int n = 2; !taken.insert(tried).second; ++n) tried = name + "_" + std::to_string(n);
    return tried;
}

}  // namespace kerf

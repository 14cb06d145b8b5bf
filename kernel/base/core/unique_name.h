// Names that differ from each other.
#pragma once

#include <set>
#include <string>

namespace kerf {

/// Returns the name, or the first of NAME_2, NAME_3, ... that is not in `taken`, and adds it there. O(log n) for each
/// name that is tried.
inline std::string unique_name(const std::string& name, std::set<std::string>& taken) {
    std::string tried = name;
    for (int n = 2; !taken.insert(tried).second; ++n) tried = name + "_" + std::to_string(n);
    return tried;
}

}  // namespace kerf

// The removal of some items from an array.
#pragma once

#include <vector>

namespace kerf {

/// Removes each item whose entry in `drop` is not 0; the others keep their order. O(n).
template <class T>
void drop_items(std::vector<T>& items, const std::vector<char>& drop) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i)
        if (!drop[i]) items[kept++] = items[i];
    items.resize(kept);
}

}  // namespace kerf

// Where bodies touch without a facet between them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/types.h"

namespace kerf {

/// Vertices and edges at which bodies may touch that have no facet in common there: outside of all of them lies
/// between. Ascending, each once.
struct Contacts {
    std::vector<Key> vertices;              ///< the ends of the edges are among them
    std::vector<std::array<Key, 2>> edges;  ///< the smaller key first

    bool empty() const { return vertices.empty(); }
    bool has(Key vertex) const;
    bool has(Key a, Key b) const;
};

/// Of all facets that have outside on one side: an edge with more than two of them, and a vertex at which they form
/// several fans. `outer`: these facets. `key`: #V. O(#V + #F).
Contacts find_contacts(const std::vector<Triangle>& outer, std::span<const Key> key);

}  // namespace kerf

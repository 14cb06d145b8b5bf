// Vertices and edges at which bodies touch without having a facet in common.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// Vertices and edges at which bodies may touch without a common facet: several wedges of the outside meet there.
/// Ascending, each once.
struct Contacts {
    std::vector<Key> vertices;              ///< include the ends of `edges`
    std::vector<std::array<Key, 2>> edges;  ///< the smaller key first

    bool empty() const { return vertices.empty(); }
    bool has(Key vertex) const;
    bool has(Key a, Key b) const;
};

/// Finds the edges at which more than two facets of `outer` meet, and the vertices at which they form several fans.
/// `outer` holds the facets that have the outside on one side, `key` the key of each vertex (#V). O(#V + #F).
Contacts find_contacts(const std::vector<Triangle>& outer, std::span<const Key> key);

}  // namespace kerf

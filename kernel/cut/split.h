// One closed surface and an interface to two closed surfaces.
#pragma once

#include <array>
#include <vector>

#include "cut/cut.h"

namespace kerf {

/// One half as Surface::build() takes it: the partners that the parent knew are known.
struct Half {
    SurfaceArrays arrays;
    std::vector<std::int32_t> partner;
};

/// The halves below and above. Facets keep their order, key and patch; the interface follows, its facet i with the key
/// (node, i) in both halves and opposite orientations, its interior point i with the key (node, i). O(#V + #F), a
/// half on each of two threads.
std::array<Half, 2> split(const Surface& surface, const std::vector<Side>& side, const Interface& interface,
                          NodeId node);

}  // namespace kerf

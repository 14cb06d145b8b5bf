// The division of a closed surface along an interface into two closed surfaces.
#pragma once

#include <array>
#include <vector>

#include "cut/cut/cut.h"

namespace kerf {

/// One half, in the form that Surface::build() takes: the partners that the parent knew are known.
struct Half {
    SurfaceArrays arrays;
    std::vector<std::int32_t> partner;
};

/// Returns the halves below and above. Facets keep their order, key and patch, and those of the interface follow: its
/// facet i has the key (node, i) in both halves and opposite orientations, its interior point i the key (node, i). O(#V
/// + #F), each half on a thread of its own.
std::array<Half, 2> split(const Surface& surface, const Array<Facet, Side>& side, const Interface& interface,
                          NodeId node);

}  // namespace kerf

// The law that the parts keep the user's surface.
#pragma once

#include <span>
#include <vector>

#include "base/parallel/communicator.h"
#include "cut/decompose/decomposition.h"

namespace kerf {

/// Counts the sides of facets of the input that the leaves do not have as they should. Each side, of facets with
/// numbers below `facets`, must be a facet of exactly one leaf of the region that it belongs to, unchanged, or, if
/// straight cuts have divided the facet, be covered exactly once by facets of such leaves. `sides`: as
/// Complex::all_sides(); a facet of one region has one side. Collective; `own` holds the leaves of this rank, and
/// divided_facets of the whole. Where nothing is missing the ranks tell each other 24 bytes and the pieces of divided
/// facets, else 8 bytes a facet of their leaves, too.
std::int64_t count_missing_input_facets(Communicator& ranks, std::int64_t facets, const Decomposition& own,
                                        std::span<const FacetSides> sides = {});

}  // namespace kerf

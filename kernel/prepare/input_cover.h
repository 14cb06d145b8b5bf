// The law that the parts keep the user's surface.
#pragma once

#include <vector>

#include "decompose/decomposition.h"
#include "parallel/communicator.h"

namespace kerf {

/// Facets of the input, numbered below `facets`, that are not a facet of exactly one leaf, unchanged, or, if straight
/// cuts have divided them, covered exactly once by facets of the leaves. Collective; `own` holds the leaves of this
/// rank, and divided_facets of the whole.
std::int64_t count_missing_input_facets(Communicator& ranks, std::int64_t facets, const Decomposition& own);

}  // namespace kerf

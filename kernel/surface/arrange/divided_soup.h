// A soup that takes over the pieces into which its arrangement has divided its facets.
#pragma once

#include <vector>

#include "surface/arrange/arrangement.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Replaces the facets of the soup by those of its arrangement: patches and numbers in the file are those of the
/// parents, new vertices have numbers behind those of the file. `keep`, `turn`: whether each facet of the arrangement
/// stays, and whether it is turned over. Vertices without a facet stay. Edges of a model that are no longer edges are
/// left out. O(#F), with a model O(#F log #F).
void take_divided_facets(Soup& soup, Arrangement arrangement, const std::vector<char>& keep,
                         const std::vector<char>& turn);

}  // namespace kerf

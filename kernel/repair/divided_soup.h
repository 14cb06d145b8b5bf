// A soup that takes over what its arrangement has made of its facets.
#pragma once

#include <vector>

#include "repair/arrangement.h"
#include "surface/soup.h"

namespace kerf {

/// Puts facets of an arrangement of the soup in the place of its own: patches and numbers in the file are those of the
/// parents, new vertices have numbers behind those of the file. `keep`, `turn`: per facet of the arrangement. Vertices
/// without a facet stay. Edges of a model that are no edges any more are left out. O(#F), with a model O(#F log #F).
void take_divided_facets(Soup& soup, Arrangement arrangement, const std::vector<char>& keep,
                         const std::vector<char>& turn);

}  // namespace kerf

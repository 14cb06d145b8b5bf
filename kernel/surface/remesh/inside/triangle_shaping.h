// The order in which the remesher uses its operations.
#pragma once

#include <functional>
#include <vector>

#include "surface/remesh/inside/sheet_state.h"
#include "surface/remesh/remesh.h"

namespace kerf {

/// Returns the input without what the bound does not need. `kept` (#F of the input) marks facets that stay as they are;
/// empty: none. Works on threads, in blocks (inside/blocks.h): the result is the same for any number of them. `add` is
/// called with shares of this work that are done, on any thread. O(#F log #F).
SheetState simplify(const InputShape& input, const std::vector<char>& kept, const RemeshOptions& options,
                    const std::function<void(double)>& add);

/// Finds sizes (FoldSizes), then splits, moves, collapses and flips until triangles are well shaped and of these sizes.
/// On threads, as above. O(n log n) for n facets before and after.
void shape_triangles(const InputShape& input, const RemeshOptions& options, const std::function<void(double)>& add,
                     SheetState& state);

}  // namespace kerf

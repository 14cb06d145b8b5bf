// The labels of facets, below or above. The contour is the boundary between them: closed loops of surface edges.
#pragma once

#include <vector>

#include "cut/cut/inside/band.h"

namespace kerf {

/// Relabels the facets of the band by a minimum cut: a short contour near the plane that avoids facets parallel to it.
///
/// An edge costs its length, times 1 + (distance / h)^2, times 1 + 3 |n_z|^4, times the larger `penalty` of its facets
/// (per band facet, >= 1); a facet on the wrong side costs area times distance / h^2. Facets outside of the band keep
/// their label, and so do all facets if the plane crosses no edge. The steps of the flow are taken from `step_budget`;
/// returns false, with `side` unchanged, if the budget does not suffice.
bool minimum_cut_labels(const Surface& surface, const Band& band, const std::vector<double>& penalty,
                        Array<Facet, Side>& side, std::int64_t& step_budget);

}  // namespace kerf

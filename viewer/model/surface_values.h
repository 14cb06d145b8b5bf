// The values by which surfaces are coloured, besides their patches, and the feature lines on them.
#pragma once

#include <array>
#include <vector>

#include "surface/size/size_field.h"
#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Returns the reason, as a sentence, why a document has no values for a colouring of surfaces or of solutions; null if
/// it has them, or the colouring is of another kind.
const char* why_without_values(const Document& document, ColorBy color);

/// Returns the largest distance of each facet from another surface, at 10 points of the facet; NaN for facets of
/// interfaces, and for facets with coordinates that are not finite. O(#F log #F).
std::vector<float> distances_of_facets(const NodeSurface& surface, const NodeSurface& other);

/// Returns the wanted edge length at each vertex; NaN where the field asks for none.
std::vector<float> lengths_at_vertices(const NodeSurface& surface, const SizeField& field);

/// Returns the edges of the input at which the surface turns by more than 30 degrees, or patches meet, each once, in
/// the order of their vertices. Edges of interfaces are left out. O(#F log #F).
std::vector<std::array<Vec3, 2>> feature_edges(const NodeSurface& surface);

}  // namespace kerf::view

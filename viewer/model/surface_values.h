// What surfaces are coloured by besides their patches, and the lines on them.
#pragma once

#include <array>
#include <vector>

#include "size/size_field.h"
#include "viewer/model/document.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Why the surfaces of a document have no such values; null: they have, or the colouring is none of surfaces.
const char* why_without_values(const Document& document, ColorBy color);

/// The largest distance of each facet from another surface, at 10 points of it; NaN for facets of interfaces,
/// and for those with coordinates that are not finite.
/// O(#F log #F).
std::vector<float> distances_of_facets(const NodeSurface& surface, const NodeSurface& other);

/// The wanted edge length at each vertex; NaN where nothing is asked.
std::vector<float> lengths_at_vertices(const NodeSurface& surface, const SizeField& field);

/// Edges of the input at which the surface turns by more than 30 degrees, or patches meet, each once, in the order of
/// their vertices. Edges of interfaces are none. O(#F log #F).
std::vector<std::array<Vec3, 2>> feature_edges(const NodeSurface& surface);

}  // namespace kerf::view

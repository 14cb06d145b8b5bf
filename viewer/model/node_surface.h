// Surfaces in the form in which the viewer has them, with the memory that they take.
#pragma once

#include "viewer/model/document.h"

namespace kerf::view {

/// The surface of a node, numbered alike.
NodeSurface node_surface_of(const SurfaceArrays& surface);

/// What a file said, numbered and oriented alike: as the surface of the root.
NodeSurface node_surface_of(const Soup& soup);

template <class T>
std::size_t bytes_of(const std::vector<T>& items) {
    return items.capacity() * sizeof(T);
}
std::size_t bytes_of(const NodeSurface& surface);
std::size_t bytes_of(const PartCells& cells);

}  // namespace kerf::view

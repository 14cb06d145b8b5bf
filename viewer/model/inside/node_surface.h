// Converts surfaces into the form in which the viewer has them, and measures the memory that they take.
#pragma once

#include "viewer/model/document.h"

namespace kerf::view {

/// Returns the surface of a node, with the same numbers.
NodeSurface node_surface_of(const SurfaceArrays& surface);

/// Returns the content of a surface file as the surface of the root, with the same numbers and orientation.
NodeSurface node_surface_of(const Soup& soup);

template <class T>
std::size_t bytes_of(const std::vector<T>& items) {
    return items.capacity() * sizeof(T);
}
std::size_t bytes_of(const NodeSurface& surface);
std::size_t bytes_of(const PartCells& cells);

}  // namespace kerf::view

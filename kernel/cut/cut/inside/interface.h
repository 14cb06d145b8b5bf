// The interface inside of a contour: projected, triangulated, lifted.
#pragma once

#include <vector>

#include "cut/cut/inside/band.h"
#include "cut/cut/inside/contour_layout.h"
#include "cut/cut/inside/options.h"

namespace kerf {

/// An interface, or the reason why there is none and the vertices of the surface at which it failed.
struct InterfaceAttempt {
    Refusal refusal = Refusal::none;
    std::vector<Vertex> failed;
    Interface interface;
};

/// Spans the contour's loops, each a closed path of edges of the surface, with triangles as small as the volume bound
/// of `options` asks for. `hits` (per vertex of the band) counts how often an interface has run into the vertex before:
/// its clearance grows with that. With ContourLayout::unfolded, a contour that needs no unfolding is refused
/// (crossing_projection, at no vertex), since the interface would be the same as for its projection.
InterfaceAttempt build_interface(const Surface& surface, const Band& band, const Array<Facet, Side>& side,
                                 const std::vector<std::vector<Vertex>>& loops, const std::vector<std::int32_t>& hits,
                                 const CutOptions& options, ContourLayout layout = ContourLayout::projected);

/// Returns the area of the lifted triangles.
double interface_area(const Interface& interface);

}  // namespace kerf

// Which volumes of one of Gmsh's files its surfaces bound, where it has no tetrahedra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/gmsh_model.h"
#include "surface/soup.h"

namespace kerf::gmsh {

/// Facets of one surface that follow each other, up to the next run.
struct SurfaceRun {
    std::int64_t entity;
    std::size_t first_facet;
};

struct SurfaceSides {
    std::vector<FacetSides> sides;          ///< #F; the same on both sides where no region ends
    std::vector<std::string> region_names;  ///< as of tetrahedra: see regions_of()
};

/// What the lists of surfaces say that bound volumes. Only volumes count all of whose surfaces are in the file; empty
/// if they are less than two. O(n log n) for volumes of n facets, deterministic.
///
/// On which side of its surfaces a volume lies does not follow from the signs in its list, which Gmsh's two geometries
/// write in different ways, and not always consistently. It follows from the facets: they are made to agree over edges;
/// the shell that encloses most has the volume behind it, and all others are around voids. Whether the shells close is
/// not checked here: regions that do not are found later.
SurfaceSides sides_of_surfaces(const Model& model, const std::vector<SurfaceRun>& runs, const Soup& soup);

}  // namespace kerf::gmsh

// The volumes on the sides of the surfaces of one of Gmsh's files that has no tetrahedra.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "files/io/inside/gmsh_model.h"
#include "surface/soup/soup.h"

namespace kerf::gmsh {

/// A run of facets of one surface that follow each other: it ends where the next run begins.
struct SurfaceRun {
    std::int64_t entity;
    std::size_t first_facet;
};

struct SurfaceSides {
    std::vector<FacetSides> sides;          ///< #F; the same on both sides where no region ends
    std::vector<std::string> region_names;  ///< made of names of volumes by regions_of(), as those of tetrahedra are
};

/// Returns the sides of the facets that follow from the lists of surfaces that bound volumes. A volume counts only if
/// all of its surfaces are in the file; the result is empty for less than two such volumes and for partitioned meshes.
/// O(n log n) for volumes of n facets, deterministic.
///
/// The side of its surfaces on which a volume lies does not follow from the signs in its list, which Gmsh's two
/// geometries write in different ways, and not always consistently. It follows from the facets: they are made to agree
/// over edges; the shell that encloses most has the volume behind it, and all others are around voids. Whether the
/// shells close is not checked here: regions that are not closed are found later.
SurfaceSides sides_of_surfaces(const Model& model, const std::vector<SurfaceRun>& runs, const Soup& soup);

}  // namespace kerf::gmsh

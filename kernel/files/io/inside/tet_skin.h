// The surface of the tetrahedra of a file: faces at which regions end.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fill/mesh/tet_mesh.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

/// A face of a tetrahedron at which a region ends.
struct RegionFace {
    Triangle corners;  ///< counter-clockwise seen from outside of the region at the back
    FacetSides sides;  ///< the smaller region, or the only one, at the back
};

struct RegionFaces {
    std::vector<RegionFace> faces;
    std::optional<RegionFace> overlap;  ///< first face at which tetrahedra of two regions lie on the same side
};

/// Returns the faces between tetrahedra of two regions, and the skin: the faces that only one tetrahedron has. They do
/// not depend on the orientation of the tetrahedra, and are in the order of the tetrahedra at their back.
/// `region_of_tet`: #T, from 0 on; empty: all are of region 0. O(#T), deterministic.
RegionFaces region_faces(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets,
                         const std::vector<RegionIndex>& region_of_tet = {});

/// Return sentences for users, which name only the first of many regions.
std::string tell_skin(std::size_t tets);
std::string tell_regions(const std::vector<std::string>& regions, std::size_t walls, std::size_t facets);
std::string tell_joined_volumes(std::size_t volumes, const std::string& region);
std::string tell_overlap(const std::string& region, const std::string& other, const Vec3& where);

}  // namespace kerf

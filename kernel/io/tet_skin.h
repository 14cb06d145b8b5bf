// What the tetrahedra of a file say of a surface.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/tet_mesh.h"

namespace kerf {

/// Faces that only one tetrahedron has, counter-clockwise seen from outside of it, whatever the orientation of the
/// tetrahedron; in the order of the tetrahedra. O(#T), deterministic.
std::vector<Triangle> skin_of(const std::vector<Vec3>& vertices, const std::vector<Tetrahedron>& tets);

/// A facet with tetrahedra of different volumes on its sides.
struct Wall {
    std::int32_t facet;
    std::array<std::int32_t, 2> volumes;  ///< ascending
};

/// The first facet that is a wall. `volume_of_tet`: #T. O(#T + #F log #F), deterministic.
std::optional<Wall> find_wall(std::size_t vertex_count, const std::vector<Tetrahedron>& tets,
                              const std::vector<std::int32_t>& volume_of_tet, const std::vector<Triangle>& facets);

/// Sentences for users. Of many names of volumes the first are told.
std::string tell_skin(std::size_t tets, const std::vector<std::string>& volumes);
std::string tell_volumes(const std::vector<std::string>& volumes);
std::string tell_wall(const std::string& volume, const std::string& other, const Vec3& where);

}  // namespace kerf

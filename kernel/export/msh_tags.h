// What nodes, elements, entities and patches are called in Gmsh's files, and which tetrahedra of a part are whose.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "part/part.h"

namespace kerf::msh {

/// Gmsh's numbers of elements of an order, and the order of its ten nodes: behind the corners, edges 01 12 02 03 23 13.
constexpr std::int32_t triangle_type(int order) { return order == 1 ? 2 : 9; }
constexpr std::int32_t tet_type(int order) { return order == 1 ? 4 : 11; }
inline constexpr std::array<std::int8_t, 10> order_of_nodes = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

inline constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();
inline constexpr std::size_t longest_name = 251;  ///< bytes; Gmsh refuses files with 253

/// One of Gmsh's: a surface or a volume.
struct Entity {
    std::int32_t dimension, tag;
};

/// All entities have tags of their own, those of the whole and those of every part.
class Tags {
 public:
    /// Throws Error(usage) for more than 32 bits tell apart.
    explicit Tags(const PartSource& source);

    static Entity surface(std::int32_t patch) { return {2, patch + 1}; }
    static Entity whole(std::int32_t material) { return {3, material + 1}; }
    Entity surface_of_part(PartIndex index, std::int32_t patch) const {
        return {2, (index.value() + 1) * patches_ + patch + 1};
    }
    Entity volume_of_part(PartIndex index, std::int32_t material) const {
        return {3, (index.value() + 1) * materials_ + material + 1};
    }
    Entity ghosts_of_part(PartIndex index) const { return {3, (parts_ + 1) * materials_ + index.value() + 1}; }
    /// Merged, the parts are the volumes, for each material that they have something of.
    Entity merged_volume(PartIndex index, std::int32_t material) const {
        return {3, index.value() * materials_ + material + 1};
    }

    /// Physical tags are different in all dimensions, as Gmsh chooses them itself, and GetDP needs them.
    static std::int32_t physical_patch(std::int32_t patch) { return patch + 1; }
    std::int32_t physical_material(std::int32_t material) const { return patches_ + material + 1; }

    std::int32_t parts() const { return parts_; }
    std::int32_t materials() const { return materials_; }

 private:
    std::int32_t parts_, patches_, materials_;
};

constexpr std::int64_t tag_of(std::int64_t number) { return number + 1; }

/// The number of a part's first triangle among all elements.
std::int64_t first_triangle(const MeshOutline& outline, PartIndex index);
std::int64_t element_count(const MeshOutline& outline);

/// The name without what ends a name or a line, and not ending inside of a character that takes several bytes.
std::string readable(std::string name, std::size_t most);

/// Gmsh has no escapes: quotes become apostrophes. Names that are alike then get their number, from 1.
std::vector<std::string> readable_names(const std::vector<std::string>& names);

/// What a part has of a material.
struct MaterialPiece {
    std::int32_t material = 0;
    std::vector<std::int32_t> tets;    ///< of the part, ascending
    std::vector<std::int32_t> inside;  ///< nodes on no patch
    Eigen::AlignedBox3d box;
};

/// Ascending by material. `inside`: those nodes that are asked for.
std::vector<MaterialPiece> material_pieces(const PartSource& parts, PartIndex index, const Part& part,
                                           const std::vector<std::int32_t>& inside);

}  // namespace kerf::msh

// The tags and names of nodes, elements, entities and patches in Gmsh's files, and the tetrahedra of each material in a
// part.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "files/part/part.h"

namespace kerf::msh {

/// Gmsh's numbers of element types by order, and its order of the ten nodes: behind the corners, edges 01 12 02 03 23
/// 13.
constexpr std::int32_t triangle_type(int order) { return order == 1 ? 2 : 9; }
constexpr std::int32_t tet_type(int order) { return order == 1 ? 4 : 11; }
inline constexpr std::array<std::int8_t, 10> order_of_nodes = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};

inline constexpr std::int64_t most_int32 = std::numeric_limits<std::int32_t>::max();
inline constexpr std::size_t longest_name = 251;  ///< bytes; Gmsh refuses files with 253

/// An entity of Gmsh's: a surface or a volume.
struct Entity {
    std::int32_t dimension, tag;
};

/// Gives all entities tags of their own, those of the whole and those of every part.
class Tags {
 public:
    /// Throws Error(usage) for more entities than 32 bits tell apart.
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
    /// Returns the volume of a part's piece of a material in a merged file.
    Entity merged_volume(PartIndex index, std::int32_t material) const {
        return {3, index.value() * materials_ + material + 1};
    }

    /// Return physical tags, which differ in all dimensions, as Gmsh chooses them itself, and GetDP needs them.
    static std::int32_t physical_patch(std::int32_t patch) { return patch + 1; }
    std::int32_t physical_material(std::int32_t material) const { return patches_ + material + 1; }

    std::int32_t parts() const { return parts_; }
    std::int32_t materials() const { return materials_; }

 private:
    std::int32_t parts_, patches_, materials_;
};

constexpr std::int64_t tag_of(std::int64_t number) { return number + 1; }

/// Returns the number of a part's first triangle among all elements.
std::int64_t first_triangle(const MeshOutline& outline, PartIndex index);
std::int64_t element_count(const MeshOutline& outline);

/// Returns the name without characters that end a name or a line, of `most` bytes at most, and not ending inside of a
/// character that takes several bytes.
std::string readable(std::string name, std::size_t most);

/// Returns the names as Gmsh can read them: it has no escapes, so that quotes become apostrophes. Names that are alike
/// then get their number, from 1.
std::vector<std::string> readable_names(const std::vector<std::string>& names);

/// The piece of a material in a part.
struct MaterialPiece {
    std::int32_t material = 0;
    std::vector<std::int32_t> tets;    ///< tetrahedra of the part, ascending
    std::vector<std::int32_t> inside;  ///< nodes on no patch
    Eigen::AlignedBox3d box;
};

/// Returns the pieces of a part, ascending by material. `inside`: the nodes from which MaterialPiece::inside is taken.
std::vector<MaterialPiece> material_pieces(const PartSource& parts, PartIndex index, const Part& part,
                                           const std::vector<std::int32_t>& inside);

}  // namespace kerf::msh

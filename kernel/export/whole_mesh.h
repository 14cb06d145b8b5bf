// All parts as one mesh, without ever holding more than one of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "part/part.h"

namespace kerf {

// Memory, whatever the size of the mesh: 48 MB of points and 6 bytes a tetrahedron of the largest part in
// for_each_node(), 18 bytes a tetrahedron in for_each_part() for cells, 48 MB in for_each_patch_triangle(); so parts
// of 2.5e6 tetrahedra are merged below 100 MB beside what the PartSource holds.

/// Calls take(first, points) with the nodes of the whole mesh in the order of their global numbers: a piece at a time,
/// the first of which has the number `first`. Parts are loaded as often as they have nodes of a piece.
void for_each_node(const PartSource& parts,
                   const std::function<void(std::int64_t first, std::span<const Vec3> points)>& take);

/// Gives the numbers of Part::values[k], of points, a row for each node, in the same order.
void for_each_node_value(const PartSource& parts, std::size_t k,
                         const std::function<void(std::int64_t first, std::span<const double> rows)>& take);

/// Calls take(index, part) with every part, in the order of the tree, and what is asked for of it.
void for_each_part(const PartSource& parts, PartContent content,
                   const std::function<void(PartIndex index, const Part& part)>& take);

/// The number of triangles on each patch that all parts list: a wall between two regions counts once.
std::vector<std::int64_t> patch_sizes(const PartSource& parts);

/// A boundary triangle on the user's surface: of a wall between two regions, that of one side.
struct PatchTriangle {
    std::int32_t patch;
    std::array<std::int64_t, 3> corners;  ///< global numbers; seen from outside of its part
};

/// Which triangles on patches are asked for.
enum class OnPatches {
    all,    ///< that files list (Part::is_listed()); patch_sizes() has their numbers
    outer,  ///< without the walls between regions; Bodies::boundary_sizes() has their numbers
};

/// Calls take(patch, triangles) with the triangles of patch after patch, in the order of the tree within a patch; those
/// of a large patch come in several calls in a row. `sizes`: how many each patch has. Surfaces are read once for each
/// 1e6 triangles.
void for_each_patch_triangle(
    const PartSource& parts, std::span<const std::int64_t> sizes,
    const std::function<void(std::int32_t patch, std::span<const PatchTriangle> triangles)>& take,
    OnPatches wanted = OnPatches::all);

/// Throws Error(usage), naming the format, if the mesh has more than `most` vertices, tetrahedra or boundary triangles.
void require_numbers_fit(const MeshOutline& outline, std::string_view format, std::int64_t most);
inline constexpr std::int64_t most_of_32_bits = std::numeric_limits<std::int32_t>::max();

/// Corners of a cell of the part as global numbers.
template <std::size_t n>
std::array<std::int64_t, n> global_corners(const Part& part, const std::array<std::int32_t, n>& cell) {
    std::array<std::int64_t, n> ids;
    for (std::size_t i = 0; i < n; ++i) ids[i] = part.global_id[cell[i]];
    return ids;
}

}  // namespace kerf

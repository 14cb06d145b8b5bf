// The sharpest cells of a mesh, and what of its surface makes them so.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "fill/mesh/inside/forced_cells.h"
#include "fill/mesh/tet_mesh.h"

namespace kerf {

/// The cause of a sharp cell, in the order in which causes are asked for.
enum class SharpnessCause {
    edge,    ///< an edge of the user's surface at which the body is as sharp
    walls,   ///< two walls of the user's surface that are near to each other
    facet,   ///< a needle of the user's surface at an edge or a vertex of the cell
    cut,     ///< a vertex on the interface to another part
    unknown  ///< nothing of these
};
inline constexpr std::size_t sharpness_causes = 5;

/// The cells of one cause, and the worst of them.
struct SharpCells {
    std::int64_t count = 0;
    double angle_deg = 180;     ///< smallest dihedral angle
    Vec3 place = Vec3::Zero();  ///< centre of the worst cell
    /// The angle of the body at the edge, the distance of the walls, or the smallest angle of the facet, at the worst
    /// cell; else 0.
    double measure = 0;
    std::int32_t patch = -1;  ///< of the facet that was found there; -1: none

    void add(const SharpCells& other);

    template <class Archive>
    void archive(Archive& a) {
        a(count, angle_deg, place, measure, patch);
    }
};

/// The cells with a dihedral angle below a bound, by causes.
struct WorstCells {
    static constexpr double bound_deg = 5;

    double smallest_deg = 180;  ///< smallest dihedral angle of all cells, also where none is below the bound
    std::array<SharpCells, sharpness_causes> by_cause;

    const SharpCells& of(SharpnessCause cause) const { return by_cause[static_cast<std::size_t>(cause)]; }
    std::int64_t count() const;

    template <class Archive>
    void archive(Archive& a) {
        a(smallest_deg);
        for (SharpCells& cells : by_cause) a(cells);
    }
};

/// Finds the worst cells of a mesh. `patch`: #F; -1 on interfaces. O(#T), 15 ns a cell; where there are any, O(#F log
/// #F) and some us for each. Deterministic: of equally sharp cells the first one is the worst.
WorstCells find_worst_cells(const TetMesh& mesh, const BoundaryTriangles& boundary,
                            std::span<const std::int32_t> patch);

}  // namespace kerf

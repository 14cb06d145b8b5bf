// The cells into which facets divide space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/soup/ray_parity.h"

namespace kerf {

/// The cells in front of a facet and behind it; -1: the unbounded cell.
struct CellSides {
    std::int32_t front = -1, back = -1;

    bool is_wall() const { return front >= 0 && back >= 0; }
    bool operator==(const CellSides&) const = default;
};

struct Cells {
    std::vector<CellSides> sides;  ///< #F
    std::int32_t count = 0;        ///< number of bounded cells
};

/// Finds the cells into which conforming facets divide space. Facets conform if each is there once and they meet in
/// common edges and vertices only; any number of them may meet at an edge or a vertex. Cells that touch only at edges
/// or vertices are different cells; a cell with others inside of it has their outer facets on its boundary, too. A
/// facet that closes nothing has the same cell on both sides. Cells are numbered by their smallest facets, the front of
/// a facet before its back. Returns nothing if facets lie on one another or have no area; facets that fail to conform
/// in other ways give unspecified cells, whose facets close.
///
/// Exact signs decide which sides face each other around an edge, and which component lies inside of which; where all
/// vertices of the inner component are vertices of the outer one, midpoints of edges decide, which are rounded. The
/// corners of `facets` must be in range and different. O(#F log #F) plus the questions of locate_shells(), asked for
/// components that edges connect in place of shells. Deterministic.
std::optional<Cells> find_cells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// Returns the volume of each cell, without the volume of cells inside of it. O(#F).
std::vector<double> cell_volumes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const Cells& cells);

/// Finds the cell that contains a point. Keeps a reference to the vertices. Not for several threads.
class CellLocator {
 public:
    CellLocator(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Cells& cells);

    /// Returns the number of the cell that contains the point, -1 for the unbounded one, or nothing if the point lies
    /// on the boundary of a cell. Exact. O(log #cells), and a question to each cell whose box contains the point, see
    /// encloses().
    std::optional<std::int32_t> find(const Vec3& point) const;

 private:
    const std::vector<Vec3>& vertices_;
    std::vector<Shell> shells_;
    BoxTree boxes_;  // of the shells
};

}  // namespace kerf

// The cells into which facets divide space.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "surface/facet_sides.h"
#include "surface/ray_parity.h"

namespace kerf {

struct Cells {
    std::vector<FacetSides> sides;  ///< #F; the cells in front of each facet and behind it; -1: the unbounded one
    std::int32_t count = 0;         ///< bounded ones
};

/// Cells of conforming facets: each is there once, any number of them may meet at an edge or a vertex, and they meet
/// nowhere else. Cells that touch at edges or vertices only are two; one with cells inside of it has their outer facets
/// on its boundary, too. A facet that ends nothing has one cell on both sides. Numbered by their smallest facets, of
/// these the front first. Nothing is returned if facets lie on one another or have no area; other facets that do not
/// conform give some cells or other, whose facets close.
///
/// Exact signs decide which sides face each other around an edge, and what lies inside of what; where all vertices of
/// what lies inside are vertices of what is around it, midpoints of edges decide, which are rounded. `facets`: corners
/// in range and different. O(#F log #F) plus the questions that locate_shells() asks, of what hangs together over
/// edges. Deterministic.
std::optional<Cells> find_cells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets);

/// The volume of each cell, what lies inside of it left out. O(#F).
std::vector<double> cell_volumes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const Cells& cells);

/// Where points lie among cells. Keeps a reference to the vertices. Not for several threads.
class CellLocator {
 public:
    CellLocator(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, const Cells& cells);

    /// The number of the cell, -1: the unbounded one; nothing if the point lies on the boundary of a cell. Exact.
    /// O(log #cells), and a question to each cell whose box contains the point, see encloses().
    std::optional<std::int32_t> find(const Vec3& point) const;

 private:
    const std::vector<Vec3>& vertices_;
    std::vector<Shell> shells_;
    BoxTree boxes_;  // of these
};

}  // namespace kerf

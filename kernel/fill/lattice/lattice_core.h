// The inside of a body as cells of a lattice: a core of cells that are stamped, and the points that join it with the
// surface.
#pragma once

#include <vector>

#include "fill/lattice/inside/site_blocks.h"
#include "surface/complex/surface.h"

namespace kerf {

/// The cells of a lattice that have a corner deep inside. Sites are kept that are inside and clearance() from every
/// facet; a site is deep if its 14 neighbours are kept, too. A cell of the core has four kept corners and at least one
/// deep one. So all cells at a deep site belong to the core; a face of its boundary has a deep site on one side, and
/// none on the other or among its corners; and kept sites without a deep neighbour belong to no cell.
///
/// Every point of a core is inside of the surface, at least 0.24 edges from it. The core may have many parts, or none,
/// and its boundary may touch itself at edges and vertices; all its edges are those of an even number of faces. Cells
/// have positive orientation and the volume of BccLattice, both but for the jitter.
///
/// Cells are never stored: 3 bits a site and half a byte for its number, in blocks where there are sites. All answers
/// depend on the edge and on the facets alone, not on their order. Thread-safe.
class LatticeCore {
 public:
    /// Makes the core of a surface. Edges of the lattice have the length `edge` and sqrt(3)/2 of it. The surface must
    /// be closed, with normals to either side; see sites_inside() and remove_sites_near() for time and errors. Throws
    /// Error(memory), too, if there are more points than 32 bits can number.
    LatticeCore(const SurfaceArrays& surface, double edge);

    const BccLattice& lattice() const { return lattice_; }
    /// Returns the number of blocks of sites.
    std::int32_t block_count() const { return blocks_.size(); }
    /// Returns the memory of the sites and numbers that the core keeps.
    std::size_t bytes() const;

    std::int64_t cell_count() const { return cell_count_; }
    /// Returns the number of points of the core's boundary. They are numbered without gaps in the order of
    /// boundary_points().
    std::int32_t boundary_point_count() const { return boundary_number_.count(); }
    /// Returns the number of points around which there are cells of the core alone.
    std::int32_t interior_point_count() const { return interior_number_.count(); }

    std::vector<Vec3> boundary_points() const;
    /// Returns the faces between a cell of the core and the space outside, over boundary_points(), counter-clockwise
    /// seen from outside of the core. Each face once. Some 15 us a block.
    std::vector<Triangle> boundary_faces() const;
    /// Returns the points of sites that are kept and are corners of no cell of the core.
    std::vector<Vec3> free_points() const;

    /// Appends the points around which there are cells of the core alone. 10 ns each.
    void append_interior_points(std::vector<Vec3>& points) const;
    /// Appends all cells of the core. Points of the boundary are numbered from `first_boundary`, those inside, in the
    /// order of append_interior_points(), from `first_interior`. Throws Error(memory) if a number does not fit into 32
    /// bits. 5 to 6 ns a cell, and 10 where the memory was never touched before.
    void append_cells(std::int32_t first_boundary, std::int32_t first_interior, std::vector<Tetrahedron>& cells) const;

 private:
    void find_deep_sites(const SiteBits& kept);
    void find_boundary_sites(SiteBits kept);
    void count_cells();

    BccLattice lattice_;
    BlockIndex blocks_;
    SiteBits deep_, boundary_, free_;
    SiteNumbers interior_number_, boundary_number_;  // numbers of deep_ and boundary_
    std::int64_t cell_count_ = 0;
};

}  // namespace kerf

// Removal of an edge of a triangulation by flips, for which others around it may be removed first.
#pragma once

#include <span>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"
#include "fill/shell/inside/cavity.h"
#include "fill/shell/inside/goal.h"
#include "fill/shell/inside/ring_flips.h"

namespace kerf {

/// Removes edges by flips. Afterwards the triangulation is no longer Delaunay. Flips remove no constrained face and no
/// edge that is to be kept. Exact, deterministic.
class NestedEdgeRemoval {
 public:
    /// The limits of removals, and their goal.
    struct Limits {
        Goal goal;
        int depth = 0;  ///< depth to which edges are removed to remove others
        int rings = 0;  ///< number of rings that may be looked at until the next begin()
        NewVertices new_vertices = NewVertices::none;
    };

    NestedEdgeRemoval(SpatialTriangulation& triangulation, IsKept is_kept)
        : t_(triangulation), is_kept_(std::move(is_kept)) {}

    /// Sets the limits of all removals until the next call.
    void begin(const Limits& limits) { limits_ = limits; }
    /// Returns whether Limits::rings is used up.
    bool is_exhausted() const { return limits_.rings <= 0; }

    /// Removes an edge of a cell: all cells of its ring at once if that is possible (see remove_ring_edge()); else its
    /// ring is made smaller until it is. A ring gets smaller by a flip of one of the faces at the edge; or, where edges
    /// of the ring are reflex, so that none of them can be flipped, by the removal of an edge that leads from there to
    /// an end of the edge, by the same means (Si 2015, si2015). Such removals leave the cells of the edges for which
    /// they are done as they are. Returns false if the edge is still there. Even then its ring may be smaller than
    /// before, see has_changed().
    bool remove(CellId cell, std::int32_t a, std::int32_t b);
    /// Returns whether the last removal has changed any cell.
    bool has_changed() const { return has_changed_; }

 private:
    bool remove(CellId cell, const UndirectedEdge& edge, std::span<const std::int32_t> kept);
    bool remove_at_once(const EdgeRing& ring, std::span<const std::int32_t> kept);
    bool flip_face(const EdgeRing& ring);
    bool remove_reflex_edge(EdgeRing& ring);
    std::int32_t reflex_end(const EdgeRing& ring, std::size_t k) const;
    bool is_at_ring_above(const EdgeRing& ring, std::size_t k) const;
    bool overlaps_rings_above(const EdgeRing& ring) const;
    CellId cell_with(const UndirectedEdge& edge, const EdgeRing& before);

    SpatialTriangulation& t_;
    IsKept is_kept_;
    Limits limits_;
    std::vector<UndirectedEdge> above_;  // edges for which others are removed, the outermost first
    std::vector<CellId> star_;
    bool has_changed_ = false;
};

}  // namespace kerf

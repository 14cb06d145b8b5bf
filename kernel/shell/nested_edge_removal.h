// An edge of a triangulation is removed by flips, of which others around it make way for the last one.
#pragma once

#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "shell/cavity.h"
#include "shell/goal.h"
#include "shell/ring_flips.h"

namespace kerf {

/// Flips leave the triangulation no longer Delaunay. They remove no constrained face and no edge that is to be kept.
/// Exact, deterministic.
class NestedEdgeRemoval {
 public:
    /// How far to go, and for what.
    struct Limits {
        Goal goal;
        int depth = 0;  ///< how deep edges are removed to remove others
        int rings = 0;  ///< how many rings may be looked at until the next begin()
        NewVertices new_vertices = NewVertices::none;
    };

    NestedEdgeRemoval(Triangulation& triangulation, IsKept is_kept) : t_(triangulation), is_kept_(std::move(is_kept)) {}

    /// What holds for the removals from now on.
    void begin(const Limits& limits) { limits_ = limits; }
    /// None is left of those of the limits.
    bool is_exhausted() const { return limits_.rings <= 0; }

    /// Removes an edge of a cell: all cells of its ring at once if that is possible (see remove_ring_edge); else its
    /// ring is made smaller until it is. What makes it smaller is a flip of one of the faces at the edge, or where
    /// edges of the ring are reflex, so that none of them can be flipped, the removal of one that leads from there to
    /// an end of the edge, by the same means (si2015). Such removals leave the cells of the edges for which they
    /// are done as they are. False if the edge is still there. Even then its ring may be smaller than before, see
    /// has_changed().
    bool remove(std::int32_t cell, std::int32_t a, std::int32_t b);
    /// Whether anything has changed in the last removal.
    bool has_changed() const { return has_changed_; }

 private:
    bool remove(std::int32_t cell, const UndirectedEdge& edge, std::span<const std::int32_t> kept);
    bool remove_at_once(const EdgeRing& ring, std::span<const std::int32_t> kept);
    bool flip_face(const EdgeRing& ring);
    bool remove_reflex_edge(EdgeRing& ring);
    std::int32_t reflex_end(const EdgeRing& ring, std::size_t k) const;
    bool is_at_ring_above(const EdgeRing& ring, std::size_t k) const;
    bool overlaps_rings_above(const EdgeRing& ring) const;
    std::int32_t cell_with(const UndirectedEdge& edge, const EdgeRing& before);

    Triangulation& t_;
    IsKept is_kept_;
    Limits limits_;
    std::vector<UndirectedEdge> above_;  // those for which the others are removed
    std::vector<std::int32_t> star_;
    bool has_changed_ = false;
};

}  // namespace kerf

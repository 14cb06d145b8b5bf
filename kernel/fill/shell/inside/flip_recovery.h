// Edges and triangles that a triangulation lacks, made by flips that remove all that is in their way.
#pragma once

#include <random>

#include "fill/delaunay/spatial_triangulation.h"
#include "fill/shell/inside/cavity.h"
#include "fill/shell/inside/crossing.h"
#include "fill/shell/inside/nested_edge_removal.h"

namespace kerf {

/// The limits of flips that make an edge or a triangle.
struct FlipLimits {
    /// Depth to which other edges are removed first, to remove an edge.
    int depth = 0;
    /// Whether all that an edge crosses may be removed, not only the face or edge next to an end.
    bool is_anywhere = false;
    NewVertices new_vertices = NewVertices::none;  ///< whether vertices may be added where there are no positive cells
};

/// Recovers edges and triangles by flips. Afterwards the triangulation is no longer Delaunay. Flips remove no
/// constrained face and no edge that is to be kept. Exact, deterministic.
class FlipRecovery {
 public:
    FlipRecovery(SpatialTriangulation& triangulation, const IsKept& is_kept)
        : t_(triangulation), is_kept_(is_kept), removal_(triangulation, is_kept) {}

    /// Makes an edge. Returns false if it is still not there. A face that the edge crosses is flipped; one that cannot
    /// be, because one of its edges is reflex, goes with that edge (Si 2015, si2015).
    bool recover_edge(std::int32_t a, std::int32_t b, const FlipLimits& limits);
    /// Makes a triangle whose edges are there, by removing edges that go through it. Returns false if it is still not
    /// there.
    bool recover_face(const Triangle& triangle, const FlipLimits& limits);
    /// Inserts a vertex near p, behind a triangle: it takes away long cells that are in the way, not many more than
    /// `most_removed`. Returns false if none of a few places is free.
    bool insert_behind(const Triangle& triangle, const Vec3& p, std::size_t most_removed);

 private:
    bool clear(const Crossing& crossing);
    bool clear_anywhere(std::int32_t a, std::int32_t b);
    bool clear_face(const Triangle& triangle);
    double some_share();

    SpatialTriangulation& t_;
    IsKept is_kept_;
    NestedEdgeRemoval removal_;
    std::minstd_rand random_;
};

}  // namespace kerf

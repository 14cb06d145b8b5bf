// Edges and triangles that a triangulation lacks, made by flips of the cells in their way.
#pragma once

#include <random>
#include <span>

#include "delaunay/triangulation.h"
#include "shell/crossing.h"
#include "shell/missing_triangles.h"
#include "shell/ring_flips.h"

namespace kerf {

/// What flips may do to make a triangle.
struct FlipLimits {
    int depth = 0;  ///< to remove an edge, others around it are removed first, and others around these: how deep
    NewVertices new_vertices = NewVertices::none;  ///< whether vertices may be added beside triangles, on either side
    bool keeps_edges = false;                      ///< whether edges of missing triangles must stay
};

/// Flips leave the triangulation no longer Delaunay. They remove no constrained face. Deterministic.
class FlipRecovery {
 public:
    FlipRecovery(Triangulation& triangulation, const MissingTriangles& missing)
        : t_(triangulation), missing_(missing) {}

    /// Makes the edges of a triangle, and then the triangle, and constrains it. False if it is still not there, though
    /// some of its edges may be. Some 50 us.
    bool recover(const Triangle& triangle, const FlipLimits& limits);
    /// Makes an edge. False if it is still not there.
    bool recover_edge(std::int32_t a, std::int32_t b, const FlipLimits& limits) {
        limits_ = limits;
        return recover_edge(a, b);
    }

 private:
    bool insert_behind(const Triangle& triangle, const Vec3& p);
    double some_share();
    bool recover_edge(std::int32_t a, std::int32_t b);
    bool clear(const Crossing& crossing, std::int32_t a, std::int32_t b);
    bool clear_edge(std::int32_t cell, std::int32_t c, std::int32_t d, std::int32_t a, std::int32_t b);
    bool loosen(const Crossing& crossing);
    bool is_shared_by_crossed_faces(CellFace face, std::int32_t p, std::int32_t q, std::int32_t a,
                                    std::int32_t b) const;
    void recover_face(const Triangle& triangle);
    bool clear_face(const Triangle& triangle);
    bool remove_edge(const EdgeRing& ring, std::span<const std::int32_t> kept, int depth);
    bool remove_ring(const EdgeRing& ring, std::span<const std::int32_t> kept,
                     NewVertices new_vertices = NewVertices::none);
    std::int32_t cell_with_edge(std::int32_t c, std::int32_t d);

    Triangulation& t_;
    const MissingTriangles& missing_;
    FlipLimits limits_;
    int rings_left_ = 0, vertices_left_ = 0;
    std::minstd_rand random_;
};

}  // namespace kerf

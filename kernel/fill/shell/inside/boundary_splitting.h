// Splits of boundary triangles that no flip can make: the boundary gets vertices, and gives them back.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "fill/delaunay/spatial_triangulation.h"
#include "fill/shell/inside/cavity.h"
#include "fill/shell/inside/crossing.h"
#include "fill/shell/inside/missing_triangles.h"

namespace kerf {

/// Splits missing triangles at new vertices that lie inside, next to them.
///
/// A triangle of the boundary that cannot be made a face is replaced by others that can: they have a new vertex in the
/// middle, or on an edge, and then both triangles of that edge are replaced. The vertex does not lie on the triangle,
/// but behind it, so that between the triangle and the others there is a cell, the cap. The body is the space that the
/// others enclose, and the caps; its boundary is unchanged. No coordinate is rounded to a plane, and no point is added
/// to the boundary that would have to be taken away again (as in George, Borouchaki and Saltel 2003, george2003).
///
/// The new vertex lies behind the point at which a face of a cell crosses the edge, or an edge of a cell the triangle.
/// Its height is such that the parts of a triangle form a dome: it is proportional to the power of the point to the
/// triangle's circle, so that the highest of all surfaces over these vertices is the Delaunay triangulation of the
/// parts in their plane. The parts are kept so by flips, each of which adds a cap; else parts would become longer and
/// thinner with each split. On an edge the domes of both triangles are equally high. The method is not complete: where
/// needles of different planes lie close together, splits may have no end, see most_parts_of_a_triangle in
/// face_recovery.cpp.
class BoundarySplitting {
 public:
    /// Takes the triangles `given`, of which missing ones are parts. `offset` is the slope of the dome at the ends of
    /// the longest edge: in (0, 1). The smaller it is, the nearer another part of the boundary may be.
    BoundarySplitting(SpatialTriangulation& triangulation, const std::vector<Triangle>& given,
                      MissingTriangles& missing, double offset)
        : t_(triangulation),
          given_(given),
          missing_(missing),
          is_kept_([this](std::int32_t a, std::int32_t b) { return missing_.has_edge(a, b); }),
          offset_(offset) {}

    /// Replaces the missing triangles with this edge, which the triangulation lacks, by two each. Returns false, and
    /// nothing has changed, where there is no place for the vertex because another part of the boundary is in the way.
    bool split_edge(std::int32_t a, std::int32_t b);
    /// Replaces a missing triangle, whose edges are there, by three. Returns false as split_edge() does.
    bool split_triangle(std::int32_t number);

    /// Returns the positive cells between the triangles and those that replaced them.
    const std::vector<Tetrahedron>& caps() const { return caps_; }

 private:
    struct Place {
        std::vector<CellId> cavity;          // cells around the face or edge that is in the way
        bool is_anywhere = false;            // whether these cells may also stay
        Vec3 foot = Vec3::Zero();            // point of the given triangle behind which the vertex lies
        Vec3 inwards = Vec3::Zero();         // direction from the foot to the vertex, of unit length
        double rise = 0;                     // distance of the vertex from the foot
        std::vector<Triangle> triangles;     // triangles behind which the vertex must lie
        std::vector<UndirectedEdge> around;  // their edges, but for the one that is split
    };

    // Finds the place for a vertex where the line from a to b crosses something that may be removed, and returns the
    // share of the line before it, in (0, 1); nothing where it may not.
    std::optional<double> find_place(const Crossing& crossing, std::int32_t a, std::int32_t b, Place& place) const;
    bool split_edge_at(std::int32_t a, std::int32_t b, Place& place, double share);
    std::vector<CellId> cavity_of_edge(CellId cell, std::int32_t p, std::int32_t q) const;
    std::optional<std::int32_t> insert(const Place& place);
    bool is_behind(const Vec3& p, const Triangle& triangle) const;
    template <class Accepts>
    std::optional<std::int32_t> insert_if(const Vec3& p, const Place& place, const Accepts& accepts);
    std::optional<std::int32_t> insert_alone(const Vec3& p, const Place& place);
    bool grow(std::vector<CellId>& cavity, const Vec3& p) const;
    double distance_to_next(const Place& place) const;
    void replace(std::int32_t number, std::int32_t vertex, const std::vector<Triangle>& by);

    static Triangle turned(Triangle given, const Triangle& neighbour);
    const Vec3& foot(std::int32_t vertex) const;
    Vec3 inward_normal(std::int32_t origin) const;
    double height(std::int32_t origin, const Vec3& p);
    void flip_parts();
    void flip_part(std::int32_t number, int i);
    const Vec3& point(std::int32_t vertex) const { return t_.points()[vertex]; }

    SpatialTriangulation& t_;
    const std::vector<Triangle>& given_;
    MissingTriangles& missing_;
    IsKept is_kept_;
    double offset_, curvature_ = 0;      // curvature of all domes, 1/length; 0 before the first split
    std::map<std::int32_t, Vec3> feet_;  // feet of the vertices that were added
    std::vector<std::int32_t> fresh_;    // numbers of missing triangles whose edges may have to be flipped
    std::vector<Tetrahedron> caps_;
};

}  // namespace kerf

// Where no flip helps, the boundary gets vertices, and gives them back.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "delaunay/triangulation.h"
#include "shell/cavity.h"
#include "shell/crossing.h"
#include "shell/missing_triangles.h"

namespace kerf {

/// Splits missing triangles at new vertices that lie inside, next to them.
///
/// A triangle of the boundary that cannot be made a face is replaced by others, which can: they have a new vertex in
/// the middle, or on an edge, and then both triangles of that edge are. It does not lie on the triangle, but behind it,
/// so that between the triangle and the others there is a cell, the cap. The body is what the others enclose, and the
/// caps; its boundary is what it was. No coordinate is rounded to a plane, and no point is added to the boundary, which
/// others would have to take away again (as george2003 has it).
///
/// The new vertex lies where a face of a cell crosses the edge, or an edge of a cell the triangle. How far behind: the
/// parts of a triangle form a dome, as high as the power of a point to the triangle's circle wants it, so that what is
/// highest is the Delaunay triangulation of the parts in their plane. They are kept so by flips, each of which adds a
/// cap; else parts would become longer and thinner with each split. On an edge both triangles' domes are equally high.
/// It is not complete: where needles of different planes lie close together, there may be no end, see most_parts in
/// face_recovery.cpp.
class BoundarySplitting {
 public:
    /// `given` are the triangles of which missing ones are parts. `offset` is the slope of the longest one's dome at
    /// its ends: in (0, 1). The smaller it is, the nearer another part of the boundary may be.
    BoundarySplitting(Triangulation& triangulation, const std::vector<Triangle>& given, MissingTriangles& missing,
                      double offset)
        : t_(triangulation),
          given_(given),
          missing_(missing),
          is_kept_([this](std::int32_t a, std::int32_t b) { return missing_.has_edge(a, b); }),
          offset_(offset) {}

    /// Replaces the missing triangles with this edge, which the triangulation lacks, by two each. False, and nothing
    /// has changed, where there is no place for the vertex: something else of the boundary is in the way.
    bool split_edge(std::int32_t a, std::int32_t b);
    /// Replaces a missing triangle, whose edges are there, by three. False as above.
    bool split_triangle(std::int32_t number);

    /// Positive cells between the triangles and what they were replaced by.
    const std::vector<Tetrahedron>& caps() const { return caps_; }

 private:
    struct Place {
        std::vector<std::int32_t> cavity;    // cells around what is in the way
        bool is_anywhere = false;            // the cells may also stay
        Vec3 foot = Vec3::Zero();            // the point of the given triangle next to which it lies
        Vec3 inwards = Vec3::Zero();         // unit length
        double rise = 0;                     // how far from the foot
        std::vector<Triangle> triangles;     // that it must lie behind
        std::vector<UndirectedEdge> around;  // their edges, but for the one that is split
    };

    // Where the line from a to b crosses something that may be removed, how far it is there: in (0, 1).
    std::optional<double> find_place(const Crossing& crossing, std::int32_t a, std::int32_t b, Place& place) const;
    bool split_edge_at(std::int32_t a, std::int32_t b, Place& place, double share);
    std::vector<std::int32_t> cavity_of_edge(std::int32_t cell, std::int32_t p, std::int32_t q) const;
    std::optional<std::int32_t> insert(const Place& place);
    bool is_behind(const Vec3& p, const Triangle& triangle) const;
    template <class Accepts>
    std::optional<std::int32_t> insert_if(const Vec3& p, const Place& place, const Accepts& accepts);
    std::optional<std::int32_t> insert_alone(const Vec3& p, const Place& place);
    bool grow(std::vector<std::int32_t>& cavity, const Vec3& p) const;
    double distance_to_next(const Place& place) const;
    void replace(std::int32_t number, std::int32_t vertex, const std::vector<Triangle>& by);

    static Triangle turned(Triangle given, const Triangle& neighbour);
    const Vec3& foot(std::int32_t vertex) const;
    Vec3 inward_normal(std::int32_t origin) const;
    double height(std::int32_t origin, const Vec3& p);
    void flip_parts();
    void flip_part(std::int32_t number, int i);
    const Vec3& point(std::int32_t vertex) const { return t_.points()[vertex]; }

    Triangulation& t_;
    const std::vector<Triangle>& given_;
    MissingTriangles& missing_;
    IsKept is_kept_;
    double offset_, curvature_ = 0;      // of all domes, 1/length; 0 before the first split
    std::map<std::int32_t, Vec3> feet_;  // of the vertices that were added
    std::vector<std::int32_t> fresh_;    // numbers of missing triangles whose edges may have to be flipped
    std::vector<Tetrahedron> caps_;
};

}  // namespace kerf

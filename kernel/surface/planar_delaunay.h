// Constrained Delaunay triangulations in the plane.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/types.h"

namespace kerf {

/// A triangulation of all points that were inserted, with edges that stay. Points have numbers, from 0 on as they come;
/// where one comes again, all its numbers mean the first. Each triangle is inside or outside of what the edges enclose.
/// By CGAL, with exact predicates; deterministic.
class PlanarDelaunay {
 public:
    /// A triangle, counter-clockwise, and where it is found; good until something is inserted.
    struct Face {
        Triangle corners;
        void* handle;
    };
    /// A place for a point, good until something is inserted.
    struct Place {
        void* face;
        int type, index;
    };
    /// Of a triangle, counter-clockwise.
    struct Side {
        std::int32_t from, to;
        bool is_edge;  ///< it was inserted, and stays
    };

    PlanarDelaunay();
    PlanarDelaunay(const PlanarDelaunay&) = delete;
    PlanarDelaunay& operator=(const PlanarDelaunay&) = delete;
    ~PlanarDelaunay();

    /// Returns the number. Takes long far from the point before.
    std::int32_t insert(const Vec2& point);
    /// False if it crosses an edge. Vertices on it divide it; one of a single place is none.
    bool insert_edge(std::int32_t from, std::int32_t to);
    /// The first number of this point.
    std::int32_t first_number(std::int32_t number) const;
    /// Whether there are triangles: not all points lie on a line.
    bool has_triangles() const;

    /// Inside is where an odd number of edges has to be crossed from far away.
    void mark_by_parity();
    /// Inside is where an edge has to be crossed from far away.
    void mark_enclosed();
    /// What can be reached from the point without crossing an edge becomes outside. False if it lies on an edge or at a
    /// vertex, and nothing is done.
    bool mark_hole(const Vec2& point);

    /// Those inside.
    std::vector<Triangle> triangles() const;
    /// Those inside around a point that is no end of an edge.
    std::vector<Triangle> triangles_around(std::int32_t number) const;
    /// The triangle of three points if there is one.
    std::optional<Face> find(const Triangle& corners) const;
    /// Whether there is such an edge, with the inside on its left alone.
    bool has_border(std::int32_t from, std::int32_t to) const;

    /// Where a point would be inserted inside, neither at a vertex nor on an edge. Begins at a face, or anywhere.
    std::optional<Place> find_place(const Vec2& point, const Face* start) const;
    /// Of all triangles that have no room for the point.
    void find_cavity(const Vec2& point, const Place& place, std::vector<Side>& sides) const;
    /// Returns the number. Triangles around are inside.
    std::int32_t insert(const Vec2& point, const Place& place);

 private:
    struct Cdt;
    std::unique_ptr<Cdt> cdt_;
};

/// As its rounding has it in this order of the corners.
Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether segments meet, exactly.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Whether two segments from one end to others lie on each other, exactly.
bool segments_overlap(const Vec2& end, const Vec2& a, const Vec2& b);

/// 1 if the points are counter-clockwise, 0 if they lie on a line, exactly.
int planar_orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace kerf

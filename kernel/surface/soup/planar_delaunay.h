// A constrained Delaunay triangulation in the plane.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// The constrained Delaunay triangulation of all points and edges that were inserted. Points are numbered from 0 on as
/// they come; if a point comes again, all its numbers mean the first. Each triangle is inside or outside of the area
/// that the edges enclose. By CGAL, with exact predicates; deterministic.
class PlanarDelaunay {
 public:
    /// A triangle, counter-clockwise, with its handle in the triangulation; valid until the next insertion.
    struct Face {
        Triangle corners;
        void* handle;
    };
    /// A place to insert a point at; valid until the next insertion.
    struct Place {
        void* face;
        int type, index;
    };
    /// A side of a triangle, counter-clockwise.
    struct Side {
        std::int32_t from, to;
        bool is_edge;  ///< an inserted edge, which stays
    };

    PlanarDelaunay();
    PlanarDelaunay(const PlanarDelaunay&) = delete;
    PlanarDelaunay& operator=(const PlanarDelaunay&) = delete;
    ~PlanarDelaunay();

    /// Inserts a point and returns its number. Slow if the point is far from the one before.
    std::int32_t insert(const Vec2& point);
    /// Inserts an edge; false if it would cross another one. Vertices on the edge divide it; an edge from a point to
    /// itself is none.
    bool insert_edge(std::int32_t from, std::int32_t to);
    /// Returns the first number that was given to the point.
    std::int32_t first_number(std::int32_t number) const;
    /// Whether there are triangles: the points do not all lie on one line.
    bool has_triangles() const;

    /// Marks as inside the triangles that an odd number of edges separates from infinity.
    void mark_by_parity();
    /// Marks as inside the triangles that some edge separates from infinity.
    void mark_enclosed();
    /// Marks as outside all triangles that can be reached from the point without crossing an edge. Does nothing and
    /// returns false if the point lies on an edge or at a vertex.
    bool mark_hole(const Vec2& point);

    /// Returns the triangles inside.
    std::vector<Triangle> triangles() const;
    /// Returns the triangles inside around a point that is no end of an edge.
    std::vector<Triangle> triangles_around(std::int32_t number) const;
    /// Returns the triangle of three points if there is one.
    std::optional<Face> find(const Triangle& corners) const;
    /// Whether there is such an edge with the inside on its left, but not on its right.
    bool has_border(std::int32_t from, std::int32_t to) const;

    /// Returns the place of a point that lies inside, neither at a vertex nor on an edge. The search starts at a face,
    /// or anywhere if null.
    std::optional<Place> find_place(const Vec2& point, const Face* start) const;
    /// Sets `sides` to the sides of all triangles that would vanish with the point's insertion: their circumcircles
    /// contain it.
    void find_cavity(const Vec2& point, const Place& place, std::vector<Side>& sides) const;
    /// Inserts a point at a place and returns its number. The triangles around it become inside.
    std::int32_t insert(const Vec2& point, const Place& place);

 private:
    struct Cdt;
    std::unique_ptr<Cdt> cdt_;
};

/// Returns the circumcentre, whose rounding depends on the order of the corners.
Vec2 circumcentre(const Vec2& a, const Vec2& b, const Vec2& c);

/// Whether two segments meet, exactly.
bool segments_meet(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d);

/// Whether two segments from a common end lie on each other, exactly.
bool segments_overlap(const Vec2& end, const Vec2& a, const Vec2& b);

/// Returns 1 if the points are counter-clockwise, 0 if they lie on a line, -1 if they are clockwise; exact.
int planar_orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace kerf

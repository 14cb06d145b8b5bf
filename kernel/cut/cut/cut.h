// A record of one bisection of a closed surface, as plain data: the viewer draws it, the report counts it, tests check
// it. Method: a-priori domain decomposition (Ivanov, Andrä and Kudryavtsev 2006, ivanov2006); the contour by minimum
// cut and the local repair are Kerf's own.
#pragma once

#include <string>
#include <vector>

#include "base/core/hash.h"
#include "surface/complex/surface.h"

namespace kerf {

/// The cutting plane with its own coordinates. u, v and normal are orthonormal and right-handed.
struct Plane {
    Vec3 origin = Vec3::Zero();  ///< a point on the plane
    Vec3 normal = Vec3::UnitX();
    Vec3 u = Vec3::UnitY();
    Vec3 v = Vec3::UnitZ();

    Plane() = default;
    Plane(const Vec3& point, const Vec3& unit_normal);
    /// Whether u, v and normal are orthonormal, up to 1e-6.
    bool is_orthonormal() const;
    /// The signed distance of a point: negative below the plane, positive above.
    double distance(const Vec3& p) const { return normal.dot(p - origin); }
    Vec2 project(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
    Vec3 lift(const Vec2& q, double height) const { return origin + q.x() * u + q.y() * v + height * normal; }
    Plane shifted(double distance) const;

    template <class Archive>
    void archive(Archive& a) {
        a(origin, normal, u, v);
    }
};

/// The half that a facet belongs to. `below` becomes child 2i of node i, `above` child 2i + 1.
enum class Side : std::uint8_t { below = 0, above = 1 };
constexpr Side other(Side side) { return side == Side::below ? Side::above : Side::below; }

/// The method by which a contour is found on the surface.
enum class ContourMethod {
    min_cut,   ///< minimum cut of the facet graph in a band around the plane
    edges,     ///< majority of the facet's vertices (ivanov2006)
    straight,  ///< facets are split at a coordinate plane
};

const char* name(ContourMethod method);

/// The strategy by which a cut was accepted, in the order in which they are tried.
enum class CutStrategy {
    first_try,     ///< first plane, first contour
    local_repair,  ///< first plane; the weights at the failed places were raised
    plane_step,    ///< the plane was moved along the first axis
    other_axis,    ///< another principal axis
    soft,          ///< valid, but below a quality threshold; the best of all tries
    straight,      ///< the facets were split at a coordinate plane
    whole,         ///< no cut: the part stays whole
};
const char* name(CutStrategy strategy);

/// The reason why a try was refused.
enum class Refusal {
    none,                 ///< accepted
    empty_side,           ///< all facets fell on one side
    flow_limit,           ///< the minimum cut was not found within its bound of steps
    pinched_contour,      ///< a vertex of more than two contour edges, or at which the surface touches itself
    crossing_projection,  ///< contour edges cross or touch in the plane
    nesting,              ///< the section is not on the left of every contour edge
    chord,                ///< an interface edge coincides with a surface edge off the contour
    intersection,         ///< interface and surface meet off the contour
    not_manifold,         ///< a half is not a closed 2-manifold
    misplaced_shell,      ///< a shell without contour lies in the wrong half
    coincident_vertices,  ///< in a straight cut: a vertex on the plane, or two new ones in one place
    soft,                 ///< valid, but an angle or gap is below its threshold
};
const char* name(Refusal refusal);

/// The smallest measures of an interface; the thresholds of a good cut are in CutOptions.
struct InterfaceQuality {
    double dihedral_deg = 180;  ///< smallest angle between interface and surface along the contour
    double angle_deg = 180;     ///< smallest angle of an interface triangle
    double gap_rel = 1;  ///< smallest distance between interface and surface off the contour, per local edge length

    template <class Archive>
    void archive(Archive& a) {
        a(dihedral_deg, angle_deg, gap_rel);
    }
};

/// An edge of the parent surface by its vertices; a contour edge has the half below on its left.
using SurfaceEdge = std::array<Vertex, 2>;

/// Two triangles that meet off their common corners.
struct Collision {
    std::array<Vec3, 3> first;   ///< a triangle of the interface; in a straight cut: a piece of a split facet
    std::array<Vec3, 3> second;  ///< a facet of the surface, or another triangle like `first`

    template <class Archive>
    void archive(Archive& a) {
        for (std::size_t i = 0; i < 3; ++i) a(first[i], second[i]);
    }
};
inline constexpr std::size_t max_collisions = 1000;  ///< most collisions kept of a try

/// One attempt: a plane, a round of local repair, and the outcome.
struct CutTry {
    Plane plane;
    ContourMethod method = ContourMethod::min_cut;  ///< method by which the contour was sought
    std::int32_t axis = 0;    ///< rank of the direction, 0 is tried first; in a straight cut: coordinate axis
    std::int32_t step = 0;    ///< step along the axis, 0 at the load's bisection; in a straight cut: rank of the plane
    std::int32_t repair = 0;  ///< round of local repair
    Refusal refusal = Refusal::none;
    std::vector<Vec3> places;           ///< positions at which the try failed
    std::vector<Collision> collisions;  ///< the first ones, if refused for an intersection; empty without a listener,
                                        ///< but for one in a straight cut
    std::vector<SurfaceEdge> contour;   ///< pinched contours, too; empty without a listener
    InterfaceQuality quality;           ///< meaningful if refusal is none or soft

    template <class Archive>
    void archive(Archive& a) {
        a(plane, method, axis, step, repair, refusal, places, collisions, contour, quality);
    }
};

/// The contour at each stage of its making. Recorded for the accepted try, and only on request.
struct ContourStages {
    std::vector<SurfaceEdge> crossed_edges;           ///< edges with ends on both sides of the plane
    std::vector<SurfaceEdge> hanging_edges_removed;   ///< boundary of the majority labels: closed, nothing hangs
    std::vector<SurfaceEdge> closed_loops;            ///< ears and islands removed
    std::vector<SurfaceEdge> multiple_paths_removed;  ///< vertices with more than two contour edges opened
    std::vector<SurfaceEdge> smoothed;                ///< the contour that was used

    template <class Archive>
    void archive(Archive& a) {
        a(crossed_edges, hanging_edges_removed, closed_loops, multiple_paths_removed, smoothed);
    }
};

/// The triangulation of the section inside of the contour, in the plane and lifted to meet the surface.
struct Interface {
    std::vector<Vertex> contour;      ///< #C; vertex of the parent surface of each contour vertex
    std::vector<Vec2> planar;         ///< #P; contour vertices first; coordinates in the plane during the
                                      ///< triangulation
    std::vector<Vec3> points;         ///< #P; contour vertices are at their place on the surface
    std::vector<Triangle> triangles;  ///< indices into `planar`; counter-clockwise seen from above

    template <class Archive>
    void archive(Archive& a) {
        a(contour, planar, points, triangles);
    }
};

/// The place of the first plane of a cut.
struct CutPlace {
    double fraction = 0.5;  ///< share of the load below the plane
    std::int32_t axis = 0;  ///< rank of the direction in the order of preference of the criterion
    double section_gain =
        0;  ///< share of the section's area that is saved against axis 0 and half of the leaves; estimate

    template <class Archive>
    void archive(Archive& a) {
        a(fraction, axis, section_gain);
    }
};

/// The record of one bisection.
struct Cut {
    NodeId node = root_node;
    CutStrategy strategy = CutStrategy::whole;
    ContourMethod method = ContourMethod::min_cut;
    Plane plane;
    std::vector<CutTry> tries;               ///< all tries, the accepted one included
    std::vector<std::vector<Vertex>> loops;  ///< closed contours as parent vertices; the half below is on the
                                             ///< left
    Array<Facet, Side> side;                 ///< per facet of the parent; empty without a listener
    ContourStages stages;                    ///< empty without a listener
    SurfaceArrays split_parent;              ///< in a straight cut with a listener: the parent, its facets split
    Interface interface;
    InterfaceQuality quality;
    std::int64_t contour_edges = 0;
    double contour_length = 0;
    double max_deviation = 0;   ///< largest distance of a contour vertex from the plane
    CutPlace place;             ///< place of the first plane
    double section_area = 0;    ///< area of the section of the surface with the plane
    double interface_area = 0;  ///< area of the lifted interface
    double seconds = 0;         ///< wall clock; goes into the report only
    FileHash hash = {0, 0};     ///< of all data that determine the halves, bit for bit; {0, 0}: no cut, or read from a
                                ///< trace

    bool made() const { return strategy != CutStrategy::whole; }
    template <class Archive>
    void archive(Archive& a) {
        a(node, strategy, method, plane, tries, loops, side, stages, split_parent, place, interface, quality,
          contour_edges, contour_length, max_deviation, section_area, interface_area, seconds);
    }
};

/// The numbers of a cut, made or not, that the tree keeps, the report lists and the viewer compares.
struct CutSummary {
    Plane plane;
    ContourMethod method = ContourMethod::min_cut;
    CutStrategy strategy = CutStrategy::whole;
    std::int32_t tries = 0;
    std::int32_t loops = 0;
    std::int64_t contour_edges = 0;
    double contour_length = 0;
    double max_deviation = 0;  ///< as in Cut
    CutPlace place;
    double section_area = 0, interface_area = 0;
    std::int32_t interface_faces = 0;
    InterfaceQuality quality;
    double seconds = 0;  ///< wall clock; goes into the report only

    bool made() const { return strategy != CutStrategy::whole; }
    template <class Archive>
    void archive(Archive& a) {
        a(plane, method, strategy, tries, loops, contour_edges, contour_length, max_deviation, place, section_area,
          interface_area, interface_faces, quality, seconds);
    }
};
CutSummary summary_of(const Cut& cut);

/// Fills contour_edges, contour_length and max_deviation from the loops and the plane. `parent` is the surface whose
/// vertices the loops name.
void describe_contour(const Surface& parent, Cut& cut);

}  // namespace kerf

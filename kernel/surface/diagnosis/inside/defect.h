// A single defect of a triangle soup, with the numbers of its facets and vertices.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/error.h"
#include "surface/soup/soup.h"

namespace kerf {

enum class DefectKind {
    empty,                     ///< no facets
    non_finite,                ///< a coordinate is NaN or infinite
    absurd_magnitude,          ///< coordinates whose products leave the range of double precision
    unfit_polygon,             ///< a face of the file that is not planar or cannot be cut into a fan of triangles
    flat,                      ///< all vertices lie in one plane
    degenerate_facet,          ///< repeated vertex, or three collinear vertices (exact)
    duplicate_facet,           ///< same three vertices as another facet
    coincident_shell,          ///< every facet of it is there twice or more
    open_edge,                 ///< a loop or chain of edges of one facet only
    non_manifold_edge,         ///< edge of three or more facets
    non_manifold_vertex,       ///< the facets at the vertex form more than one fan
    inconsistent_orientation,  ///< facets turned against the rest of their shell
    one_sided,                 ///< a shell that no choice of orientation makes consistent
    inverted_shell,            ///< outside shell with inward normals
    ambiguous_shell,           ///< inside another shell and turned like it: a void, or a second body?
    touching_shells,           ///< a shell's vertices lie on another shell
    self_intersection,         ///< two facets meet outside of what they share
    needle,                    ///< a facet with an angle below the threshold
    short_edge,                ///< an edge near the rounding limit of its coordinates
    unlike_walls,              ///< two bodies lie upon each other with other facets on both sides
    body_overlap,              ///< two bodies overlap
    body_gap,                  ///< two bodies nearly touch
};
inline constexpr std::size_t defect_kind_count = static_cast<std::size_t>(DefectKind::body_gap) + 1;

enum class Severity {
    error,     ///< the surface cannot be meshed
    repaired,  ///< is mended without any change of the geometry before meshing
    warning,   ///< can be meshed, cells may be bad there
};

struct Defect {
    DefectKind kind;
    Severity severity;
    std::vector<std::int32_t> facets;    ///< numbers as in the soup
    std::vector<std::int32_t> vertices;  ///< numbers as in the soup; of a loop in the order of going around
    Vec3 where = Vec3::Zero();           ///< a point at the defect
    /// Length of an open loop or a short edge; a needle's angle in degrees; the largest distance between two bodies.
    double measure = 0;
    std::vector<std::string> bodies = {};  ///< the body or region that has it, or the two; empty if there is only one
};

const char* name(DefectKind kind);
const char* name(Severity severity);

/// Returns the way to mend the defect, in the imperative ("remove the copies"), or a note that repairs mend it.
const char* advice(const Defect& defect);

/// Returns the number with the name of the kind: "3 open edge loops", "1 needle".
std::string counted(std::int64_t n, DefectKind kind);

/// Whether the defect lies between two bodies, so that Defect::measure is a distance.
bool is_between_bodies(const Defect& defect);

/// Sorts by kind, then by first facet; stable.
void sort_defects(std::vector<Defect>& defects);

/// Returns the place of the defect as a phrase: "facets 3, 8, vertex 4 near (0, 0, 1)", "facets 3, 8 of 'bone' and
/// 'cement', up to 0.01 apart near (0, 0, 1)". Facets and vertices have the numbers of the file (Soup::polygon,
/// Soup::vertex_number), counted from 0.
std::string place(const Defect& defect, const Soup& soup);

/// Returns the facets of the defect, with the names of their patches, and its vertices or its edge, all with the
/// numbers that place() gives.
std::vector<ErrorElements> elements_of(const Defect& defect, const Soup& soup);

}  // namespace kerf

// Everything that keeps a triangle soup from being the boundary of a body, with the numbers of the offenders.
#pragma once

#include <string>
#include <vector>

#include "surface/soup.h"

namespace kerf {

enum class DefectKind {
    empty,                ///< no facets
    non_finite,           ///< a coordinate is NaN or infinite
    flat,                 ///< all vertices lie in one plane
    degenerate_facet,     ///< repeated vertex, or three collinear vertices (exact)
    duplicate_facet,      ///< same three vertices as another facet
    open_edge,            ///< edge of one facet only
    non_manifold_edge,    ///< edge of three or more facets
    non_manifold_vertex,  ///< the facets at the vertex form more than one fan
    self_intersection,    ///< two facets meet outside of what they share
};

const char* name(DefectKind kind);

struct Defect {
    DefectKind kind;
    std::vector<std::int32_t> facets;    ///< numbers as in the soup
    std::vector<std::int32_t> vertices;  ///< numbers as in the soup
    Vec3 where = Vec3::Zero();           ///< a point at the defect
};

/// Defects ordered by kind, then by first facet. Orientation is no defect here: orient() repairs it.
struct Diagnosis {
    std::vector<Defect> defects;
    bool clean() const { return defects.empty(); }
    std::int64_t count(DefectKind kind) const;
    /// One sentence: the most fundamental kind, how many, the first with numbers and coordinates, and what to do.
    std::string summary() const;
};

/// Finds all defects in one pass; kinds that make later checks meaningless end it (empty, non-finite). At most 1000
/// self-intersections are listed, and they are looked for only where the soup is otherwise a closed manifold.
/// Exact. O(#F log #F); 116 k facets in less than a second.
Diagnosis diagnose(const Soup& soup);

}  // namespace kerf

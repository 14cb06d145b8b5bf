// The faces of a body as triangles that are joined as the faces are in the model.
#pragma once

#include <cstdint>
#include <vector>

#include "files/cad/inside/model.h"
#include "surface/soup/soup.h"

namespace kerf::cad {

struct TessellationSettings {
    double deflection;  ///< largest distance of a chord from its curve; millimetres
    double angle;       ///< largest angle between neighbouring chords; radians
};

struct Tessellation {
    std::vector<Vec3> vertices;  ///< millimetres
    std::vector<Triangle> facets;
    std::vector<std::int32_t> patch;         ///< #F; index into Model::patches
    std::vector<Vec3> plane;                 ///< #F; normal of the face if that is planar, else 0
    std::vector<double> rise;                ///< #F; mean height of the face over the facet, outwards; millimetres
    std::vector<FacetSides> sides;           ///< #F; empty: one body, behind all facets
    std::vector<ModelEdge> edges;            ///< bounds of patches and creases, each of them an edge of facets
    std::vector<std::int32_t> failed_faces;  ///< patches of faces that got no triangles
    /// Patches of faces in which a vertex of another region lies that none of their facets has.
    std::vector<std::int32_t> pierced_patches;
    std::vector<std::int32_t> open_patches;  ///< patches with an edge that is not used once each way, ascending
    double volume = 0;                       ///< volume inside; right if the facets are closed
};

/// Returns the triangles of all faces, as BRepMesh makes them, which are closed if the model is and no face fails.
/// Needles are plenty. The body's own triangulation is replaced. Deterministic.
///
/// `sides`: for a body of several regions, the sides of each patch; the facets get them as Tessellation::sides, and the
/// result has no `volume` and no `open_patches`.
Tessellation tessellate(const Body& body, const TessellationSettings& settings,
                        const std::vector<FacetSides>& sides = {});

/// Returns the signed volume inside of the facets.
double enclosed_volume(const Tessellation& mesh);

/// Returns the number of facets of the patch that has most of them.
std::int32_t most_facets_of_patch(const Tessellation& mesh);

/// Marks in the shape of the body each edge whose faces are tangent there, to within a degree.
void find_smooth_edges(const Body& body);

}  // namespace kerf::cad

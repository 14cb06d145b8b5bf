// Makes bodies of the content of a CAD file: sewing, dividing, uniting. Patches survive all of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/core/types.h"
#include "files/cad/inside/model.h"

namespace kerf::cad {

/// Edges that bound one face only.
struct FreeEdges {
    std::int32_t count = 0;
    std::vector<std::int32_t> patches;  ///< patches of their faces, ascending
    Vec3 where = Vec3::Zero();          ///< an end of the first; millimetres
};
FreeEdges find_free_edges(const Body& body);

/// Joins the faces along edges that lie within a tolerance, the smallest of some shares of the diagonal, 1e-6 to 3e-4,
/// that closes the body. Returns that share, or nothing if none does; then the body stays as it is, and `free` has the
/// edges that the best of them left open, if these are fewer.
std::optional<double> sew(Body& body, FreeEdges& free);

/// Cuts faces that are closed in themselves, as full cones are. Returns false if there are none.
bool divide_closed_faces(Body& body);

/// Returns one body made of several that touch or overlap. Nothing if OpenCASCADE fails.
std::optional<Body> unite(const std::vector<Body>& bodies);

/// Returns the diagonal of the bounding box of the true, curved shape, in millimetres; 0: empty.
double diagonal_of(const TopoDS_Shape& shape);

}  // namespace kerf::cad

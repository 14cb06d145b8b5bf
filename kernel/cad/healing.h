// What makes bodies of what a CAD file says: sewing, dividing, uniting. Patches survive all of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cad/model.h"
#include "core/types.h"

namespace kerf::cad {

/// Edges that bound one face only.
struct FreeEdges {
    std::int32_t count = 0;
    std::vector<std::int32_t> patches;  ///< of their faces, ascending
    Vec3 where = Vec3::Zero();          ///< an end of the first; millimetres
};
FreeEdges find_free_edges(const Body& body);

/// Joins the faces along edges that lie within a tolerance, the smallest that closes the body: from 1e-6 to 3e-4 of the
/// diagonal. Returns that share, or nothing if none does; then the body stays as it is, and `free` is what the best of
/// them left open, if that is less.
std::optional<double> sew(Body& body, FreeEdges& free);

/// Cuts faces that are closed in themselves, as full cones are. False if there are none.
bool divide_closed_faces(Body& body);

/// One body of several that touch or overlap. Nothing if OpenCASCADE fails.
std::optional<Body> unite(const std::vector<Body>& bodies);

/// The diagonal of the bounding box of the true, curved shape, in millimetres; 0: empty.
double diagonal_of(const TopoDS_Shape& shape);

}  // namespace kerf::cad

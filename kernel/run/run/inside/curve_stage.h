// The nodes of second order on curved edges, agreed on by all ranks.
#pragma once

#include "base/parallel/communicator.h"
#include "files/part/edge_nodes.h"
#include "files/part/edge_numbers.h"
#include "files/part/part.h"
#include "run/prepare/surface_nodes.h"
#include "run/report/listener.h"
#include "run/report/report.h"

namespace kerf {

struct CurvedMesh {
    CurvedNodes nodes;
    CurveReport report;
};

/// Curves the edges of the parts that lie on the surface as `surface` says, as far as all cells are valid then
/// (files/part/curved_part.h). Every rank does its share of the parts. An edge that one part straightens is straight in
/// all: parts that have it are done again without it, until none straightens another one. Nodes depend on the parts
/// alone. Collective; the same result on all ranks. Throws Error on every rank alike.
CurvedMesh curve_parts(Communicator& ranks, const PartSource& parts, const EdgeNumbers& numbers,
                       const SurfaceNodes& surface, RunListener* listener);

}  // namespace kerf

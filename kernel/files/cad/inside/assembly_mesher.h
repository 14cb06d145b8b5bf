// Tessellates several solids that share faces, each facet once.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/cad/inside/imprint.h"
#include "files/cad/inside/tessellation.h"

namespace kerf::cad {

/// An assembly as facets that hold the volumes of its solids.
struct MeshedAssembly {
    Tessellation facets;                 ///< with sides; every region is closed, and no two facets cross
    Array<RegionIndex, double> volumes;  ///< volumes of the regions inside of the facets; cubic millimetres
};

/// Tessellates an assembly as mesh_body() does a body: the volume of each region is right to
/// CadOptions::volume_tolerance, where that can be had. The deflection of the options is a fraction of the diagonal of
/// the smallest solid; 0: as fine as the volumes ask for. `diagonals`: of the solids; millimetres. Throws SolidDefect,
/// naming solids and faces, where a region stays open, faces cross, or a face gets no triangles; with `may_divide` it
/// returns nothing for such a face, since it may help to divide faces that are closed in themselves. Deterministic.
std::optional<MeshedAssembly> mesh_assembly(const Assembly& assembly, const std::vector<double>& diagonals,
                                            const std::string& path, const CadOptions& options, bool may_divide);

}  // namespace kerf::cad

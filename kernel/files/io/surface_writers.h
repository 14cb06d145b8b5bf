// Surfaces as PLY, OFF and VTK's files, with all digits.
#pragma once

#include <string>

#include "surface/soup/soup.h"

namespace kerf {

/// Write vertices and facets in their order; reading gives the coordinates bit for bit. PLY is binary. PLY and OFF hold
/// no patches. Throw Error(io).
void write_ply(const std::string& path, const Soup& soup);
void write_off(const std::string& path, const Soup& soup);

/// Write PolyData, as XML (.vtp) or in the legacy format (.vtk), as text, with the cell array Patch, whose names are
/// the field data PatchNames, and of several regions those on the sides of each facet (Soup::sides) as arrays front and
/// back, named by RegionNames: see scan_vtu(), which reads all of it. Throw Error(io).
void write_vtp(const std::string& path, const Soup& soup);
std::string vtp_text(const Soup& soup);  ///< what write_vtp() writes
void write_vtk(const std::string& path, const Soup& soup);

}  // namespace kerf

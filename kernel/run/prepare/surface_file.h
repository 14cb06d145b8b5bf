// Surfaces as files.
#pragma once

#include <string>
#include <vector>

#include "surface/complex/complex.h"
#include "surface/soup/soup.h"

namespace kerf {

/// Throws Error(usage), naming `what`, for a path whose ending is not one of a file of a surface with so many regions.
void require_surface_file(const std::string& what, const std::string& path, std::int32_t region_count = 1);

/// Writes an .obj with patches, of several regions with a closed group for each instead; a .vtp or .vtk with patches
/// and the regions on the sides of facets; a .ply or .off without patches; or an .stl, whose coordinates have 7 digits
/// (files/io/stl_writer.h). `path`: see require_surface_file(). Throws Error(io).
void write_surface(const std::string& path, const Complex& complex, const std::vector<std::string>& patch_names);

/// Writes facets that need not bound anything, in the same formats; the regions on their sides are not written.
void write_surface(const std::string& path, const Soup& soup);

}  // namespace kerf

// Surfaces as files.
#pragma once

#include <string>
#include <vector>

#include "surface/complex.h"
#include "surface/soup.h"

namespace kerf {

/// Throws Error(usage), naming `what`, for a path that does not end as a file of a surface of so many regions.
void require_surface_file(const std::string& what, const std::string& path, std::int32_t region_count = 1);

/// An .obj with patches, of several regions with a closed group for each instead; or an .stl, whose coordinates have
/// 7 digits (io/stl_writer.h). `path`: as require_surface_file() wants it. Throws Error(io).
void write_surface(const std::string& path, const Complex& complex, const std::vector<std::string>& patch_names);

/// The same of facets that need not bound anything; what lies on their sides is not written.
void write_surface(const std::string& path, const Soup& soup);

}  // namespace kerf

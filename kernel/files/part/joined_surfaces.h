// The closed surfaces of all parts as one file to open: it names the files of the parts, or holds their triangles.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace kerf {

/// Returns the PVTU that joins files of write_part_surface(); `pieces` are paths relative to the PVTU's folder.
/// `region_names`: empty for one region.
std::string surfaces_pvtu_text(const std::vector<std::string>& pieces, std::span<const std::string> region_names);

/// Writes the triangles of files of write_part_surface() (their paths, at least one), one file after the other, as one
/// VTU grid with their arrays and all names. Every file keeps its vertices, so that a triangle of an interface is there
/// twice, once for each part, facing outwards. The bytes depend on the files alone. Memory: a piece of a file. Throws
/// Error(io).
void write_joined_surfaces(const std::string& path, const std::vector<std::string>& pieces,
                           std::span<const std::string> patch_names, std::span<const std::string> region_names);

}  // namespace kerf

// The closed surfaces of all parts as one thing to open: by a file that names theirs, or by one that holds them.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace kerf {

/// The PVTU that joins files of write_part_surface(); `pieces` are paths relative to the PVTU's folder. `region_names`:
/// none of one region.
std::string surfaces_pvtu_text(const std::vector<std::string>& pieces, std::span<const std::string> region_names);

/// Writes the triangles of files of write_part_surface() (their paths, at least one), one file after the other, as one
/// VTU grid with their arrays and all names. Vertices are those of each file, so that a triangle of an interface is
/// there twice, once for each part, facing outwards. The bytes depend on the files alone. Memory: a piece of a file.
/// Throws Error(io).
void write_joined_surfaces(const std::string& path, const std::vector<std::string>& pieces,
                           std::span<const std::string> patch_names, std::span<const std::string> region_names);

}  // namespace kerf

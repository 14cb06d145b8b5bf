// The closed surfaces of all parts as one thing to open: by a file that names theirs, or by one that holds them.
#pragma once

#include <string>
#include <vector>

namespace kerf {

/// The PVTU that joins files of write_part_surface(); `pieces` are paths relative to the PVTU's folder. `has_regions`:
/// several.
std::string surfaces_pvtu_text(const std::vector<std::string>& pieces, bool has_regions);

/// Writes the triangles of files of write_part_surface() (their paths, at least one), one file after the other, as one
/// VTU grid with their arrays. Vertices are those of each file, so that a triangle of an interface is there twice, once
/// for each part, facing outwards. The bytes depend on the files alone. Memory: a piece of a file. Throws Error(io).
void write_joined_surfaces(const std::string& path, const std::vector<std::string>& pieces);

}  // namespace kerf

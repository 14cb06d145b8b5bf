// Reads part files back into memory, so that a finished run can be checked from its files alone.
#pragma once

#include <string>
#include <vector>

#include "files/part/part.h"
#include "files/part/vtu_writer.h"

namespace kerf {

/// Reads a file of write_part() or, as a mesh without tetrahedra, of write_part_surface(): a part without its shared
/// vertices and the neighbours of its tetrahedra, which follow from the other parts and from the mesh. Memory: that of
/// the content that is asked for.
///
/// Checks that sizes, offsets, cell types and vertex numbers fit together, of order 2 that each edge has its node in
/// all cells (PartContent::all, cells), and that the file is complete; whether the mesh obeys its laws is
/// verify_mesh()'s question. Throws Error(io) naming the file and its fault.
Part read_part(const std::string& path, PartContent content = PartContent::all);

/// Tells whether the file ends as write_part() and write_part_surface() end theirs. A file that is still being written,
/// or was when its run was killed, does not, nor does one that cannot be read.
bool is_complete_part_file(const std::string& path);

/// The counts of cells of a part file, of which the facets come last.
struct PartCellCounts {
    std::int64_t tets = 0, facets = 0;
};

/// Reads the file's header alone. Throws Error(io).
PartCellCounts read_cell_counts(const std::string& path);

/// The order of the cells of a part file, and its points.
struct PartPointCounts {
    int order = 1;
    std::int64_t vertices = 0, on_edges = 0;
};

/// Reads the file's header alone. Throws Error(io).
PartPointCounts read_point_counts(const std::string& path);

/// Tells whether a part file has an array of this name. Throws Error(io).
bool has_cell_values(const std::string& path, const std::string& array);

/// Returns the layout with which a part file was written. Throws Error(io).
VtuLayout read_layout(const std::string& path);

/// Returns the values `first` to `first + count - 1` of a Float32 array over the cells of a part file, of which nothing
/// else but the header is read; both numbers >= 0. Throws Error(io), also if the file has no such array or not so many
/// values.
std::vector<float> read_cell_values(const std::string& path, const std::string& array, std::int64_t first,
                                    std::int64_t count);

/// Returns the `values` that write_part() was given; for cells those of the tetrahedra alone. Throws Error(io).
std::vector<PartValues> read_values(const std::string& path);
/// Returns the names of the values without their numbers: reads the file's header alone.
std::vector<PartValues> read_value_names(const std::string& path);

}  // namespace kerf

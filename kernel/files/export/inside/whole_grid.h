// The whole mesh as one grid of VTK, for its XML files and its legacy ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

#include "files/export/inside/export_files.h"
#include "files/export/whole_mesh.h"
#include "files/part/appended_vtu.h"
#include "files/part/part.h"

namespace kerf {

/// A file to which arrays write their values: as they lie in memory, or big endian.
class ValueFile {
 public:
    explicit ValueFile(ExportFile& file) : file_(file) {}
    /// Values of `value_size` bytes, a power of two up to 8, are written with their bytes in reverse order.
    ValueFile(ExportFile& file, std::size_t value_size) : file_(file), reversed_(value_size) {}

    /// Writes whole values.
    void write(const void* data, std::size_t size);
    void write(std::string_view text) { write(text.data(), text.size()); }
    template <class T>
    void values(std::span<const T> values) {
        write(values.data(), values.size_bytes());
    }
    template <class T>
    void value(const T& value) {
        write(&value, sizeof value);
    }

 private:
    ExportFile& file_;
    std::size_t reversed_ = 0;
};

using WholeGrid = VtuGrid<ValueFile>;

/// Returns the grid: its cells are the tetrahedra of all parts, then the triangles on patches, for a wall between
/// regions the triangles of one side; for order 2 all of them are quadratic. The arrays have the names and values that
/// they have in part files, which are described in files/part/vtu_writer.h. The parts must outlive it.
WholeGrid whole_grid(const PartSource& parts);

/// Calls take(cell) with all cells of the grid, in their order.
void for_each_cell(const PartSource& parts, const std::function<void(const CellNodes& cell)>& take);

/// VTK's types of the cells of the grid (files/io/vtk_cell_types.h).
struct CellTypes {
    std::uint8_t tetrahedron, triangle;
};
CellTypes cell_types(const MeshOutline& outline);

}  // namespace kerf

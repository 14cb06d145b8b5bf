// The structure of one of VTK's XML files, a grid or a surface: all of it but the values of its arrays.
#pragma once

#include <bit>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "files/io/inside/vtk_cells.h"

namespace kerf::vtu {

struct Array {
    std::string type, format;
    std::string_view content;  // between the tags
    std::int64_t offset = 0;   // place of an appended array
};

// The cells of one kind that a piece of a surface has.
struct CellList {
    std::string element;  // its arrays are element/connectivity, element/offsets
    std::int64_t type, cells;
};

struct Piece {
    std::int64_t points = 0, cells = 0;
    std::map<std::string, Array> scalars;  // arrays of PointData
    std::map<std::string, Array> arrays;   // "Points", "connectivity", ...; of CellData those that are read
    std::vector<CellList> lists;           // of a surface, in the order in which CellData count its cells
};

struct File {
    bool has_long_headers = false, is_compressed = false, is_appended_base64 = false;
    std::endian order = std::endian::little;
    std::string_view appended;            // bytes behind the underscore
    std::map<std::string, Array> fields;  // arrays of FieldData that are read (name_arrays)
    std::vector<Piece> pieces;
};

/// Reads the structure of a file from its bytes, which must outlive it. Memory: a copy of the bytes before the appended
/// data, which is gone when this returns. Throws Error(input).
File read_structure(std::string_view bytes, const std::string& path);

}  // namespace kerf::vtu

// The structure of one of VTK's XML files: all of it but the values of its arrays.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kerf::vtu {

/// Throws the Error(input) of a file; `what` is a sentence and what to do.
[[noreturn]] void fail(const std::string& path, const std::string& what);

struct Array {
    std::string type, format;
    std::string_view content;  // between the tags
    std::int64_t offset = 0;   // place of an appended array
};

struct Piece {
    std::int64_t points = 0, cells = 0;
    std::map<std::string, Array> scalars;  // arrays of PointData
    std::map<std::string, Array> arrays;   // "Points", "connectivity", ...; of CellData those that are read
};

// Names of arrays that tell the region of a cell: Kerf's, then those that meshio makes of other formats. The first
// counts that all pieces have.
inline constexpr std::array<const char*, 4> region_arrays = {"Region", "gmsh:physical", "medit:ref", "attribute"};

// Names of arrays that tell the regions on the two sides of a triangle, -1: outside.
inline constexpr const char *front_array = "front", *back_array = "back";

struct File {
    bool has_long_headers = false, is_compressed = false, is_appended_base64 = false;
    std::endian order = std::endian::little;
    std::string_view appended;                          // bytes behind the underscore
    std::optional<Array> region_names, region_numbers;  // arrays of FieldData
    std::vector<Piece> pieces;
};

/// Reads the structure of a file from its bytes, which must outlive it. Memory: a copy of the bytes before the appended
/// data, which is gone when this returns. Throws Error(input).
File read_structure(std::string_view bytes, const std::string& path);

}  // namespace kerf::vtu

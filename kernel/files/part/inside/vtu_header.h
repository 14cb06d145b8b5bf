// The places of the arrays in a VTU file of this program.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

/// The XML header of a file of write_part() or write_part_surface(), with the places of its arrays.
struct VtuHeader {
    struct Array {
        std::string name, type;  ///< type as VTK names it: UInt8, Int32, Float64, ...
        std::int64_t components = 0, tuples = 0;
        std::int64_t position = 0;  ///< place of the array's UInt64 size in the file; its values follow
    };
    std::int64_t point_count = 0, cell_count = 0, boundary_vertex_count = 0;
    std::int64_t vertex_count = 0;  ///< points that are corners of cells; of order 2 there are more, on edges
    int order = 1;                  ///< of the cells
    std::vector<Array> arrays;      ///< in the order of the file

    const Array* find(std::string_view name) const;  ///< the first of this name, or nullptr
    /// Returns an array of this name with a tuple for every cell; null if there is none. Arrays of points, which come
    /// first, may have the same name.
    const Array* find_of_cells(std::string_view name) const;
};

/// Reads the header from the first bytes of a file; vtu_header_limit of them are enough. Throws Error(io) if it is not
/// a header of this writer; `path` is for the message.
VtuHeader parse_vtu_header(std::string_view begin_of_file, const std::string& path);
inline constexpr std::size_t vtu_header_limit = 16384;

/// Throws the Error(io) for a file that is not as this writer leaves it; `what` is a clause without a full stop.
[[noreturn]] void fail_damaged_vtu(const std::string& path, const std::string& what);

}  // namespace kerf

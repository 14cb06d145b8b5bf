// VTK XML grids whose arrays follow the XML as raw bytes, UInt64 headers, little endian: each array stands behind its
// size, and the XML names the offset of each. So a grid is a table of arrays, each with a function that streams its
// values, and the XML follows from the sizes alone.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kerf {

static_assert(std::endian::native == std::endian::little, "Grids have values as they lie in memory.");

/// VTK's name of a type of numbers.
template <class T>
inline constexpr const char* vtk_type = nullptr;
template <>
inline constexpr const char* vtk_type<std::uint8_t> = "UInt8";
template <>
inline constexpr const char* vtk_type<std::int8_t> = "Int8";
template <>
inline constexpr const char* vtk_type<std::int16_t> = "Int16";
template <>
inline constexpr const char* vtk_type<std::int32_t> = "Int32";
template <>
inline constexpr const char* vtk_type<std::int64_t> = "Int64";
template <>
inline constexpr const char* vtk_type<float> = "Float32";
template <>
inline constexpr const char* vtk_type<double> = "Float64";

/// The head of an array, as the XML says it.
struct VtuArrayHead {
    const char* section;  ///< the element of the XML that it stands in: FieldData, PointData, CellData, Points, Cells
    const char* type;
    std::string name;
    std::int64_t components, tuples, bytes;
};

/// An array whose values a function writes to a File, which has write(data, size) and write(text).
template <class File>
struct VtuArray : VtuArrayHead {
    std::function<void(File&)> write_values;

    /// Returns an array of tuples of numbers of the type T.
    template <class T>
    static VtuArray of(const char* section, std::string name, std::int64_t components, std::int64_t tuples,
                       std::function<void(File&)> write_values) {
        const std::int64_t bytes = components * tuples * sizeof(T);
        return {{section, vtk_type<T>, std::move(name), components, tuples, bytes}, std::move(write_values)};
    }
};

/// Returns the first line of the XML and the beginning of its element VTKFile. `type`: UnstructuredGrid or
/// PUnstructuredGrid.
std::string vtu_file_begin(std::string_view type);
/// The line before the raw bytes, which follow it without a gap; offsets count from here.
inline constexpr std::string_view vtu_data_begin = "<AppendedData encoding=\"raw\">\n_";
inline constexpr std::string_view vtu_file_end = "\n</AppendedData>\n</VTKFile>\n";

/// Returns the file until its raw bytes begin. `arrays`: in the order of the file, field data first; `fields`: field
/// data that stands in the XML itself.
std::string vtu_head(std::span<const VtuArrayHead> arrays, std::int64_t points, std::int64_t cells,
                     std::string_view fields);

/// Returns a field of one number, which stands in the XML. `type`: that of VTK.
std::string number_field(std::string_view type, std::string_view name, std::int64_t number);

/// Returns the PVTU that joins files with these arrays; `pieces` are paths relative to the PVTU's folder.
std::string pvtu_text(std::span<const VtuArrayHead> arrays, std::span<const std::string> pieces);

template <class File>
struct VtuGrid {
    std::int64_t points = 0, cells = 0;
    std::string fields = {};                  ///< field data that stands in the XML itself
    std::vector<VtuArray<File>> arrays = {};  ///< in the order of the file, field data first

    /// Adds an array behind the others of its section, of which there must be one already.
    void add(VtuArray<File> array) {
        const auto last = std::find_if(arrays.rbegin(), arrays.rend(), [&](const VtuArrayHead& other) {
            return std::string_view(other.section) == array.section;
        });
        arrays.insert(last.base(), std::move(array));
    }

    std::vector<VtuArrayHead> heads() const { return {arrays.begin(), arrays.end()}; }

    void write(File& file) const {
        file.write(vtu_head(heads(), points, cells, fields));
        for (const VtuArray<File>& array : arrays) {
            file.write(&array.bytes, sizeof array.bytes);
            array.write_values(file);
        }
        file.write(vtu_file_end);
    }
};

/// Returns field data of strings as bytes, each string with a zero byte behind it: VTK has a type for strings with the
/// same bytes, but meshio opens no file with an array of it. The names must outlive the array.
template <class File>
VtuArray<File> names_array(const char* array, std::span<const std::string> names) {
    std::int64_t bytes = 0;
    for (const std::string& name : names) bytes += name.size() + 1;
    return VtuArray<File>::template of<std::uint8_t>("FieldData", array, 1, bytes, [names](File& file) {
        for (const std::string& name : names) file.write(name.c_str(), name.size() + 1);
    });
}

/// Writes value(0), value(1), ..., which are computed while they are written.
template <class T, class File, class Value>
void write_computed(File& file, std::int64_t count, const Value& value) {
    constexpr std::int64_t most = (std::int64_t{1} << 18) / sizeof(T);  // stays in the cache until it is written
    std::vector<T> chunk(std::min(count, most));
    for (std::int64_t begin = 0; begin < count; begin += most) {
        const std::int64_t size = std::min(most, count - begin);
        for (std::int64_t i = 0; i < size; ++i) chunk[i] = value(begin + i);
        file.write(chunk.data(), size * sizeof(T));
    }
}

}  // namespace kerf

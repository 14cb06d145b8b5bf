// HDF5 files whose arrays are written as raw bytes, by many threads and processes at once.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kerf {

enum class Hdf5Type { byte, character, int32, int64, real32, real };

constexpr std::int64_t size_of(Hdf5Type type) {
    switch (type) {
        case Hdf5Type::byte:
        case Hdf5Type::character:
            return 1;
        case Hdf5Type::int32:
        case Hdf5Type::real32:
            return 4;
        case Hdf5Type::int64:
        case Hdf5Type::real:
            break;
    }
    return 8;
}

struct Hdf5Array {
    std::string name;  ///< name with its groups
    Hdf5Type type;
    std::int64_t rows;
    std::int64_t columns = 0;  ///< 0: the array has one dimension
    std::string bytes = {};    ///< all values, of an array that is written at once; else empty
};

struct Hdf5Attribute {
    std::string object;  ///< group or array
    const char* name;
    std::variant<std::string, std::vector<std::int32_t>, std::int32_t, double> value;
};

struct Hdf5Names {
    std::string name;
    std::vector<std::string> names;  ///< UTF-8
    std::size_t characters = 0;      ///< 0: strings as long as the longest; else each is an array of so many characters
};

struct Hdf5Content {
    std::string format;         ///< name of the format of Kerf, by which is_hdf5_of() knows the file
    bool tracks_order = false;  ///< groups know the order in which their members were made
    std::vector<std::string> groups;
    std::vector<Hdf5Array> arrays;
    std::vector<Hdf5Attribute> attributes;
    std::vector<Hdf5Names> names;
};

/// Tells by the first 1,024 bytes of a file whether make_hdf5_file() has made it for this format. Other programs' files
/// of the same format are none.
bool is_hdf5_of(std::string_view format, std::string_view beginning);

/// Makes the file with its arrays contiguous, allocated and not filled. The bytes depend on the content alone, not on
/// the time nor on the default version of the format. An older file is replaced. From any thread. Throws Error(io).
void make_hdf5_file(const std::string& path, const Hdf5Content& content);

/// The arrays of a file of make_hdf5_file(), as places of bytes.
class Hdf5Bytes {
 public:
    /// Opens the file and finds the places of these arrays. From any thread. Throws Error(io).
    Hdf5Bytes(const std::string& path, const std::vector<Hdf5Array>& arrays);
    Hdf5Bytes(const Hdf5Bytes&) = delete;
    Hdf5Bytes& operator=(const Hdf5Bytes&) = delete;
    ~Hdf5Bytes();

    /// Returns the place of a row of an array, in bytes from the beginning of the file.
    std::int64_t place_of(std::string_view name, std::int64_t row) const;
    /// Writes bytes at a place of the file. From any thread. Throws Error(io).
    void write(const void* data, std::size_t size, std::int64_t place) const;
    /// Closes the file; written bytes may meet a full disk only here. Throws Error(io).
    void close();

 private:
    struct Place {
        std::string name;
        std::int64_t begin, row_size;
    };

    std::string path_;
    int file_;
    std::vector<Place> places_;
};

}  // namespace kerf

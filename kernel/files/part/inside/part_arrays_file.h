// Reads the arrays of a part file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "files/io/checked_file.h"
#include "files/part/inside/vtu_header.h"
#include "files/part/vtu_reader.h"

namespace kerf {

/// The arrays of a part file are opened one at a time and read from front to back, so that arrays that nobody asks for
/// cost no memory. An array that does not fit the header is fail()ed.
class PartArraysFile {
 public:
    explicit PartArraysFile(const std::string& path)
        : path_(path), file_(path, "rb"), header_(parse_vtu_header(file_.read(vtu_header_limit), path)) {
        if (!is_complete_part_file(path)) fail("it does not end with the closing tag");
        std::error_code ignored;
        size_ = std::filesystem::file_size(path, ignored);
    }

    const VtuHeader& header() const { return header_; }
    /// The number of nodes of a tetrahedron and of a triangle.
    std::int64_t nodes_of_tet() const { return header_.order == 2 ? 10 : 4; }
    std::int64_t nodes_of_facet() const { return header_.order == 2 ? 6 : 3; }
    [[noreturn]] void fail(const std::string& what) const { fail_damaged_vtu(path_, what); }

    /// Opens an array, so that its first value is read next. Returns the number of its bytes.
    std::uint64_t open(const char* name) {
        const VtuHeader::Array* array = header_.find(name);
        if (!array) fail(fmt::format("it has no array {}", name));
        name_ = name;
        std::uint64_t size = 0;
        const std::uint64_t position = std::min<std::uint64_t>(size_, array->position);
        if (size_ - position < sizeof size) fail(fmt::format("it ends before the array {}", name));
        file_.seek(position);
        read(&size, sizeof size);
        if (size > size_ - position - sizeof size) fail(fmt::format("it ends within the array {}", name));
        values_ = position + sizeof size;
        return size;
    }
    /// Opens an array that must have `count` values.
    template <class T>
    void open(const char* name, std::int64_t count) {
        const std::uint64_t size = open(name);
        if (size % sizeof(T) || std::cmp_not_equal(size / sizeof(T), count))
            fail(fmt::format("its array {} has {} bytes, which are not {} values", name, size, count));
    }

    template <class T>
    std::vector<T> take(std::int64_t count) {
        std::vector<T> values(count);
        read(static_cast<void*>(values.data()), values.size() * sizeof(T));
        return values;
    }
    /// Goes on behind the first `count` values.
    template <class T>
    void skip(std::int64_t count) {
        file_.seek(values_ + count * sizeof(T));
    }
    /// Takes `count` values and calls visit(value) with each.
    template <class T, class Visit>
    void visit(std::int64_t count, Visit visit) {
        constexpr std::int64_t at_once = std::int64_t{1} << 16;
        for (; count > 0; count -= at_once)
            for (const T& value : take<T>(std::min(count, at_once))) visit(value);
    }
    /// Opens an array of `count` integers of any of these types and calls visit(value) with each.
    template <class... Types, class Visit>
    void visit_integers(const char* name, std::int64_t count, Visit visit) {
        const VtuHeader::Array* array = header_.find(name);
        const std::string type = array ? array->type : "";
        const auto visit_if = [&]<class T>(T) {
            if (type != name_of<T>) return false;
            open<T>(name, count);
            this->visit<T>(count, visit);
            return true;
        };
        if (!(visit_if(Types{}) || ...)) fail(fmt::format("it has no array {} of such integers", name));
    }

 private:
    template <class T>
    static constexpr const char* name_of = sizeof(T) == 1   ? "Int8"
                                           : sizeof(T) == 2 ? "Int16"
                                           : sizeof(T) == 4 ? "Int32"
                                                            : "Int64";
    void read(void* data, std::size_t size) {
        if (file_.read_into(data, size) != size) fail(fmt::format("it ends within the array {}", name_));
    }

    const std::string& path_;
    CheckedFile file_;
    VtuHeader header_;
    std::uint64_t size_ = 0;
    std::int64_t values_ = 0;  // place of the first value of the open array
    const char* name_ = "";
};

}  // namespace kerf

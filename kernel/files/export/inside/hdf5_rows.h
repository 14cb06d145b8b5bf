// Writes arrays of HDF5 files row by row.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "files/export/inside/hdf5_file.h"

namespace kerf {

/// Writes values of an array, one behind the other from a row on, through a buffer.
template <class T>
class Hdf5Rows {
 public:
    Hdf5Rows(const Hdf5Bytes& file, std::string_view name, std::int64_t first_row)
        : file_(file),
          begin_(file.place_of(name, 0)),
          row_size_(file.place_of(name, 1) - begin_),
          place_(begin_ + first_row * row_size_) {
        values_.reserve(most_values);
    }

    /// The next value is the first of this row.
    void go_to(std::int64_t row) {
        const std::int64_t wanted = begin_ + row * row_size_;
        if (wanted == place_ + std::ssize(values_) * std::int64_t{sizeof(T)}) return;
        flush();
        place_ = wanted;
    }
    void put(T value) {
        if (values_.size() == most_values) flush();
        values_.push_back(value);
    }
    void flush() {
        file_.write(values_.data(), values_.size() * sizeof(T), place_);
        place_ += values_.size() * sizeof(T);
        values_.clear();
    }

 private:
    static constexpr std::size_t most_values = (std::size_t{1} << 20) / sizeof(T);

    const Hdf5Bytes& file_;
    std::int64_t begin_, row_size_;
    std::int64_t place_;  // of the first value in the buffer
    std::vector<T> values_;
};

}  // namespace kerf

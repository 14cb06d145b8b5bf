// Reads numbers that a file holds as their bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

#include "base/core/error.h"

namespace kerf {

/// Walks over the bytes of a file from `begin` on. Errors name the file and the byte.
class BinaryScanner {
 public:
    BinaryScanner(std::string_view bytes, std::size_t begin, const std::string& path, std::endian order)
        : bytes_(bytes), position_(begin), path_(path), swap_(order != std::endian::native) {}

    /// Returns the next number. Throws Error(input) at the end of the file.
    template <class Number>
    Number next() {
        if (left() < sizeof(Number)) fail("the file ends too early. It is truncated: export or copy it again.");
        std::array<char, sizeof(Number)> raw;
        std::memcpy(raw.data(), bytes_.data() + position_, raw.size());
        if (swap_) std::reverse(raw.begin(), raw.end());
        position_ += raw.size();
        return std::bit_cast<Number>(raw);
    }
    std::size_t position() const { return position_; }
    /// The number of bytes that are not read yet.
    std::size_t left() const { return bytes_.size() - position_; }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ErrorCode::input, path_ + ", byte " + std::to_string(position_) + ": " + what);
    }

 private:
    std::string_view bytes_;
    std::size_t position_;
    const std::string& path_;
    bool swap_;
};

}  // namespace kerf

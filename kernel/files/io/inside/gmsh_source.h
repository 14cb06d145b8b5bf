// Reads the numbers in the sections of one of Gmsh's files, which are text or bytes.
#pragma once

#include <bit>
#include <optional>
#include <string>
#include <string_view>

#include "files/io/inside/binary_scanner.h"
#include "files/io/inside/text_scanner.h"

namespace kerf::gmsh {

/// Reads on through a file whose keywords are text and whose numbers may be bytes. Errors name the place.
class Source {
 public:
    explicit Source(std::string_view bytes, const std::string& path) : bytes_(bytes), path_(path), text_(bytes, path) {}

    /// Returns the scanner of the text, which goes on where the numbers ended; keywords are text in binary files, too.
    TextScanner& text() {
        if (binary_) text_.go_to(binary_->position());
        binary_.reset();
        return text_;
    }
    void set_byte_order(std::endian order) { order_ = order; }
    bool is_binary() const { return order_.has_value(); }

    std::int32_t next_int() {
        if (is_binary()) return binary().next<std::int32_t>();
        const std::int64_t value = text_.next_integer();
        if (value != static_cast<std::int32_t>(value))
            fail("a tag or type has more than 32 bits. Save the mesh again.");
        return value;
    }
    std::int64_t next_long() { return is_binary() ? binary().next<std::int64_t>() : text_.next_integer(); }
    double next_real() { return is_binary() ? binary().next<double>() : text_.next_real(); }
    std::int64_t next_count() {
        const std::int64_t count = next_long();
        if (count < 0) fail("a number of elements is negative. Correct it or export the surface again.");
        return count;
    }
    /// Passes over the numbers of a list in which each takes room in the file.
    void skip_ints(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) next_int();
    }
    void skip_reals(std::int64_t count) {
        for (std::int64_t i = 0; i < count; ++i) next_real();
    }
    [[noreturn]] void fail(const std::string& what) const { binary_ ? binary_->fail(what) : text_.fail(what); }

 private:
    // Numbers as bytes begin behind the end of the line in which text was read last.
    BinaryScanner& binary() {
        if (!binary_) {
            text_.skip_line();
            binary_.emplace(bytes_, text_.position(), path_, *order_);
        }
        return *binary_;
    }

    std::string_view bytes_;
    const std::string& path_;
    TextScanner text_;
    std::optional<std::endian> order_;
    std::optional<BinaryScanner> binary_;  // while numbers are read
};

}  // namespace kerf::gmsh

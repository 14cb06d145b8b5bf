// The values of the arrays of one of VTK's XML files.
//
// Values are text, or bytes: as base64 in place, or behind the tag AppendedData, there perhaps plain. Bytes come behind
// their number; if a compressor is named, behind the number of blocks, the size of a block, the size of the last block
// if it is smaller, and the compressed sizes of all. Header and data may be encoded as base64 in one piece or each for
// itself.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "files/io/compressed.h"
#include "files/io/inside/binary_scanner.h"
#include "files/io/inside/text_scanner.h"
#include "files/io/inside/vtu_structure.h"

namespace kerf::vtu {

// Gives the bytes of an array one after the other, from base64 or as they are.
class Bytes {
 public:
    Bytes(std::string_view text, bool is_base64, const std::string& path)
        : text_(text), is_base64_(is_base64), path_(path) {}

    std::string next(std::uint64_t size) {
        if (size > text_.size() + rest_.size()) fail_short();
        if (!is_base64_) {
            const std::string bytes(text_.substr(0, size));
            text_.remove_prefix(size);
            return bytes;
        }
        while (rest_.size() < size) decode_group();
        std::string bytes = rest_.substr(0, size);
        rest_.erase(0, size);
        return bytes;
    }

 private:
    [[noreturn]] void fail_short() const {
        fail(path_, "an array ends too early. The file is truncated: save or copy it again.");
    }
    // Decodes four letters, the last of which are = where an encoding ends.
    void decode_group() {
        std::uint32_t value = 0;
        int letters = 0, padding = 0;
        while (letters < 4) {
            if (text_.empty()) fail_short();
            const char c = text_.front();
            text_.remove_prefix(1);
            if (c == ' ' || (c >= '\t' && c <= '\r')) continue;
            if (c == '=') ++padding;
            value = value << 6 | digit(c);
            ++letters;
        }
        for (int byte = 0; byte < 3 - padding; ++byte) rest_ += static_cast<char>(value >> (16 - 8 * byte));
    }
    std::uint32_t digit(char c) const {
        if (c >= 'A' && c <= 'Z') return c - 'A';
        if (c >= 'a' && c <= 'z') return c - 'a' + 26;
        if (c >= '0' && c <= '9') return c - '0' + 52;
        if (c == '+') return 62;
        if (c == '/') return 63;
        if (c == '=') return 0;
        if (c == '<') fail_short();
        fail(path_, "an array is not base64. Save or copy the file again.");
    }

    std::string_view text_;
    bool is_base64_;
    const std::string& path_;
    std::string rest_;  // decoded and not asked for yet
};

class Decoder {
 public:
    Decoder(const File& file, const std::string& path) : file_(file), path_(path) {}

    /// Returns the values of an array of a piece, which must be `count`.
    template <class Value>
    std::vector<Value> values(const Piece& piece, const std::string& name, std::int64_t count) const {
        const auto found = piece.arrays.find(name);
        if (found == piece.arrays.end()) fail(path_, "it has no array " + name + ". Save it again.");
        std::vector<Value> result = values_of<Value>(found->second);
        if (std::ssize(result) != count)
            fail(path_, "its array " + name + " has " + std::to_string(result.size()) + " values, not " +
                            std::to_string(count) + ". Save or copy it again.");
        return result;
    }
    template <class Value>
    std::vector<Value> values_of(const Array& array) const {
        if (array.format == "ascii") return from_text<Value>(array.content);
        const std::string bytes = bytes_of(array);
        const std::string& type = array.type;
        if (type == "Float64") return from_bytes<Value, double>(bytes);
        if (type == "Float32") return from_bytes<Value, float>(bytes);
        if (type == "Int64") return from_bytes<Value, std::int64_t>(bytes);
        if (type == "UInt64") return from_bytes<Value, std::uint64_t>(bytes);
        if (type == "Int32") return from_bytes<Value, std::int32_t>(bytes);
        if (type == "UInt32") return from_bytes<Value, std::uint32_t>(bytes);
        if (type == "Int16") return from_bytes<Value, std::int16_t>(bytes);
        if (type == "UInt16") return from_bytes<Value, std::uint16_t>(bytes);
        if (type == "Int8") return from_bytes<Value, std::int8_t>(bytes);
        if (type == "UInt8" || type == "String") return from_bytes<Value, std::uint8_t>(bytes);
        fail(path_, "an array has values of type '" + type.substr(0, 40) + "', which is none of VTK. Save it again.");
    }

 private:
    template <class Value>
    std::vector<Value> from_text(std::string_view text) const {
        std::vector<Value> values;
        for (TextScanner scanner(text, path_); !scanner.at_end();)
            if constexpr (std::is_floating_point_v<Value>)
                values.push_back(scanner.next_real());
            else
                values.push_back(scanner.next_integer());
        return values;
    }
    template <class Value, class Stored>
    std::vector<Value> from_bytes(const std::string& bytes) const {
        if (bytes.size() % sizeof(Stored)) fail(path_, "an array ends within a value. Save or copy it again.");
        std::vector<Value> values(bytes.size() / sizeof(Stored));
        BinaryScanner scanner(bytes, 0, path_, file_.order);
        for (Value& value : values) value = scanner.next<Stored>();
        return values;
    }
    std::string bytes_of(const Array& array) const {
        if (array.format == "appended") {
            if (array.offset < 0 || array.offset > std::ssize(file_.appended))
                fail(path_, "an array lies behind the end of the file. It is truncated: save or copy it again.");
            return decoded({file_.appended.substr(array.offset), file_.is_appended_base64, path_});
        }
        if (array.format == "binary") return decoded({array.content, true, path_});
        fail(path_,
             "an array has the format '" + array.format.substr(0, 40) + "', which is none of VTK. Save it again.");
    }
    std::uint64_t next_size(Bytes& bytes) const {
        const std::string raw = bytes.next(file_.has_long_headers ? sizeof(std::uint64_t) : sizeof(std::uint32_t));
        BinaryScanner scanner(raw, 0, path_, file_.order);
        return file_.has_long_headers ? scanner.next<std::uint64_t>() : scanner.next<std::uint32_t>();
    }
    std::string decoded(Bytes bytes) const {
        const std::uint64_t count = next_size(bytes);
        if (!file_.is_compressed) return bytes.next(count);
        const std::uint64_t block = next_size(bytes), last = next_size(bytes);
        std::vector<std::uint64_t> sizes;
        for (std::uint64_t i = 0; i < count; ++i) sizes.push_back(next_size(bytes));
        std::string content;
        for (std::size_t i = 0; i < sizes.size(); ++i)
            content += inflate_block(bytes.next(sizes[i]), i + 1 == sizes.size() && last ? last : block, path_);
        return content;
    }

    const File& file_;
    const std::string& path_;
};

}  // namespace kerf::vtu

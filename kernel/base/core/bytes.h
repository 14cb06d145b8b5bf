// Plain data to bytes and back: the form in which surfaces and results travel between processes of one machine type.
//
// A type that travels has a member `template <class Archive> void archive(Archive& a) { a(field, ...); }`: one list of
// fields serves both directions, so that they cannot drift apart.
#pragma once

#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/core/error.h"
#include "base/core/padding.h"
#include "base/core/types.h"

namespace kerf {

using Bytes = std::vector<char>;

class ByteWriter;

namespace detail {
template <class T>
inline constexpr bool has_fields = requires(T& t, ByteWriter& w) {
    t.archive(w);
};
template <class T>
inline constexpr bool is_plain =
    (std::is_trivially_copyable_v<T> && !has_fields<T>) || std::is_same_v<T, Vec2> || std::is_same_v<T, Vec3>;
}  // namespace detail

/// Appends values to a byte buffer.
class ByteWriter {
 public:
    explicit ByteWriter(Bytes& bytes) : bytes_(bytes) {}

    template <class... T>
    void operator()(const T&... values) {
        (write(values), ...);
    }

 private:
    void raw(const void* data, std::size_t size) {
        const char* begin = static_cast<const char*>(data);
        bytes_.insert(bytes_.end(), begin, begin + size);
    }
    template <class T>
    void write(const T& value) {
        if constexpr (detail::has_fields<T>)
            const_cast<T&>(value).archive(*this);  // archive() of a writer only reads
        else {
            static_assert(detail::is_plain<T> && HasNoPadding<T>::value);
            raw(&value, sizeof value);
        }
    }
    void write(const std::string& s) {
        write(static_cast<std::uint64_t>(s.size()));
        raw(s.data(), s.size());
    }
    template <class T>
    void write(const std::vector<T>& items) {
        write(static_cast<std::uint64_t>(items.size()));
        if constexpr (detail::is_plain<T>) {
            static_assert(HasNoPadding<T>::value);
            raw(items.data(), items.size() * sizeof(T));
        } else {
            for (const T& item : items) write(item);
        }
    }

    Bytes& bytes_;
};

/// Takes values from a byte buffer in the order in which they were written; throws Error(internal) when it is too
/// short.
class ByteReader {
 public:
    explicit ByteReader(std::span<const char> bytes) : bytes_(bytes) {}

    template <class... T>
    void operator()(T&... values) {
        (read(values), ...);
    }

 private:
    void raw(void* data, std::size_t size) {
        if (size > bytes_.size()) throw Error(ErrorCode::internal, "A message between processes is too short.");
        if (size) std::memcpy(data, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
    }
    std::size_t read_count(std::size_t least_item_size) {
        std::uint64_t n = 0;
        raw(&n, sizeof n);
        if (n > bytes_.size() / least_item_size)
            throw Error(ErrorCode::internal, "A message between processes is damaged.");
        return n;
    }
    template <class T>
    void read(T& value) {
        if constexpr (detail::has_fields<T>)
            value.archive(*this);
        else {
            static_assert(detail::is_plain<T>);
            raw(&value, sizeof value);
        }
    }
    void read(std::string& s) {
        s.resize(read_count(1));
        raw(s.data(), s.size());
    }
    template <class T>
    void read(std::vector<T>& items) {
        if constexpr (detail::is_plain<T>) {
            items.resize(read_count(sizeof(T)));
            raw(items.data(), items.size() * sizeof(T));
        } else {
            items.resize(read_count(1));
            for (T& item : items) read(item);
        }
    }

    std::span<const char> bytes_;
};

template <class T>
Bytes to_bytes(const T& value) {
    Bytes bytes;
    ByteWriter{bytes}(value);
    return bytes;
}

template <class T>
T from_bytes(std::span<const char> bytes) {
    T value;
    ByteReader{bytes}(value);
    return value;
}

}  // namespace kerf

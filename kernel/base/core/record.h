// Records: bytes that tell whether they are complete and undamaged.
#pragma once

#include <optional>
#include <string_view>

#include "base/core/bytes.h"
#include "base/core/hash.h"

namespace kerf {

/// Returns the hash of a value's bytes, followed by these bytes.
template <class T>
Bytes to_record(const T& value) {
    const Bytes bytes = to_bytes(value);
    const std::uint64_t hash = hash_bytes(bytes);
    Bytes record(sizeof hash);
    std::memcpy(record.data(), &hash, sizeof hash);
    record.insert(record.end(), bytes.begin(), bytes.end());
    return record;
}

/// Returns the value of a record, or nothing if the record was damaged or cut short.
template <class T>
std::optional<T> from_record(std::string_view record) {
    std::uint64_t hash = 0;
    if (record.size() < sizeof hash) return {};
    std::memcpy(&hash, record.data(), sizeof hash);
    const std::span<const char> bytes(record.data() + sizeof hash, record.size() - sizeof hash);
    if (hash_bytes(bytes) != hash) return {};
    try {
        return from_bytes<T>(bytes);
    } catch (const Error&) {  // of another version
        return {};
    }
}

}  // namespace kerf

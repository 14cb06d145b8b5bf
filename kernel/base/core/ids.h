// Numbers of things with a type for each kind, so that they cannot be mistaken for one another, nor for counts.
#pragma once

#include <compare>
#include <concepts>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <vector>

#include "base/core/check.h"

namespace kerf {

/// Returns the number of items of a container, or of characters of a text, in the 32 bits in which ids count. There
/// must not be more.
template <class Items>
constexpr std::int32_t count_of(const Items& items) {
    KERF_CHECK(std::size(items) <= std::size_t{std::numeric_limits<std::int32_t>::max()});
    return static_cast<std::int32_t>(std::size(items));
}

/// The place of a thing among those of its kind, counted from 0, in 32 bits. The kind is named by the Tag.
template <class Tag>
class Id {
 public:
    constexpr Id() = default;
    template <std::integral Number>
    constexpr explicit Id(Number value) : value_(static_cast<std::int32_t>(value)) {}

    /// The id of no thing. It is less than all others.
    static constexpr Id none() { return Id(-1); }
    constexpr bool is_valid() const { return value_ >= 0; }

    constexpr std::int32_t value() const { return value_; }
    constexpr auto operator<=>(const Id&) const = default;
    constexpr Id& operator++() {
        ++value_;
        return *this;
    }
    /// Makes an Id an iterator over itself, as IdRange needs.
    constexpr Id operator*() const { return *this; }

 private:
    std::int32_t value_ = 0;
};

/// All ids in [first, last), for loops.
template <class I>
class IdRange {
 public:
    constexpr IdRange(I first, I last) : first_(first), last_(last) {}
    constexpr I begin() const { return first_; }
    constexpr I end() const { return last_; }

 private:
    I first_, last_;
};

/// Returns the first `count` ids of a kind.
template <class I, std::integral Count>
constexpr IdRange<I> ids(Count count) {
    return {I(0), I(count)};
}

/// A vector with an item for each thing of a kind, indexed by its id.
template <class I, class T>
class Array : public std::vector<T> {
 public:
    using std::vector<T>::vector;
    using std::vector<T>::operator[];
    T& operator[](I id) { return (*this)[static_cast<std::size_t>(id.value())]; }
    const T& operator[](I id) const { return (*this)[static_cast<std::size_t>(id.value())]; }
    /// The ids of all items.
    IdRange<I> ids() const { return kerf::ids<I>(this->size()); }

    template <class Archive>
    void archive(Archive& a) {
        a(static_cast<std::vector<T>&>(*this));
    }
};

/// The place of a part in the order of the tree (MeshOutline::parts), which is not its NodeId, nor an MPI rank.
using PartIndex = Id<struct PartIndexTag>;

/// A region of a complex (surface/complex/complex.h): a body of one material.
using RegionIndex = Id<struct RegionIndexTag>;

/// Lets JSON hold an id as its number.
template <class Json, class Tag>
void to_json(Json& json, Id<Tag> id) {
    json = id.value();
}
template <class Json, class Tag>
void from_json(const Json& json, Id<Tag>& id) {
    id = Id<Tag>(json.template get<std::int32_t>());
}

}  // namespace kerf

template <class Tag>
struct std::hash<kerf::Id<Tag>> {
    std::size_t operator()(kerf::Id<Tag> id) const noexcept { return std::hash<std::int32_t>()(id.value()); }
};

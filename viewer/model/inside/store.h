// Fetched values in a bounded memory.
#pragma once

#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "base/core/types.h"
#include "viewer/model/view_state.h"

namespace kerf::view {

/// Keeps values of several types by key; the least recently used leave when their sizes add up to more than the limit.
/// Values that were asked for since the last but one call of next_frame() stay: to drop them would mean to fetch them
/// again at once, for ever.
class Store {
 public:
    enum class Kind : std::uint8_t {
        surface,
        part_surface,
        cells,
        cell_values,
        facet_values,
        worst_cells,
        on_surface,
        solution
    };
    struct Key {
        Kind kind;
        NodeId node = no_node;
        ColorBy color = {};
        std::size_t count = 0;     ///< number of worst cells; for a solution the number of the case
        const void* of = nullptr;  ///< the surface on which values lie; the values keep it alive
        auto operator<=>(const Key&) const = default;
    };

    explicit Store(std::size_t limit_bytes) : limit_(limit_bytes) {}
    Store(const Store&) = delete;  // places lead into the entries
    Store& operator=(const Store&) = delete;
    Store(Store&&) = default;
    Store& operator=(Store&&) = default;

    void next_frame() { ++frame_; }

    /// Returns the value of a key, which counts as used now; nullptr if there is none. T must be the type of the key's
    /// kind.
    template <class T>
    std::shared_ptr<const T> find(const Key& key) {
        return std::static_pointer_cast<const T>(touch(key));
    }
    /// Adds a value, which counts as used now; replaces the one that has the key.
    void insert(const Key& key, std::shared_ptr<const void> value, std::size_t bytes);
    void erase(const Key& key);
    void clear();
    /// Drops all values for whose keys `drops` is true.
    template <class Predicate>
    void erase_if(Predicate drops) {
        for (auto entry = entries_.begin(); entry != entries_.end();) {
            const auto next = std::next(entry);
            if (drops(entry->key)) remove(entry);
            entry = next;
        }
    }

    /// Inserts all that the other store holds; the values are the same objects.
    void share(const Store& other);
    /// Drops the least recently used values, even those in use, until all take no more than `bytes`.
    void shrink(std::size_t bytes);

    bool holds(const Key& key) const { return places_.contains(key); }
    std::size_t bytes() const { return bytes_; }
    /// Returns whether values in use fill the memory, so that nothing more should be fetched.
    bool is_full() const;

 private:
    struct Entry {
        Key key;
        std::shared_ptr<const void> value;
        std::size_t bytes;
        std::uint64_t frame;  // the frame in which it was last used
    };
    using Place = std::list<Entry>::iterator;

    std::shared_ptr<const void> touch(const Key& key);
    void remove(Place entry);
    bool in_use(const Entry& entry) const { return entry.frame + 1 >= frame_; }

    std::list<Entry> entries_;  // the most recently used first
    std::map<Key, Place> places_;
    std::size_t limit_, bytes_ = 0;
    std::uint64_t frame_ = 1;
};

}  // namespace kerf::view

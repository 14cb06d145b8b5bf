// What was fetched, in a bounded memory.
#pragma once

#include <compare>
#include <cstdint>
#include <list>
#include <map>
#include <memory>

#include "core/types.h"

namespace kerf::view {

/// Keeps values of several types by key; the least recently used leave when their sizes add up to more than the limit.
/// What was asked for since the last but one call of next_frame() stays: to drop it would mean to fetch it again at
/// once, for ever.
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
        NodeId node = 0;
        int color = 0;
        std::size_t count = 0;     ///< of worst cells; the number of the case of a solution
        const void* of = nullptr;  ///< the surface on which values lie, which these keep alive
        auto operator<=>(const Key&) const = default;
    };

    explicit Store(std::size_t limit_bytes) : limit_(limit_bytes) {}
    Store(const Store&) = delete;  // places lead into the entries
    Store& operator=(const Store&) = delete;
    Store(Store&&) = default;
    Store& operator=(Store&&) = default;

    void next_frame() { ++frame_; }

    /// nullptr if it is not there. T must be that of the key's kind.
    template <class T>
    std::shared_ptr<const T> find(const Key& key) {
        return std::static_pointer_cast<const T>(touch(key));
    }
    /// Replaces what has the key. It counts as used now.
    void insert(const Key& key, std::shared_ptr<const void> value, std::size_t bytes);
    void erase(const Key& key);
    void clear();
    /// Drops all for which `drops` is true.
    template <class Predicate>
    void erase_if(Predicate drops) {
        for (auto entry = entries_.begin(); entry != entries_.end();) {
            const auto next = std::next(entry);
            if (drops(entry->key)) remove(entry);
            entry = next;
        }
    }

    /// Holds all that the other one does; the values are the same objects.
    void share(const Store& other);
    /// Drops the least recently used, whatever is in use, until they take no more than this.
    void shrink(std::size_t bytes);

    bool holds(const Key& key) const { return places_.contains(key); }
    std::size_t bytes() const { return bytes_; }
    /// What is in use fills the memory: nothing more should be fetched.
    bool is_full() const;

 private:
    struct Entry {
        Key key;
        std::shared_ptr<const void> value;
        std::size_t bytes;
        std::uint64_t frame;  // in which it was last used
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

#include "viewer/model/inside/store.h"

#include <iterator>
#include <utility>

namespace kerf::view {

std::shared_ptr<const void> Store::touch(const Key& key) {
    const auto found = places_.find(key);
    if (found == places_.end()) return nullptr;
    found->second->frame = frame_;
    entries_.splice(entries_.begin(), entries_, found->second);
    return entries_.front().value;
}

void Store::insert(const Key& key, std::shared_ptr<const void> value, std::size_t bytes) {
    erase(key);
    entries_.push_front({key, std::move(value), bytes, frame_});
    places_[key] = entries_.begin();
    bytes_ += bytes;
    while (bytes_ > limit_ && !in_use(entries_.back())) remove(std::prev(entries_.end()));
}

void Store::erase(const Key& key) {
    if (const auto found = places_.find(key); found != places_.end()) remove(found->second);
}

void Store::remove(Place entry) {
    bytes_ -= entry->bytes;
    places_.erase(entry->key);
    entries_.erase(entry);
}

void Store::share(const Store& other) {
    for (auto entry = other.entries_.rbegin(); entry != other.entries_.rend(); ++entry)
        insert(entry->key, entry->value, entry->bytes);
}

void Store::shrink(std::size_t bytes) {
    while (bytes_ > bytes) remove(std::prev(entries_.end()));
}

void Store::clear() {
    entries_.clear();
    places_.clear();
    bytes_ = 0;
}

// The entries in use come first.
bool Store::is_full() const { return bytes_ >= limit_ && (entries_.empty() || in_use(entries_.back())); }

}  // namespace kerf::view

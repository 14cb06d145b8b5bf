// Keeps geometry that was made, so that going back and forth computes nothing again.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "viewer/scene/layer.h"

namespace kerf::view {

/// Remembers geometry by a key that tells how it was made and the value that it was made from.
class GeometryCache {
 public:
    /// Returns the geometry that make() has made for this key and source, or makes it now. It is made anew if the
    /// source is another object than before.
    template <class Make>
    std::shared_ptr<const Geometry> get(const std::string& key, std::shared_ptr<const void> source, Make make) {
        Entry& entry = entries_[key];
        if (!entry.geometry || entry.source != source) {
            entry.geometry = make();
            entry.source = std::move(source);
            ++made_;
        }
        entry.last_use = now_;
        return entry.geometry;
    }

    /// Forgets the geometries that were not used for longest when there is much; called once per scene.
    void age();
    /// Returns the number of geometries that had to be made so far.
    std::int64_t made() const { return made_; }

 private:
    struct Entry {
        std::shared_ptr<const void> source;
        std::shared_ptr<const Geometry> geometry;
        std::int64_t last_use = 0;
    };
    std::map<std::string, Entry> entries_;
    std::int64_t now_ = 0, made_ = 0;
};

}  // namespace kerf::view

// Geometry that was made before, so that going back and forth computes nothing again.
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
    /// What make() returned for this key and source before, else what it returns now. A source that is another object
    /// than before makes it anew.
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

    /// Called once per scene: what was not used for long is forgotten when there is much.
    void age();
    /// How often something had to be made.
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

#include "viewer/scene/inside/geometry_cache.h"

#include <algorithm>
#include <vector>

namespace kerf::view {

namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

std::size_t size_of(const Geometry& geometry) {
    return geometry.corners.size() * sizeof(Corner) + geometry.segments.size() * sizeof(Segment) +
           geometry.points.size() * sizeof(geometry.points[0]) + geometry.element.size() * sizeof(std::int32_t) +
           geometry.rest.size() * sizeof(geometry.rest[0]) + geometry.origins.size() * sizeof(geometry.origins[0]);
}

}  // namespace

void GeometryCache::age() {
    std::size_t bytes = 0;
    std::vector<std::pair<std::int64_t, std::string>> oldest;
    for (const auto& [key, entry] : entries_) {
        bytes += size_of(*entry.geometry);
        oldest.emplace_back(entry.last_use, key);
    }
    if (bytes > most_bytes) std::sort(oldest.begin(), oldest.end());
    for (const auto& [last_use, key] : oldest) {
        if (bytes <= most_bytes || last_use == now_) break;
        bytes -= size_of(*entries_.at(key).geometry);
        entries_.erase(key);
    }
    ++now_;
}

}  // namespace kerf::view

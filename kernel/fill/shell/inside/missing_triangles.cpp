#include "fill/shell/inside/missing_triangles.h"

#include <algorithm>

#include "base/core/check.h"

namespace kerf {

void MissingTriangles::add(const Triangle& triangle, std::int32_t origin) {
    for (int i = 0; i < 3; ++i) at_edge_[undirected(triangle[i], triangle[(i + 1) % 3])].push_back(count());
    triangles_.push_back(triangle);
    state_.push_back(State::missing);
    origin_.push_back(origin);
    ++missing_count_;
}

void MissingTriangles::leave(std::int32_t number, State state) {
    KERF_CHECK(is_missing(number));
    state_[number] = state;
    --missing_count_;
    const Triangle& triangle = triangles_[number];
    for (int i = 0; i < 3; ++i) {
        const auto edge = at_edge_.find(undirected(triangle[i], triangle[(i + 1) % 3]));
        std::erase(edge->second, number);
        if (edge->second.empty()) at_edge_.erase(edge);
    }
}

void MissingTriangles::set_made(std::int32_t number) { leave(number, State::made); }

void MissingTriangles::replace(std::int32_t number, std::span<const Triangle> by) {
    leave(number, State::replaced);
    for (const Triangle& triangle : by) add(triangle, origin_[number]);
}

std::vector<std::int32_t> MissingTriangles::missing_origins() const {
    std::vector<std::int32_t> origins;
    for (std::int32_t number = 0; number < count(); ++number)
        if (is_missing(number)) origins.push_back(origin_[number]);
    std::sort(origins.begin(), origins.end());
    origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    return origins;
}

std::vector<std::int32_t> MissingTriangles::at_edge(std::int32_t a, std::int32_t b) const {
    const auto edge = at_edge_.find(undirected(a, b));
    return edge == at_edge_.end() ? std::vector<std::int32_t>() : edge->second;
}

}  // namespace kerf

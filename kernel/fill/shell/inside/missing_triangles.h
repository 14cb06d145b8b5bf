// Triangles that are to become faces of a triangulation.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"

namespace kerf {

/// Triangles by numbers, which never change: those that are missing, those that are faces now, and those for which
/// others stand.
class MissingTriangles {
 public:
    /// Adds a triangle that is missing, a part of the given triangle `origin`.
    void add(const Triangle& triangle, std::int32_t origin);
    /// Notes that the triangle is a face now.
    void set_made(std::int32_t number);
    /// Replaces a missing triangle by others, which are missing then.
    void replace(std::int32_t number, std::span<const Triangle> by);

    /// Returns the number of triangles that were ever added.
    std::int32_t count() const { return count_of(triangles_); }
    std::int64_t missing_count() const { return missing_count_; }
    bool is_missing(std::int32_t number) const { return state_[number] == State::missing; }
    bool is_made(std::int32_t number) const { return state_[number] == State::made; }
    const Triangle& triangle(std::int32_t number) const { return triangles_[number]; }
    std::int32_t origin(std::int32_t number) const { return origin_[number]; }
    /// Returns the origins of missing triangles, ascending, each once.
    std::vector<std::int32_t> missing_origins() const;

    /// Returns the numbers of the missing triangles with this edge, in either direction; ascending.
    std::vector<std::int32_t> at_edge(std::int32_t a, std::int32_t b) const;
    /// Returns whether a missing triangle has this edge, so that the edge must not be removed where the triangulation
    /// has it.
    bool has_edge(std::int32_t a, std::int32_t b) const { return at_edge_.contains(undirected(a, b)); }

 private:
    enum class State : char { missing, made, replaced };

    void leave(std::int32_t number, State state);

    std::vector<Triangle> triangles_;
    std::vector<State> state_;
    std::vector<std::int32_t> origin_;
    std::int64_t missing_count_ = 0;
    std::map<UndirectedEdge, std::vector<std::int32_t>> at_edge_;
};

}  // namespace kerf

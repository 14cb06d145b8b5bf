// The pairs of cells of a star that share a face.
#pragma once

#include <array>
#include <vector>

#include "base/core/types.h"

namespace kerf {

/// A new vertex is joined with the triangles of a closed surface around it. Two cells that are made so share a face
/// where their triangles share an edge, which one of them runs from a to b, and the other from b to a. This finds the
/// other one without searching: vertices of the surface get small numbers, and edges places in a square table.
class StarEdges {
 public:
    /// The small number of a vertex of the surface. A surface with more vertices than `most_places` is `is_large()`,
    /// and has no table.
    using Place = std::uint8_t;
    static constexpr std::size_t most_places = 256;

    /// Makes room for vertices with numbers below `count`.
    void reserve_vertices(std::size_t count) { place_.reserve(count); }
    /// Makes vertices with numbers below `count` known from now on.
    void set_vertex_count(std::size_t count) { place_.resize(count); }

    /// Forgets the last star. The ghost, vertex -1, has place 0.
    void clear() { count_ = 1; }

    /// Returns the place of a vertex. `is_new` is true if it is asked for the first time since clear().
    Place place(std::int32_t vertex, bool& is_new) {
        if (vertex < 0) return 0;
        Place& place = place_[vertex];
        is_new = place >= count_ || vertices_[place] != vertex;
        if (is_new) {
            place = static_cast<Place>(count_);
            if (count_ < most_places) vertices_[place] = vertex;
            ++count_;
        }
        return place;
    }
    bool is_large() const { return count_ > most_places; }

    /// Makes the table. To be called after all places are known and before at().
    void make_table() {
        stride_ = 32;
        while (stride_ < count_) stride_ *= 2;
        if (table_.size() < stride_ * stride_) table_.resize(stride_ * stride_);
    }
    std::int32_t& at(Place a, Place b) { return table_[a * stride_ + b]; }

 private:
    // Place of every vertex; valid if vertices_ agrees.
    std::vector<Place> place_;
    std::array<std::int32_t, most_places> vertices_ = {-1};  // vertices by place
    std::size_t count_ = 1;
    std::vector<std::int32_t> table_;
    std::size_t stride_ = 0;
};

}  // namespace kerf

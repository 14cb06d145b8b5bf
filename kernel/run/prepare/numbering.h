// Dense numbers of all vertices of the mesh, from counts alone.
#pragma once

#include <span>
#include <vector>

#include "cut/decompose/decomposition.h"

namespace kerf {

/// Numbers of vertices: those of the input come first, then those that each cut added, by node number, then the
/// interior ones of each leaf, in the order of the tree.
class VertexNumbering {
 public:
    /// `nodes`: all nodes of the tree, ascending by number.
    VertexNumbering(std::int64_t input_vertices, std::span<const TreeNode> nodes);

    /// Returns the number of a vertex of the input or of one that a cut has made, which the key must be of.
    std::int64_t global_id(Key key) const { return offset_of(key_node(key)) + key_index(key); }
    std::vector<std::int64_t> global_ids(const std::vector<Key>& keys) const;
    /// Returns the number of the first interior vertex of all leaves.
    std::int64_t surface_vertices() const { return end_; }

 private:
    std::int64_t offset_of(NodeId node) const;

    struct Offset {
        NodeId node;
        std::int64_t first;
    };
    std::vector<Offset> offsets_;  // ascending by node; the first is input_node
    std::int64_t end_ = 0;
};

}  // namespace kerf

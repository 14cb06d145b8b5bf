// Points, index triples and keys: the vocabulary that every folder of the kernel shares.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include "base/core/ids.h"

namespace kerf {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

/// Three vertex indices, counter-clockwise seen from outside of the body.
using Triangle = std::array<std::int32_t, 3>;

/// The largest number of facets of a surface, because its corners, three for each facet, are numbered by 32 bits.
inline constexpr std::int64_t most_facets = std::numeric_limits<std::int32_t>::max() / 3;

/// The two ends of an edge, the smaller vertex first.
using UndirectedEdge = std::array<std::int32_t, 2>;

constexpr UndirectedEdge undirected(std::int32_t a, std::int32_t b) {
    return a < b ? UndirectedEdge{a, b} : UndirectedEdge{b, a};
}

/// Four vertex indices a, b, c, d with det[b-a, c-a, d-a] > 0.
using Tetrahedron = std::array<std::int32_t, 4>;

/// The number of a node in the binary tree of the decomposition: the root is 1, the children of i are 2i and 2i+1.
using NodeId = Id<struct NodeIdTag>;

/// The node that is the whole body.
inline constexpr NodeId root_node(1);
/// The number that no node has, in places where a node may be missing, and above the root.
inline constexpr NodeId no_node(0);
/// The node in the Key of a thing that the input has made, and no cut.
inline constexpr NodeId input_node = no_node;

/// Returns the child on one side of the cut of a node: 0 is below, 1 above.
constexpr NodeId child_of(NodeId node, int side) { return NodeId(2 * node.value() + side); }
/// Returns both children of a node, that below its cut first.
constexpr std::array<NodeId, 2> halves_of(NodeId node) { return {child_of(node, 0), child_of(node, 1)}; }
/// Returns the node whose cut has made a node; no_node for the root.
constexpr NodeId parent_of(NodeId node) { return NodeId(node.value() / 2); }
/// Returns the side of its parent's cut on which a node lies, as child_of() takes it.
constexpr int side_of(NodeId node) { return node.value() % 2; }
/// Returns the other child of a node's parent.
constexpr NodeId sibling_of(NodeId node) { return NodeId(node.value() ^ 1); }
/// Returns the number of cuts between the root and a node.
constexpr int level_of(NodeId node) {
    int level = 0;
    for (; node > root_node; node = parent_of(node)) ++level;
    return level;
}
/// Whether `node` is `ancestor` or below it.
constexpr bool lies_below(NodeId node, NodeId ancestor) {
    while (node > ancestor) node = parent_of(node);
    return node == ancestor;
}

/// The name of a vertex or facet, which is the same in every part that holds it.
///
/// The upper half is the node whose cut made it (input_node: the input surface), the lower half its index there. Parts
/// match by key, never by coordinate.
using Key = std::int64_t;

constexpr Key make_key(NodeId node, std::int32_t index) {
    return (static_cast<Key>(node.value()) << 32) | static_cast<std::uint32_t>(index);
}
constexpr NodeId key_node(Key key) { return NodeId(key >> 32); }
/// Whether a vertex or facet is one of the input surface, or a piece of one. It does not follow that a facet lies on
/// the outer boundary, or has a patch (files/part/part.h): walls inside of a body are of the input, too.
constexpr bool is_of_input(Key key) { return key_node(key) == input_node; }
/// Whether a cut has made a vertex or facet, so that a facet has another part on its other side.
constexpr bool is_of_cut(Key key) { return key_node(key) != input_node; }
constexpr std::int32_t key_index(Key key) { return static_cast<std::int32_t>(key & 0xffffffff); }

}  // namespace kerf

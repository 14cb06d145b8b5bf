// Parts joined into fewer pieces, for programs with fewer processes.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "files/part/part.h"

namespace kerf {

/// A piece: the leaves [first, last) of the tree, in its order, and the node below which all of them lie.
struct PieceOfTree {
    NodeId id = root_node;
    std::int32_t first = 0, last = 0;
};

/// Divides the leaves, which are in the order of the tree, into so many pieces, 1 to the number of leaves: from the
/// root down, each node's pieces are shared among its children in proportion to their leaves.
std::vector<PieceOfTree> divide_leaves(const std::vector<NodeId>& leaves, std::int32_t pieces);

/// The pieces as parts of a mesh. Interfaces inside of a piece are gone, global numbers are as they were. A piece is
/// joined anew whenever it is loaded; memory: its parts. `parts` must outlive this.
class JoinedParts : public PartSource {
 public:
    /// The most tetrahedra, nodes or triangles of a piece, which have numbers of 32 bits.
    static constexpr std::int64_t most_of_piece = std::numeric_limits<std::int32_t>::max();

    /// Loads every part once. Throws Error(usage) for less than one piece or more than there are parts, and for a piece
    /// that would have more than `most` tetrahedra, vertices or triangles: for tetrahedra before a part is loaded.
    JoinedParts(const PartSource& parts, std::int32_t pieces, std::int64_t most = most_of_piece);

    const MeshOutline& outline() const override { return outline_; }
    Part load(PartIndex index) const override;
    /// Returns the walls of the parts: only boundary triangles ask for them, and those inside of a piece are gone.
    const RegionWalls& walls() const override { return parts_.walls(); }

 private:
    std::vector<NodeId> pieces_of(const std::vector<NodeId>& leaves) const;
    std::vector<PartIndex> indices_of(const std::vector<NodeId>& leaves) const;
    std::vector<NodeId> ids_of(const std::vector<PartIndex>& indices) const;
    template <class Group, class Item, class InPiece, class IdOf>
    std::vector<Group> join_groups(const std::vector<Part>& parts, std::vector<Group> PartBoundary::*groups,
                                   std::vector<Item> Group::*items, const InPiece& in_piece, const IdOf& id) const;

    const PartSource& parts_;
    std::vector<PieceOfTree> pieces_;
    std::vector<std::pair<NodeId, NodeId>> piece_of_leaf_;  // ascending by leaf
    MeshOutline outline_;
};

}  // namespace kerf

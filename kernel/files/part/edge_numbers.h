// The global numbers of the nodes on edges.
#pragma once

#include <cstdint>
#include <vector>

#include "files/part/part.h"
#include "fill/mesh/edge_table.h"

namespace kerf {

/// Numbers the edges of a mesh: behind its vertices, part after part in the order of the tree. An edge belongs to the
/// first of the parts that hold it. The edges of its own that a part has are numbered one behind the other: first those
/// that it shares, group after group in the order of Part::shared_edges, then the others, ascending. The numbers are
/// the same for any number of ranks and workers. In a mesh that is not whole, missing parts own nothing.
class EdgeNumbers {
 public:
    /// Edges that a part owns and shares.
    struct OwnedGroup {
        std::vector<NodeId> parts;  ///< the same as SharedEdgeGroup::parts
        std::int64_t edges = 0;

        template <class Archive>
        void archive(Archive& a) {
            a(parts, edges);
        }
    };
    /// The counts of a part that the numbers of others depend on.
    struct OfPart {
        std::int64_t edges = 0;  ///< edges of all its tetrahedra
        std::int64_t owned = 0;
        std::vector<OwnedGroup> groups;  ///< in the order of Part::shared_edges

        template <class Archive>
        void archive(Archive& a) {
            a(edges, owned, groups);
        }
    };
    /// Returns the counts of a part, which must have everything. `edges`: its edges. O(#shared edges).
    static OfPart told_by(const Part& part, const EdgeTable& edges, const MeshOutline& outline) {
        return told_by(part.id, part.shared_edges, std::ssize(edges), outline);
    }
    /// Returns the counts of the part with this number, that has so many edges and shares these.
    static OfPart told_by(NodeId id, const std::vector<SharedEdgeGroup>& shared, std::int64_t edges,
                          const MeshOutline& outline);

    EdgeNumbers() = default;

    /// Takes the counts of all parts, in the order of the outline.
    EdgeNumbers(const MeshOutline& outline, const std::vector<OfPart>& told);

    /// Returns the number of distinct edges of the whole mesh.
    std::int64_t total() const { return total_; }
    /// Returns the number of edges of a part, with those that others own.
    std::int64_t count_of(PartIndex index) const { return counts_[index]; }
    /// Returns the global number of each edge of this part. O(#E).
    std::vector<std::int64_t> of(const Part& part, const EdgeTable& edges) const;

 private:
    /// The first number of a group's edges.
    struct Group {
        std::vector<NodeId> parts;
        std::int64_t first = 0;
    };
    std::int64_t first_of_group(const std::vector<NodeId>& parts) const;

    Array<PartIndex, NodeId> part_ids_;         // in the order of the tree
    Array<PartIndex, std::int64_t> first_own_;  // first number of the edges that no other part has
    Array<PartIndex, std::int64_t> counts_;
    std::vector<Group> groups_;  // ascending by parts
    std::int64_t total_ = 0;
};

/// Returns the numbers of all edges of these parts, each of which is loaded once.
EdgeNumbers number_edges(const PartSource& parts);

}  // namespace kerf

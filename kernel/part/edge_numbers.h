// The global numbers of the nodes on edges.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/edge_table.h"
#include "part/part.h"

namespace kerf {

/// Numbers the edges of a mesh: after its vertices, part after part in the order of the tree. An edge belongs to the
/// first of the parts that hold it; a part's own ones follow each other: first those that it shares, group after group
/// in the order of Part::shared_edges, then the others, ascending. The same for any number of ranks and workers. Of a
/// mesh that is not whole, parts that are missing own nothing.
class EdgeNumbers {
 public:
    /// Edges that a part owns and shares.
    struct OwnedGroup {
        std::vector<NodeId> parts;  ///< as SharedEdgeGroup::parts
        std::int64_t edges = 0;

        template <class Archive>
        void archive(Archive& a) {
            a(parts, edges);
        }
    };
    /// What the others have to know of a part.
    struct OfPart {
        std::int64_t edges = 0;  ///< of all its tetrahedra
        std::int64_t owned = 0;
        std::vector<OwnedGroup> groups;  ///< in the order of Part::shared_edges

        template <class Archive>
        void archive(Archive& a) {
            a(edges, owned, groups);
        }
    };
    /// Of a part with everything. `edges`: its edges. O(#shared edges).
    static OfPart told_by(const Part& part, const EdgeTable& edges, const MeshOutline& outline) {
        return told_by(part.id, part.shared_edges, std::ssize(edges), outline);
    }
    /// The same of the part with this number, that has so many edges and shares these.
    static OfPart told_by(NodeId id, const std::vector<SharedEdgeGroup>& shared, std::int64_t edges,
                          const MeshOutline& outline);

    EdgeNumbers() = default;

    /// `told`: of all parts in the order of the outline.
    EdgeNumbers(const MeshOutline& outline, const std::vector<OfPart>& told);

    /// Distinct edges of the whole mesh.
    std::int64_t total() const { return total_; }
    /// All edges of a part, with those that others own.
    std::int64_t count_of(PartIndex index) const { return counts_[index]; }
    /// The global number of each edge of this part. O(#E).
    std::vector<std::int64_t> of(const Part& part, const EdgeTable& edges) const;

 private:
    /// The first number of a group's edges.
    struct Group {
        std::vector<NodeId> parts;
        std::int64_t first = 0;
    };
    std::int64_t first_of_group(const std::vector<NodeId>& parts) const;

    Array<PartIndex, NodeId> part_ids_;         // in the order of the tree
    Array<PartIndex, std::int64_t> first_own_;  // of edges that no other part has
    Array<PartIndex, std::int64_t> counts_;
    std::vector<Group> groups_;  // ascending by parts
    std::int64_t total_ = 0;
};

/// The numbers of all edges of these parts, each of which is loaded once.
EdgeNumbers number_edges(const PartSource& parts);

}  // namespace kerf

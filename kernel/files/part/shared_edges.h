// The edges that the parts of a mesh have in common.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "files/part/part.h"
#include "files/part/part_indices.h"

namespace kerf {

/// The edges on interfaces, each with the parts that hold it. Two parts may have both ends of an edge in common and not
/// the edge. Around an edge that several parts hold each of them meets the next one in an interface, so that a part
/// knows its neighbours there, but not theirs. Therefore only two kinds of edges are told: those that some part shares
/// with two others or more, and those at which bodies touch (Part::contact_edges), by all that have them. For an edge
/// that is told, each part that holds it is named.
class SharedEdges {
 public:
    /// An edge and a part that holds it; a pair may be named more than once.
    struct Incidence {
        std::array<std::int64_t, 2> edge;  ///< global numbers of its ends, the smaller one first
        NodeId part;
        auto operator<=>(const Incidence&) const = default;

        template <class Archive>
        void archive(Archive& a) {
            a(edge, part);
        }
    };

    /// Returns the incidences that a part tells the others: at edges where it meets several parts, itself and all that
    /// it meets there, and itself at edges of contacts. `part`: whole, or its surface. O(#F log #F).
    static std::vector<Incidence> incidences_of(const Part& part);

    SharedEdges() = default;
    /// Takes the incidences that all parts tell, or at least those at edges of the parts whose groups are asked for.
    /// `ids`: the numbers of all parts, in the order of the tree. O(n log n).
    SharedEdges(std::vector<Incidence> told, const std::vector<NodeId>& ids);

    /// Returns the value of Part::shared_edges for this part. O(#F log #F).
    std::vector<SharedEdgeGroup> groups_of(const Part& part) const;

 private:
    std::vector<Incidence> incidences_;  // ascending by edge, then part
    Array<PartIndex, NodeId> ids_;
    PartIndices index_;
};

}  // namespace kerf

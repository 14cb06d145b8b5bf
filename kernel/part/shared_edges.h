// Which edges the parts of a mesh have in common.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "part/part.h"
#include "part/part_indices.h"

namespace kerf {

/// The edges on interfaces, each with the parts that hold it. Two parts may have both ends of an edge in common and not
/// the edge. Around an edge that several parts hold each of them meets the next one in an interface, so that a part
/// knows its neighbours there, but not theirs: only edges that some part shares with two others, or more, have to be
/// told, and those at which bodies touch (Part::contact_edges), by all that have them. Of an edge that is told, each
/// part that holds it is named.
class SharedEdges {
 public:
    /// An edge and a part that holds it; may be named more than once.
    struct Incidence {
        std::array<std::int64_t, 2> edge;  ///< global numbers of its ends, the smaller one first
        NodeId part;
        auto operator<=>(const Incidence&) const = default;

        template <class Archive>
        void archive(Archive& a) {
            a(edge, part);
        }
    };

    /// What the others have to know of a part: the edges where it meets several, with all that it meets there and
    /// itself, and the edges of contacts. Of a part or its surface. O(#F log #F).
    static std::vector<Incidence> incidences_of(const Part& part);

    SharedEdges() = default;
    /// `told`: what all parts tell, or at least that of the edges of which a part is named whose groups are asked for.
    /// `ids`: those of all parts. O(n log n).
    SharedEdges(std::vector<Incidence> told, const std::vector<NodeId>& ids);

    /// The value of Part::shared_edges for this part. O(#F log #F).
    std::vector<SharedEdgeGroup> groups_of(const Part& part) const;

 private:
    std::vector<Incidence> incidences_;  // ascending by edge, then part
    Array<PartIndex, NodeId> ids_;
    PartIndices index_;
};

}  // namespace kerf

// The vertices that the parts of a mesh have in common.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "files/part/part.h"

namespace kerf {

/// The vertices on interfaces, each with the parts that hold it. A vertex that several parts hold lies on an interface
/// of each of them, because a body that is cut at a vertex is cut through it, or it is a vertex at which bodies touch
/// (Part::contact_vertices).
class SharedVertices {
 public:
    /// A vertex of an interface or of a contact, and a part that has it there; a pair may be named more than once.
    struct Incidence {
        std::int64_t vertex;  ///< global number
        PartIndex part;
        auto operator<=>(const Incidence&) const = default;

        template <class Archive>
        void archive(Archive& a) {
            a(vertex, part);
        }
    };

    SharedVertices() = default;
    /// Takes the incidences of all parts, or at least those at vertices of the parts whose groups are asked for. `ids`:
    /// the numbers of all parts. O(n log n).
    SharedVertices(std::vector<Incidence> held, const std::vector<NodeId>& ids);

    /// Returns the value of Part::shared for a part. `boundary_ids`: global numbers of its boundary vertices.
    std::vector<SharedGroup> groups_of(PartIndex index, std::span<const std::int64_t> boundary_ids) const;

 private:
    std::vector<Incidence> held_;  // ascending by vertex, then part; only vertices of several parts
    Array<PartIndex, NodeId> ids_;
};

}  // namespace kerf

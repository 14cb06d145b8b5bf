// The laws of nodes on edges, from the files of a run.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "files/part/part.h"
#include "run/report/report.h"

namespace kerf {

/// Checks the nodes of a mesh of order 2, whose parts it is shown one at a time. An edge has the same node in all
/// parts, global numbers are dense behind those of the vertices, and every curved cell is proven valid
/// (fill/mesh/curved_tet.h). Memory: that of edges on interfaces.
class EdgeNodeCheck {
 public:
    /// Takes the nodes and cells of a part, which must have been loaded with its nodes on edges.
    void add(const Part& part);
    /// Takes over the parts that another check was shown, as if they had been shown to this one after its own.
    void add(const EdgeNodeCheck& of_others);
    /// Ends the check when all parts were shown: adds all that is broken to `laws`. `vertices`: number of the mesh's
    /// vertices.
    void finish(std::int64_t vertices, RunVerification& laws);

    /// Numbers of distinct nodes on edges, and of those among them that are not in the middle of their edges; valid
    /// once finished.
    std::int64_t count() const { return count_; }
    std::int64_t curved() const { return curved_; }

 private:
    struct Node {
        std::array<std::int64_t, 2> edge;  // global numbers of its ends, the smaller one first
        std::int64_t id;
        Vec3 point;
        bool is_curved;
    };
    using Range = std::array<std::int64_t, 2>;  // first number, last + 1

    std::vector<bool> edges_of_others(const Part& part) const;
    void add_own(std::int64_t id, bool is_curved);
    void add_own(const Range& ids);
    static std::int64_t count_invalid(const Part& part, const std::vector<bool>& is_curved);

    std::vector<Node> shared_;  // nodes on interfaces and contacts, where other parts may have them, too
    std::vector<Range> own_;    // numbers of all other nodes
    std::int64_t count_ = 0, curved_ = 0, invalid_cells_ = 0;
};

}  // namespace kerf

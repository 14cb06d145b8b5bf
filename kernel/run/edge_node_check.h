// The laws of nodes on edges, from the files of a run.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "part/part.h"
#include "report/report.h"

namespace kerf {

/// Is shown the parts of a mesh of order 2, one at a time. An edge has the same node in all parts, global numbers are
/// dense behind those of the vertices, and every curved cell is proven valid (mesh/curved_tet.h). Memory: that of edges
/// on interfaces.
class EdgeNodeCheck {
 public:
    /// Of a part with everything.
    void add(const Part& part);
    /// What another check was shown, as if it had been shown behind what this one was.
    void add(const EdgeNodeCheck& of_others);
    /// When all were shown; `vertices`: of the mesh. Adds what is broken to the laws.
    void finish(std::int64_t vertices, RunVerification& laws);

    /// Distinct nodes on edges, and those of them that are not in the middle of their edges, once finished.
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

    std::vector<Node> shared_;  // on interfaces and contacts, where other parts may have them, too
    std::vector<Range> own_;    // numbers of the others
    std::int64_t count_ = 0, curved_ = 0, invalid_cells_ = 0;
};

}  // namespace kerf

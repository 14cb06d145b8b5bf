// The cells of other parts around a part.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "files/export/whole_mesh.h"
#include "files/part/part.h"

namespace kerf {

/// A cell of another part that shares a vertex with the part.
struct GhostCell {
    std::int64_t number;  ///< among the cells of all parts, from 0 (MeshOutline::first_tet())
    PartIndex part;
    CellNodes nodes;
};

/// A node of ghost cells that the part itself does not have.
struct GhostNode {
    std::int64_t id;  ///< global number
    Vec3 point;
};

struct Ghosts {
    std::vector<GhostCell> cells;  ///< ascending by number
    std::vector<GhostNode> nodes;  ///< ascending by id
};

struct GhostLayer;

/// Finds the ghosts of parts of one source, one part after the other. The cells of a part at vertices that it shares,
/// its layer, may be ghosts of any neighbour, all of which ask for them: the layer of each part that was loaded is
/// kept, 20 bytes a cell and 32 a node, up to a limit; the layer that was not asked for the longest goes first.
class GhostFinder {
 public:
    explicit GhostFinder(std::size_t most_bytes = std::size_t{256} << 20);
    ~GhostFinder();

    /// Returns the ghosts of a part. From any thread. Throws Error(io). Cost: loads the parts that share a vertex with
    /// this one and whose layer is not kept, one at a time; parts in the order of the tree have most neighbours in
    /// common.
    Ghosts ghosts_of(const PartSource& parts, const Part& part);

 private:
    struct Slot {
        std::shared_ptr<const GhostLayer> layer;
        bool is_loading = false;
        std::int64_t last_use = 0;
    };

    std::shared_ptr<const GhostLayer> layer_of(const PartSource& parts, PartIndex index);
    void forget_others(const Slot& kept);

    const std::size_t most_bytes_;
    std::mutex mutex_;
    std::condition_variable loaded_;
    Array<PartIndex, Slot> slots_;
    std::size_t bytes_ = 0;
    std::int64_t uses_ = 0;
};

}  // namespace kerf

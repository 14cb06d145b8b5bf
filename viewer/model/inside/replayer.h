// The surfaces of the nodes of a trace, each made from that of its parent, which is kept for the next one.
#pragma once

#include <list>
#include <map>
#include <memory>

#include "run/run/trace.h"

namespace kerf::view {

/// Makes the same surfaces as replay(). Belongs to one thread; the surfaces that it returns are shared.
class Replayer {
 public:
    /// `limit_bytes` bounds the estimated memory of the surfaces that are kept; the last one is kept in any case.
    Replayer(std::shared_ptr<const Trace> trace, std::size_t limit_bytes);

    /// Takes a trace that differs from the other's only at and below `node`, and the surfaces that the other keeps of
    /// the rest.
    Replayer(const Replayer& other, std::shared_ptr<const Trace> trace, NodeId node);
    Replayer(const Replayer&) = delete;
    Replayer& operator=(const Replayer&) = delete;

    const std::shared_ptr<const Trace>& trace() const { return trace_; }

    /// Returns the surface to whose numbers the cut of the node refers. O(#F) if the parent is kept. Throws
    /// Error(usage) if the tree has no such node.
    std::shared_ptr<const Surface> surface(NodeId node);
    /// Returns the surface of the node before a straight cut has split its facets: the surface that was there to be
    /// cut.
    std::shared_ptr<const Surface> uncut_surface(NodeId node);

 private:
    struct Entry {
        NodeId node;
        std::shared_ptr<const Surface> surface;
        std::size_t bytes;
    };
    std::shared_ptr<const Surface> keep(NodeId node, std::shared_ptr<const Surface> surface);

    std::shared_ptr<const Trace> trace_;
    std::list<Entry> entries_;  // the most recently used first
    std::map<NodeId, std::list<Entry>::iterator> places_;
    std::size_t limit_, bytes_ = 0;
};

}  // namespace kerf::view

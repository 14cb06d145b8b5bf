// The surfaces of the nodes of a trace, each made from that of its parent, which is kept for the next.
#pragma once

#include <list>
#include <map>
#include <memory>

#include "run/trace.h"

namespace kerf::view {

/// Gives what replay() gives. Belongs to one thread; what it returns is shared.
class Replayer {
 public:
    /// `limit_bytes` bounds what is kept beyond the nodes above the last one asked for.
    Replayer(std::shared_ptr<const Trace> trace, std::size_t limit_bytes);

    /// Of a trace that differs from the other's only at and below `node`; takes over what the other keeps of the rest.
    Replayer(const Replayer& other, std::shared_ptr<const Trace> trace, NodeId node);
    Replayer(const Replayer&) = delete;
    Replayer& operator=(const Replayer&) = delete;

    const std::shared_ptr<const Trace>& trace() const { return trace_; }

    /// The surface whose numbers the cut of the node refers to. O(#F) if the parent is kept. Throws Error(usage) if the
    /// tree has no such node.
    std::shared_ptr<const Surface> surface(NodeId node);
    /// The same before a straight cut has split its facets: the surface that was there to be cut.
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

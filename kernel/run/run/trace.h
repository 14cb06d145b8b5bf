// A run that can be looked at again elsewhere: its surface, its options and every cut with all that was tried.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel/communicator.h"
#include "run/prepare/input.h"
#include "run/request/run_request.h"

namespace kerf {

/// The record that --trace writes. It depends on input, options and K alone: not on ranks, workers or time.
struct Trace {
    std::string input;      ///< path of the surface file, as it was given
    SurfaceArrays surface;  ///< the surface that was cut: welded and oriented; of several regions each facet once
    std::vector<FacetSides> sides;          ///< sides of its facets, empty for one region
    std::vector<std::string> region_names;  ///< names of several regions; empty for one
    std::vector<NodeId> region_roots;       ///< node that is the whole of each region; empty for one
    bool remeshed = false;                  ///< whether the surface is not that of the file, but Input::remeshed
    std::vector<std::string> patch_names;   ///< names by number of surface.patch
    std::vector<std::array<std::uint8_t, 4>> patch_colours;  ///< colours of the patches, as in Input
    std::vector<OptionText> options;  ///< options that shape the parts, with the choices of the run
    std::vector<Cut> cuts;  ///< cuts of all nodes where one was tried, ascending by number; recorded, with seconds 0

    /// Returns the cut of a node, nullptr if none was tried there. O(log #cuts).
    const Cut* find(NodeId node) const;
    /// Returns the surface of a node above which nothing was cut: that of a region, or of node 1 if there is only one
    /// region; nothing for another node.
    std::optional<Surface> root_surface(NodeId node) const;
    /// Returns whether a node holds several regions, so that it is divided without a cut and has no surface of
    /// half-edges.
    bool holds_regions(NodeId node) const;
    /// Returns the facets that have a region of such a node on exactly one side, turned outwards. O(#F + #regions).
    SurfaceArrays outside_of_regions(NodeId node) const;

    template <class Archive>
    void archive(Archive& a) {
        a(input, surface, sides, region_names, region_roots, remeshed, patch_names, patch_colours, options, cuts);
    }
};

/// Returns the surface of a node of the tree, with the vertex and facet numbers that its Cut refers to: the splits of
/// the nodes above are done again, O(#F) for each. A node with a straight cut comes with its facets split. Throws
/// Error(usage) if the tree has no such node, or it holds several regions.
Surface replay(const Trace& trace, NodeId node);

/// Writes a trace into a file, and replaces an older one. Throws Error(io).
void write_trace(const std::string& path, const Trace& trace);

/// Reads a trace. Throws Error(io) if the file cannot be read, is no trace, was written by another version or a machine
/// of another byte order, is truncated or damaged.
Trace read_trace(const std::string& path);

/// Keeps the cuts that decompose() makes on one rank. Calls may come in any order, one at a time.
class TraceRecorder : public CutListener {
 public:
    /// `next`, unless null, is told of every cut, too.
    TraceRecorder(const RunRequest& options, const Input& input, CutListener* next);
    void on_cut(const Surface& parent, const Cut& cut) override;
    bool cancelled() const override { return next_ && next_->cancelled(); }

    /// Brings the cuts of all ranks together and writes them on the root rank. Collective. `own`: the result of
    /// decompose() for `range` on this rank; where several ranks made the same cut, the one with its first leaf gives
    /// it. Throws Error(io) on all ranks.
    void write(const std::string& path, Communicator& ranks, const Decomposition& own, LeafRange range);

 private:
    Trace trace_;
    CutListener* next_;
};

}  // namespace kerf

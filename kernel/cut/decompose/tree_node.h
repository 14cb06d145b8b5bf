// A node of the tree of a decomposition, without its surface.
#pragma once

#include <span>

#include "base/core/ids.h"
#include "cut/cut/bisect.h"

namespace kerf {

/// A node of the tree once it has been cut; in a part, the summary is that of the cuts that were tried in vain.
struct TreeNode : CutSummary {
    NodeId id = root_node;
    std::int32_t first_leaf = 0;  ///< first of the leaves below it, in the order of the tree
    std::int32_t leaves = 1;      ///< number of leaves wanted below it
    std::int32_t regions = 1;     ///< number of regions in it; a node of several is divided into those of both halves,
                                  ///< without a cut
    RegionIndex region;           ///< the region, if there is only one
    std::int32_t vertices = 0;
    std::int32_t facets = 0;
    MassProperties mass;
    bool cut_made = false;
    bool cut_tried = false;
    std::int32_t interface_vertices = 0;  ///< interior vertices of the interface, which this cut added
    FileHash cut_hash = {0, 0};  ///< of all data below that follow from the cut: equal on all ranks; {0, 0}: no cut

    /// Whether the node has children.
    bool is_divided() const { return cut_made || regions > 1; }

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, regions, region, vertices, facets, mass.volume, mass.area, mass.centroid);
        for (int i = 0; i < 9; ++i) a(mass.inertia.data()[i], mass.axes.data()[i]);
        a(mass.eigenvalues, cut_made, cut_tried, interface_vertices, cut_hash);
        CutSummary::archive(a);
    }
};

/// Returns the halves below and above the cut of a node. Throws Error(usage) if the tree gets deeper than nodes can be
/// numbered: 30 cuts one below the other.
std::array<NodeId, 2> children_of(NodeId node);

/// Returns a node before it is cut.
TreeNode describe_node(NodeId id, std::int32_t first_leaf, std::int32_t leaves, const Surface& surface,
                       const MassProperties& mass);

/// Fills the members of the node that a cut, made or not, determines.
void describe_cut(const Cut& cut, TreeNode& node);

/// Adds further data that follow from the cut to its hash.
template <class T>
void add_to_cut_hash(TreeNode& node, std::span<const T> items) {
    Hasher hasher;
    hasher.add(std::span<const std::uint64_t>(node.cut_hash));
    hasher.add(items);
    node.cut_hash = hasher.digest();
}

/// Returns how many of `leaves` >= 2 the half below gets: in proportion to the loads of the halves, but at least one
/// for each half. Equidistant cuts know no load, and give it half of the leaves.
std::int32_t leaves_below(const std::array<double, 2>& load, std::int32_t leaves, const CutOptions& options);

/// Returns the share of the load that should lie below the cut of a node with this many leaves.
inline double fraction_below(std::int32_t leaves) { return static_cast<double>(leaves / 2) / leaves; }

}  // namespace kerf

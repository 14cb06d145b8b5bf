// A node of the tree of a decomposition, without its surface.
#pragma once

#include <span>

#include "core/ids.h"
#include "cut/bisect.h"

namespace kerf {

/// What is kept of a node of the tree once it has been cut; of a part, the summary is that of cuts tried in vain.
struct TreeNode : CutSummary {
    NodeId id = 1;
    std::int32_t first_leaf = 0;  ///< of the leaves below it, in the order of the tree
    std::int32_t leaves = 1;      ///< wanted below it
    std::int32_t regions = 1;     ///< in it; a node of several is divided into those of both halves, without a cut
    RegionIndex region;           ///< of a node of one
    std::int32_t vertices = 0;
    std::int32_t facets = 0;
    MassProperties mass;
    bool cut_made = false;
    bool cut_tried = false;
    std::int32_t interface_vertices = 0;  ///< interior ones, which this cut added
    FileHash cut_hash = {0, 0};  ///< of all below that follows from the cut: equal on all ranks; {0, 0}: none was made

    /// Whether there are nodes below it.
    bool is_divided() const { return cut_made || regions > 1; }

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, regions, region, vertices, facets, mass.volume, mass.area, mass.centroid);
        for (int i = 0; i < 9; ++i) a(mass.inertia.data()[i], mass.axes.data()[i]);
        a(mass.eigenvalues, cut_made, cut_tried, interface_vertices, cut_hash);
        CutSummary::archive(a);
    }
};

/// The halves below and above the cut of a node. Throws Error(usage) where the tree gets deeper than its nodes can be
/// numbered: 30 cuts one below the other.
std::array<NodeId, 2> children_of(NodeId node);

/// A node before it is cut.
TreeNode describe_node(NodeId id, std::int32_t first_leaf, std::int32_t leaves, const Surface& surface,
                       const MassProperties& mass);

/// Fills what a cut, made or not, tells of its node.
void describe_cut(const Cut& cut, TreeNode& node);

/// Adds to the hash of a cut what else follows from it.
template <class T>
void add_to_cut_hash(TreeNode& node, std::span<const T> items) {
    Hasher hasher;
    hasher.add(std::span<const std::uint64_t>(node.cut_hash));
    hasher.add(items);
    node.cut_hash = hasher.digest();
}

/// How many of `leaves` >= 2 the half below gets: in proportion to the loads of the halves, at least one each.
/// Equidistant cuts know no load and give it one half.
std::int32_t leaves_below(const std::array<double, 2>& load, std::int32_t leaves, const CutOptions& options);

/// The share of the load that a node with this many leaves leaves below its cut.
inline double fraction_below(std::int32_t leaves) { return static_cast<double>(leaves / 2) / leaves; }

}  // namespace kerf

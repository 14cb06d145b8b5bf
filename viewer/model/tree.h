// The tree of the decomposition as the viewer shows it, from a trace, a report, or the events of a run under way.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cut/cut/cut.h"

namespace kerf::view {

enum class NodeState {
    divided,  ///< an inner node
    waiting,  ///< a part that is not meshed (yet)
    meshing,
    done,
    failed,
};
const char* name(NodeState state);

/// One node of the tree. Facts that are not known are negative, or empty.
struct TreeRow {
    NodeId id = root_node;
    NodeState state = NodeState::waiting;
    std::int32_t leaves = 1;
    std::int64_t vertices = -1, facets = -1, tets = -1;
    double volume = -1, load = -1;
    double seconds = -1;                       ///< seconds of meshing a part, or of cutting an inner node
    std::int32_t rank = -1;                    ///< the rank that meshed it
    RegionIndex region = RegionIndex::none();  ///< the region in which all of it lies, where there are several
    std::int32_t regions = 1;                  ///< number of regions in it: a node of several is divided without a cut
    std::string filled_by;                     ///< for a part: see name_of_filler()
    std::int64_t core_tets = 0;                ///< for a part: Filling::core_tets
    std::string message;                       ///< reason why it failed
    std::optional<Vec3> centroid;
    Vec3 eigenvalues = Vec3::Zero();
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns, in the order of the eigenvalues
    std::optional<CutSummary> cut;                       ///< the cut that was made, or tried in vain

    bool leaf() const { return state != NodeState::divided; }
    /// Returns the plane of the cut, if one was made and is known; else null.
    const Plane* plane() const { return cut && cut->made() ? &cut->plane : nullptr; }
};

/// Returns the words for a part's filler: the way that its mesher went, or the mesher where it has one way.
std::string name_of_filler(const std::string& mesher, const std::string& strategy);

/// The tree of a decomposition: rows ascending by number.
struct Tree {
    std::vector<TreeRow> rows;

    const TreeRow* find(NodeId id) const;
    TreeRow* find(NodeId id);
    /// Returns the row of a node, which is made if there is none.
    TreeRow& at(NodeId id);
    /// Returns the parts below a node, itself included, ascending.
    std::vector<NodeId> parts_below(NodeId node) const;
    /// Returns the rows in depth-first order, parents first: as a tree is read.
    std::vector<const TreeRow*> in_order() const;
    int levels() const;
};

}  // namespace kerf::view

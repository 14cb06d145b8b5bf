// Recursive bisection of a closed surface into the surfaces of its subdomains.
#pragma once

#include <utility>
#include <vector>

#include "cut/decompose/tree_node.h"
#include "surface/complex/complex.h"
#include "surface/size/region_sizes.h"

namespace kerf {

/// The treatment of the input's facets where no contour of edges divides a part.
enum class FacetPolicy {
    keep,   ///< the part stays whole
    split,  ///< facets are split by a straight cut
};

struct DecomposeOptions {
    std::int32_t parts = 8;  ///< K >= 1, any whole number
    FacetPolicy facets = FacetPolicy::split;
    CutOptions cut;
    std::int32_t threads = 1;       ///< 1: halves are cut one after the other; else on the threads that are free
    RegionSizes region_sizes = {};  ///< for regions that have other sizes than `cut`

    /// The options of cuts in a region.
    CutOptions cut_in(RegionIndex region) const;
};

/// The least number of facets that a part should have; for a part below twice this number no contour of edges is
/// sought.
inline constexpr std::int32_t min_facets_per_part = 50;

/// The closed surface of one subdomain.
struct Leaf {
    NodeId id = root_node;
    std::int32_t first_leaf = 0;  ///< as in TreeNode
    std::int32_t leaves = 1;      ///< more than one: the part should have been cut, but has no contour of edges
    double volume = 0;            ///< enclosed volume
    RegionIndex region;           ///< region in which it lies
    SurfaceArrays surface;

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, volume, region, surface);
    }
};

/// A piece of an input facet that straight cuts have split. The pieces of a facet cover it and have its key.
struct DividedFacet {
    std::int32_t facet = 0;
    std::array<Vec3, 3> corners;  ///< counter-clockwise seen from outside of the part
    NodeId part = root_node;      ///< the part that was divided, or one beside it
    RegionIndex region;           ///< of the part
};

/// A receiver of every cut while its data is at hand: one call at a time, from any thread. With several threads cuts
/// arrive in any order, but parents before children.
class CutListener {
 public:
    virtual ~CutListener() = default;
    /// Called for every cut, made or not. A node without a contour of edges may come twice: the second time with a
    /// straight cut and a parent whose facets are split.
    virtual void on_cut(const Surface& parent, const Cut& cut) = 0;
    /// Whether on_cut() is wanted: recording the stages of every cut costs memory.
    virtual bool wants_cuts() const { return true; }
    /// Asked before every cut, from any thread; once it returns true, decompose() ends with Error(cancelled).
    virtual bool cancelled() const { return false; }
};

/// A range [first, last) of leaves in the order of the tree.
struct LeafRange {
    std::int32_t first = 0, last = 0;
    bool contains(std::int32_t leaf) const { return leaf >= first && leaf < last; }
    bool meets(std::int32_t begin, std::int32_t count) const { return begin < last && begin + count > first; }
};

/// A node with its whole subtree, before it is cut.
struct Branch {
    NodeId id = root_node;
    std::int32_t first_leaf = 0, leaves = 1;
    RegionIndex region;  ///< region in which it lies

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, region);
    }
};

/// The receiver of halves and parts that concern other ranges. A branch belongs to the range that contains its first
/// leaf. Called on any thread, also on several at a time.
class OtherRanges {
 public:
    virtual ~OtherRanges() = default;
    /// Takes a half that belongs to another range.
    virtual void take(const Branch& half, Surface surface) = 0;
    /// Tells that these leaves are one part, that of the first of them: the other leaves will not exist.
    virtual void are_one_part(const LeafRange& leaves) = 0;
};

struct Decomposition {
    std::vector<TreeNode> nodes;               ///< visited nodes, depth first; by number from divide_straight()
    std::vector<Leaf> leaves;                  ///< leaves of the range, in the order of the tree
    std::vector<DividedFacet> divided_facets;  ///< ascending by facet
    Contacts contacts;                         ///< between all leaves of the tree, in the range or not
};

/// Cuts the surface, which must not be empty, into options.parts subdomains and returns those of `range`; only branches
/// that lead to them are descended. A node that wants k leaves is cut at floor(k/2)/k of the load; the halves then get
/// leaves in proportion to the load that they have. A part that cannot be cut stays whole, so that there may be fewer
/// leaves than wanted; it belongs to the range that contains its first leaf. The result depends on surface and options
/// only, not on the range, listener or threads. Cost n + n/2 + n/4 + ... for a single leaf, n log K for all.
Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener = nullptr);

/// Cuts the regions of a complex, each into at least one of options.parts subdomains: above the roots of the regions
/// are nodes that share them out (cut/decompose/inside/region_tree.h). No cut crosses a wall, and no part has cells of
/// two regions. Half-edges are built only for regions that have leaves in the range. Throws Error(input) for a region
/// without volume. All else is as for a surface.
Decomposition decompose(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener = nullptr);

/// Cuts a branch that belongs to `range`, down to its leaves there. Each cut is made by the range that its node belongs
/// to, and by no other: halves that belong elsewhere go to `others`. All ranges together have the nodes and leaves of
/// decompose(), bit for bit. The cost is that of the nodes that belong to the range.
Decomposition decompose_branch(Surface surface, const Branch& branch, const DecomposeOptions& options, LeafRange range,
                               OtherRanges& others, CutListener* listener = nullptr);

/// Does the work of decompose_branch() for all branches that are a whole region and belong to `range`, and returns them
/// with the nodes above them.
Decomposition decompose_regions(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                                OtherRanges& others, CutListener* listener = nullptr);

}  // namespace kerf

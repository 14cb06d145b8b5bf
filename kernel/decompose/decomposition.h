// Recursive bisection of a closed surface into the surfaces of its subdomains.
#pragma once

#include <utility>
#include <vector>

#include "decompose/tree_node.h"
#include "size/region_sizes.h"
#include "surface/complex.h"

namespace kerf {

/// What may happen to the facets of the input where no contour of edges divides a part.
enum class FacetPolicy {
    keep,   ///< the part stays whole
    split,  ///< facets are split by a straight cut
};

struct DecomposeOptions {
    std::int32_t parts = 8;  ///< K >= 1, any whole number
    FacetPolicy facets = FacetPolicy::split;
    CutOptions cut;
    std::int32_t threads = 1;       ///< 1: halves follow each other; else they share the threads that are free
    RegionSizes region_sizes = {};  ///< of regions that have other sizes than `cut`

    /// The options of cuts in a region.
    CutOptions cut_in(RegionIndex region) const;
};

/// No part should have fewer facets; a part below twice this number has no contour of edges that is worth it.
inline constexpr std::int32_t min_facets_per_part = 50;

/// The closed surface of one subdomain.
struct Leaf {
    NodeId id = 1;
    std::int32_t first_leaf = 0;  ///< as in TreeNode
    std::int32_t leaves = 1;      ///< more than one: it should have been cut, but has no contour of edges
    double volume = 0;            ///< enclosed
    RegionIndex region;           ///< in which it lies
    SurfaceArrays surface;

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, volume, region, surface);
    }
};

/// A facet of the input that straight cuts have split: its pieces cover it and have its key.
struct DividedFacet {
    std::int32_t facet = 0;
    std::array<Vec3, 3> corners;  ///< counter-clockwise seen from outside of the part
    NodeId part = 1;              ///< that was divided, or one beside it
    RegionIndex region;           ///< of the part
};

/// Is told of every cut while its data is at hand: one call at a time, from any thread. On several threads cuts arrive
/// in any order, parents before children.
class CutListener {
 public:
    virtual ~CutListener() = default;
    /// A node where no contour of edges was found may be told of twice: then by a straight cut, whose parent comes with
    /// its facets split.
    virtual void on_cut(const Surface& parent, const Cut& cut) = 0;
    /// Whether on_cut() is wanted: recording the stages of every cut costs memory.
    virtual bool wants_cuts() const { return true; }
    /// Asked before every cut, from any thread. Once true, decompose() ends with Error(cancelled).
    virtual bool cancelled() const { return false; }
};

/// A range [first, last) of leaves in the order of the tree.
struct LeafRange {
    std::int32_t first = 0, last = 0;
    bool contains(std::int32_t leaf) const { return leaf >= first && leaf < last; }
    bool meets(std::int32_t begin, std::int32_t count) const { return begin < last && begin + count > first; }
};

/// A node and all below it, before it is cut.
struct Branch {
    NodeId id = 1;
    std::int32_t first_leaf = 0, leaves = 1;
    RegionIndex region;  ///< in which it lies

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, region);
    }
};

/// What of a branch is for others than those who cut it. A branch belongs to the range that has its first leaf. Called
/// on any thread, also on several at a time.
class OtherRanges {
 public:
    virtual ~OtherRanges() = default;
    /// A half that another range has.
    virtual void take(const Branch& half, Surface surface) = 0;
    /// These leaves are one part, that of the first of them: none of the others will be there.
    virtual void are_one_part(const LeafRange& leaves) = 0;
};

struct Decomposition {
    std::vector<TreeNode> nodes;               ///< visited ones, in depth-first order
    std::vector<Leaf> leaves;                  ///< those of the range, in the order of the tree
    std::vector<DividedFacet> divided_facets;  ///< ascending by facet
    Contacts contacts;                         ///< of all leaves of the tree, in the range or not
};

/// Cuts the surface, which must not be empty, into options.parts subdomains and returns those of `range`; only branches
/// that lead to them are descended. A node that wants k leaves is cut at floor(k/2)/k of the load; the halves then get
/// leaves in proportion to the load that they have. A part that cannot be cut stays whole, so that there may be fewer
/// leaves than wanted; it belongs to whoever owns its first leaf. The result depends on surface and options only, not
/// on the range, listener or threads. Cost n + n/2 + n/4 + ... for a single leaf, n log K for all.
Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener = nullptr);

/// The same for the regions of a complex, of which options.parts has one at least for each: above their roots are nodes
/// that divide them (decompose/region_tree.h). No cut crosses a wall, and no part has cells of two regions. Surfaces of
/// half-edges are made of those regions alone that have leaves in the range. Throws Error(input) for a region without
/// volume.
Decomposition decompose(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener = nullptr);

/// Cuts a branch that belongs to `range`, down to its leaves there. Each cut is made by the range that its node belongs
/// to, and by no other: halves that belong elsewhere go to `others`. Of all ranges together come the nodes and leaves
/// of decompose(), bit for bit. Costs as the nodes that belong to the range.
Decomposition decompose_branch(Surface surface, const Branch& branch, const DecomposeOptions& options, LeafRange range,
                               OtherRanges& others, CutListener* listener = nullptr);

/// The same for those branches that are the whole of a region and belong to `range`, with the nodes above them.
Decomposition decompose_regions(const Complex& complex, const DecomposeOptions& options, LeafRange range,
                                OtherRanges& others, CutListener* listener = nullptr);

}  // namespace kerf

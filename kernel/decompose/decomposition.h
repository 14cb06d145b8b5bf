// Recursive bisection of a closed surface into the surfaces of its subdomains.
#pragma once

#include <utility>
#include <vector>

#include "cut/bisect.h"

namespace kerf {

struct DecomposeOptions {
    std::int32_t parts = 8;  ///< K >= 1, any whole number
    CutOptions cut;
};

/// No part should have fewer facets; a part below twice this number is not cut.
inline constexpr std::int32_t min_facets_per_part = 50;

/// What is kept of a node of the tree once it has been cut.
struct TreeNode {
    NodeId id = 1;
    std::int32_t first_leaf = 0;  ///< of the leaves below it, in the order of the tree
    std::int32_t leaves = 1;      ///< wanted below it
    std::int32_t vertices = 0;
    std::int32_t facets = 0;
    MassProperties mass;
    bool cut_made = false;
    bool cut_tried = false;
    Plane plane;
    ContourMethod method = ContourMethod::min_cut;
    Rung rung = Rung::whole;
    std::int32_t tries = 0;
    std::int32_t loops = 0;
    std::int64_t contour_edges = 0;
    double contour_length = 0, max_deviation = 0, section_area = 0, interface_area = 0;
    std::int32_t interface_faces = 0;
    std::int32_t interface_vertices = 0;  ///< interior ones, which this cut added
    InterfaceQuality quality;
    double seconds = 0;  ///< wall clock of the cut; goes into the report only

    template <class Archive>
    void archive(Archive& a) {
        a(id, first_leaf, leaves, vertices, facets, mass.volume, mass.area, mass.centroid);
        for (int i = 0; i < 9; ++i) a(mass.inertia.data()[i], mass.axes.data()[i]);
        a(mass.eigenvalues, cut_made, cut_tried, plane, method, rung, tries, loops, contour_edges, contour_length,
          max_deviation, section_area, interface_area, interface_faces, interface_vertices, quality, seconds);
    }
};

/// The closed surface of one subdomain.
struct Leaf {
    NodeId id = 1;
    double volume = 0;  ///< enclosed
    SurfaceArrays surface;
};

/// Is told of every cut while its data is at hand.
class CutListener {
 public:
    virtual ~CutListener() = default;
    virtual void on_cut(const Surface& parent, const Cut& cut) = 0;
};

/// A range [first, last) of leaves in the order of the tree.
struct LeafRange {
    std::int32_t first = 0, last = 0;
    bool meets(std::int32_t begin, std::int32_t count) const { return begin < last && begin + count > first; }
};

struct Decomposition {
    std::vector<TreeNode> nodes;  ///< visited ones, in depth-first order
    std::vector<Leaf> leaves;     ///< those of the range, in the order of the tree
};

/// Cuts the surface into options.parts subdomains and returns those of `range`; only branches that lead to them are
/// descended. A node that wants k leaves is cut at floor(k/2)/k of the load; the halves then get leaves in proportion
/// to the load that they have. A part that cannot be cut stays whole, so that there may be fewer leaves than wanted; it
/// belongs to whoever owns its first leaf. The result depends on surface and options only, not on the range or
/// listener. Cost n + n/2 + n/4 + ... for a single leaf, n log K for all.
Decomposition decompose(Surface surface, const DecomposeOptions& options, LeafRange range,
                        CutListener* listener = nullptr);

}  // namespace kerf

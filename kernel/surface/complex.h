// Closed bodies that share walls: what is cut.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/ids.h"
#include "surface/contacts.h"
#include "surface/facet_sides.h"
#include "surface/surface.h"

namespace kerf {

/// Facets that bound one body or several, the regions, each facet once. A facet between two regions is a wall of both.
/// Normals point from the back of a facet to its front: out of the region behind it. Keys of vertices and facets have
/// node 0, and are their numbers here.
class Complex {
 public:
    Complex() = default;
    /// One region without a name, which has this surface. Copies no half-edges.
    explicit Complex(Surface surface);
    /// Several regions. `sides`: of each facet, by the numbers of `region_names`. Throws Error(input), naming region
    /// and place, for a facet with the same on both sides, a region without facets, and one whose facets do not close.
    /// A single region loses its name: it is the complex of its surface, and Error(input) is thrown where that touches
    /// itself. O(#F log #F).
    Complex(SurfaceArrays facets, std::vector<FacetSides> sides, std::vector<std::string> region_names);

    std::int32_t region_count() const { return names_.empty() ? 1 : static_cast<std::int32_t>(names_.size()); }
    /// Of all regions; empty if there is one, which needs no name.
    std::span<const std::string> region_names() const { return names_; }
    std::int32_t vertex_count() const;
    std::int32_t facet_count() const;

    const Vec3& point(std::int32_t vertex) const;
    Triangle vertices(std::int32_t facet) const;
    std::int32_t patch(std::int32_t facet) const;
    FacetSides sides(std::int32_t facet) const { return sides_.empty() ? FacetSides{} : sides_[facet]; }
    /// Of all facets; empty if there is one region, whose facets have it behind them.
    std::span<const FacetSides> all_sides() const { return sides_; }

    /// The surface of the one region; the complex is empty then.
    Surface take_only_region();
    /// All facets, each once, as the complex has them. O(#F).
    SurfaceArrays arrays() const;
    /// The facets of a region turned outwards, and their vertices, both in the order of the complex with their keys.
    /// Where the region touches itself, more than two facets meet in an edge, or several fans of them in a vertex.
    /// O(n log n), n: facets of the region.
    SurfaceArrays arrays_of(RegionIndex region) const;
    /// The closed surface of a region: where it touches itself each fan of facets has a vertex of its own, with the
    /// same key. O(1) for one region, else as arrays_of().
    Surface surface_of(RegionIndex region) const;
    /// Where regions touch without a wall between them; none where there is one region. O(#V + #F).
    Contacts find_contacts() const;

 private:
    void find_facets_of_regions();
    void become_only_region();

    Surface only_;  // if there is one region; else what follows
    SurfaceArrays facets_;
    std::vector<FacetSides> sides_;
    std::vector<std::string> names_;
    // Facets of region r: numbers [first_[r], first_[r + 1]) of facet_of_region_.
    std::vector<std::int32_t> first_, facet_of_region_;
};

}  // namespace kerf

// Closed bodies that share walls: the input of the decomposition.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "base/core/ids.h"
#include "base/core/types.h"
#include "surface/complex/surface.h"
#include "surface/soup/facet_sides.h"

namespace kerf {

/// Vertices and edges at which bodies may touch without a common facet: several wedges of the outside meet there.
/// Ascending, each once.
struct Contacts {
    std::vector<Key> vertices;              ///< include the ends of `edges`
    std::vector<std::array<Key, 2>> edges;  ///< the smaller key first

    bool empty() const { return vertices.empty(); }
    bool has(Key vertex) const;
    bool has(Key a, Key b) const;
};

/// Finds the edges at which more than two facets of `outer` meet, and the vertices at which they form several fans.
/// `outer` holds the facets that have the outside on one side, `key` the key of each vertex (#V). O(#V + #F).
Contacts find_contacts(const std::vector<Triangle>& outer, std::span<const Key> key);

/// Facets that bound one body or several, the regions, each facet once. A facet between two regions is a wall of both.
/// Normals point from the back of a facet to its front: out of the region behind it. Keys of vertices and facets have
/// node 0, and are their numbers here.
class Complex {
 public:
    Complex() = default;
    /// A complex of one region without a name, bounded by this surface. Copies no half-edges.
    explicit Complex(Surface surface);
    /// A complex of several regions. `sides` has the regions beside each facet, as indices into `region_names`. Throws
    /// Error(input), naming region and place, for a facet with the same region on both sides, a region without facets,
    /// and a region whose facets do not close; InvertedRegion for one with a negative volume. A single region loses its
    /// name: the complex is that of its surface, and Error(input) is thrown where the surface touches itself.
    /// O(#F log #F).
    Complex(SurfaceArrays facets, std::vector<FacetSides> sides, std::vector<std::string> region_names);

    std::int32_t region_count() const { return names_.empty() ? 1 : count_of(names_); }
    /// The names of the regions; empty if there is only one, which needs no name.
    std::span<const std::string> region_names() const { return names_; }
    std::int32_t vertex_count() const;
    std::int32_t facet_count() const;

    const Vec3& point(std::int32_t vertex) const;
    Triangle vertices(std::int32_t facet) const;
    std::int32_t patch(std::int32_t facet) const;
    FacetSides sides(std::int32_t facet) const { return sides_.empty() ? FacetSides{} : sides_[facet]; }
    /// The sides of all facets; empty if there is one region, which then lies behind every facet.
    std::span<const FacetSides> all_sides() const { return sides_; }

    /// Moves the surface of the only region out and leaves the complex empty.
    Surface take_only_region();
    /// Returns all facets, each once and turned as in the complex. O(#F).
    SurfaceArrays arrays() const;
    /// Returns the facets of a region, turned outwards, and their vertices, both in the order of the complex and with
    /// their keys. Where the region touches itself, more than two facets meet in an edge, or several fans of them in a
    /// vertex. O(n log n) for n facets of the region.
    SurfaceArrays arrays_of(RegionIndex region) const;
    /// Returns the closed surface of a region: where it touches itself, each fan of facets has a vertex of its own with
    /// the same key. O(1) for one region, else as arrays_of().
    Surface surface_of(RegionIndex region) const;
    /// Returns the vertices and edges at which regions may touch without a wall between them; none if there is one
    /// region. O(#V + #F).
    Contacts find_contacts() const;

 private:
    void find_facets_of_regions();
    void become_only_region();

    Surface only_;  // used if there is one region, else the members below are
    SurfaceArrays facets_;
    std::vector<FacetSides> sides_;
    std::vector<std::string> names_;
    // Facets of region r: numbers [first_[r], first_[r + 1]) of facet_of_region_.
    std::vector<std::int32_t> first_, facet_of_region_;
};

}  // namespace kerf

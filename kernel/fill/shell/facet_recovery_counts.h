// Counts of facets that were missing in a Delaunay triangulation and had to be recovered, for reports.
#pragma once

#include <cstdint>

namespace kerf {

/// The counts for one surface, or their sum over several. Facets of a core's boundary count as well.
struct FacetRecoveryCounts {
    std::int64_t missing = 0;         ///< facets that were not among the faces of the Delaunay triangulation
    std::int64_t by_flips = 0;        ///< missing facets recovered by flips, some with vertices added beside
    std::int64_t split = 0;           ///< missing facets for which parts behind them stood for a while
    std::int64_t added_vertices = 0;  ///< vertices that recovery has added inside the mesh and that are left

    void add(const FacetRecoveryCounts& other) {
        missing += other.missing;
        by_flips += other.by_flips;
        split += other.split;
        added_vertices += other.added_vertices;
    }

    template <class Archive>
    void archive(Archive& a) {
        a(missing, by_flips, split, added_vertices);
    }
};

}  // namespace kerf

// How facets came into a mesh whose Delaunay triangulation lacked them, as numbers for reports.
#pragma once

#include <cstdint>

namespace kerf {

/// Of one surface, or the sum over several. Facets of a core's boundary count as well.
struct FacetRecovery {
    std::int64_t missing = 0;         ///< facets that were not among the faces of the Delaunay triangulation
    std::int64_t by_flips = 0;        ///< of them: recovered by flips, some with vertices added beside
    std::int64_t split = 0;           ///< of them: parts behind them stood for them for a while
    std::int64_t added_vertices = 0;  ///< inside the mesh, by recovery

    void add(const FacetRecovery& other) {
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

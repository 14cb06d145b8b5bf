// Ratios of the lengths of edges to the wanted sizes, which tell how well these are obeyed.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "fill/mesh/tet_mesh.h"
#include "surface/complex/surface.h"
#include "surface/size/size_field.h"

namespace kerf {

/// Counts of edges by their length over the wanted size, the mean of that at their ends. Counts of parts can be added
/// in any order.
class RatioCounts {
 public:
    /// The range of ratios that counts as obeyed.
    static constexpr double low = 0.7, high = 1.4;

    void add(double ratio, std::int64_t times = 1);  ///< `ratio`: positive, or infinite
    void add(const RatioCounts& other);
    std::int64_t count() const;
    /// Returns the share of all that lies from `low` to `high`; 0 if there is none.
    double share_obeyed() const;
    /// Returns the number of ratios from `bound` on, a border of bins: low times a power of the sixteenth root of two.
    std::int64_t count_from(double bound) const;
    /// Returns the mean ratio, to half a percent; 0 if there is none.
    double mean() const;
    /// Returns the ratio below which the given fraction in [0, 1] lies, to 2.5 %; ratios beyond 1/11 and 11 count as
    /// these.
    double percentile(double fraction) const;

    template <class Archive>
    void archive(Archive& a) {
        a(bins_);
    }

 private:
    static constexpr int bins_per_octave = 16, octaves_below = 3, octaves = 7;  // one octave is obeyed
    std::array<std::int64_t, bins_per_octave * octaves> bins_{};
};

/// The ratios of one part, or of all.
struct SizeRatios {
    struct OfPatch {
        std::int32_t patch = 0;
        RatioCounts edges;

        template <class Archive>
        void archive(Archive& a) {
            a(patch, edges);
        }
    };
    RatioCounts inside;             ///< edges with an end inside of a part
    RatioCounts interfaces;         ///< edges of interface facets, once for each side of each facet
    std::vector<OfPatch> by_patch;  ///< edges of other facets, once for each facet; ascending, without empty ones
    std::vector<std::int64_t> cells_in_solids = {};  ///< cells with their centroid in each of SizeField::solids()

    void add(const SizeRatios& other);
    /// Returns the mean ratio of all edges, for the edges of facets as often as the edge is in the mesh: an edge of the
    /// surface is that of two facets, one of an interface that of two facets of either side.
    double mean() const;
    /// Returns the share of edges that are at least `bound` times as long as wanted, see RatioCounts::count_from().
    double share_from(double bound) const;
    bool empty() const { return inside.count() == 0 && interfaces.count() == 0 && by_patch.empty(); }

    template <class Archive>
    void archive(Archive& a) {
        a(inside, interfaces, by_patch, cells_in_solids);
    }

 private:
    // Returns the sum of what a function gives for the counts of each kind, times how often they hold an edge.
    template <class Value>
    double sum_of_edges(const Value& value) const;
};

/// Measures the mesh that fills a surface and has its vertices first; empty for a field that asks nothing. In meshes of
/// more than 2^18 vertices, edges inside count only if their smaller vertex is a multiple of a power of two, each for
/// so many. O(#T), and the field once for each vertex.
SizeRatios measure_sizes(const TetMesh& mesh, const SurfaceArrays& surface, const SizeField& field);

/// Returns text for people: a line on the edges inside, and with `every_kind` one on interfaces and on each of the
/// first patches.
std::string size_text(const SizeRatios& ratios, const std::vector<std::string>& patch_names, bool every_kind);

}  // namespace kerf

// Division of facets that are coarser than the cells, within their planes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/core/cancellation.h"
#include "surface/complex/complex.h"
#include "surface/size/size_field.h"

namespace kerf {

/// The lengths that are wanted on facets: of one field, or of several, the finest of which counts in an edge.
class FacetSizes {
 public:
    FacetSizes(SizeField all) : fields_{std::move(all)} {}
    /// `field`: for each facet the number of its field in `fields`, which are the finer the smaller the number.
    FacetSizes(std::vector<SizeField> fields, std::vector<std::int32_t> field)
        : fields_(std::move(fields)), field_(std::move(field)) {}

    bool is_empty() const;
    /// Returns the number of the field of a facet.
    std::int32_t field_of(std::size_t facet) const { return field_.empty() ? 0 : field_[facet]; }
    const SizeField& field(std::int32_t number) const { return fields_[number]; }
    const SizeField& of(std::size_t facet) const { return field(field_of(facet)); }

 private:
    std::vector<SizeField> fields_;
    std::vector<std::int32_t> field_;  // empty: all have the first
};

/// Whether divide_facets() would divide any facet. Asks the field at O(#E) points, and at fewer if the first edges
/// decide.
bool has_facets_to_divide(const Complex& complex, const FacetSizes& wanted);

/// Returns the number of facets that divide_facets() makes, within a fifth or so. O(#F) queries of the field.
double forecast_divided_facets(const SurfaceArrays& surface, const FacetSizes& wanted);

/// A surface after its division.
struct DividedSurface {
    SurfaceArrays surface;                   ///< its keys are like those of a surface that was read
    std::int64_t kept = 0;                   ///< number of facets that are as they were
    std::vector<std::int32_t> facet_before;  ///< #F; the facet that each is a piece of
};

/// Puts points on the edges and inside of the facets of a surface, so that edges are about as long as wanted: at most
/// 1.5 times that on edges of the surface, twice inside of facets. The shape is the same. The edges and corners of the
/// facets stay, vertices keep their numbers, and pieces have the patch of their facet. The number of pieces of an edge
/// is the rounded number of lengths that fit in, and pieces are shorter where shorter ones are wanted; inside, points
/// are added as in interfaces (cut/cut/planar_triangulation.h). A facet depends on its corners and the field alone. Any
/// number of facets may meet in an edge. Throws Error(memory) for more facets than a surface may have,
/// Error(cancelled). O(n log n), n: facets of the result.
DividedSurface divide_facets(const SurfaceArrays& surface, const FacetSizes& wanted,
                             const CancellationCheck& check_cancelled = {});

}  // namespace kerf

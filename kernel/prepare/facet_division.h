// Facets that are coarser than the cells, divided where they lie.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/cancellation.h"
#include "size/size_field.h"
#include "surface/complex.h"

namespace kerf {

/// The lengths that are wanted on facets: of one field, or of several, the finest of which counts in an edge.
class FacetSizes {
 public:
    FacetSizes(SizeField all) : fields_{std::move(all)} {}
    /// `field`: of each facet by its number in `fields`, which are the finer the smaller it is.
    FacetSizes(std::vector<SizeField> fields, std::vector<std::int32_t> field)
        : fields_(std::move(fields)), field_(std::move(field)) {}

    bool is_empty() const;
    /// The number of the field of a facet.
    std::int32_t field_of(std::size_t facet) const { return field_.empty() ? 0 : field_[facet]; }
    const SizeField& field(std::int32_t number) const { return fields_[static_cast<std::size_t>(number)]; }
    const SizeField& of(std::size_t facet) const { return field(field_of(facet)); }

 private:
    std::vector<SizeField> fields_;
    std::vector<std::int32_t> field_;  // empty: all have the first
};

/// Whether divide_facets() would divide any. Asks the field at O(#E) points, and fewer if the first edges say it.
bool has_facets_to_divide(const Complex& complex, const FacetSizes& wanted);

/// Facets that divide_facets() makes, within a fifth or so. O(#F) queries of the field.
double forecast_divided_facets(const SurfaceArrays& surface, const FacetSizes& wanted);

struct DividedSurface {
    SurfaceArrays surface;                   ///< keys as a surface that was read has them
    std::int64_t kept = 0;                   ///< facets that are as they were
    std::vector<std::int32_t> facet_before;  ///< #F; of which it is a piece
};

/// The surface with points on its edges and inside of its facets, so that edges are about as long as wanted: at most
/// 1.5 times that on edges of the surface, twice inside of facets. The shape is the same. The edges and corners of the
/// facets stay, vertices keep their numbers, and what is divided has the patch of its facet. Edges have as many pieces
/// as lengths fit in, rounded, shorter where shorter ones are wanted; inside, points are added as in interfaces
/// (cut/triangulation.h). A facet depends on its corners and the field alone. Any number of facets may meet in an edge.
/// Throws Error(memory) for more facets than a surface may have, Error(cancelled). O(n log n), n: facets of the result.
DividedSurface divide_facets(const SurfaceArrays& surface, const FacetSizes& wanted,
                             const CancellationCheck& check_cancelled = {});

}  // namespace kerf

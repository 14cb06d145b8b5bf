// The facets of a complex as the remesher takes them.
#pragma once

#include <compare>
#include <vector>

#include "surface/complex/complex.h"

namespace kerf {

/// The facets of a complex with labels, which say patch and sides, in place of their patches: facets that are made of
/// them have their labels. Walls have the region of the smaller number behind them, so that walls beside each other
/// face the same way.
struct LabelledFacets {
    struct Label {
        std::int32_t patch;
        FacetSides sides;

        auto operator<=>(const Label&) const = default;
    };

    SurfaceArrays surface;      ///< numbers of vertices and facets are those of the complex, patches are labels
    std::vector<Label> labels;  ///< in the order of their first facets
    std::vector<char> walls;    ///< #F; whether the facet lies between two regions; empty for one region

    /// Makes the complex of other facets with these labels. `names`: of the regions. Throws Error as Complex does.
    Complex to_complex(SurfaceArrays facets, std::vector<std::string> names) const;
};

/// Labels the facets of a complex. Copies of a vertex, at which the surface of a single region touches itself, are one
/// again, and the others move up. O(#F log #labels).
LabelledFacets label_facets(const Complex& complex);

}  // namespace kerf

#include "run/prepare/inside/labelled_facets.h"

#include <map>
#include <utility>

#include "base/core/ids.h"
#include "surface/complex/touching.h"

namespace kerf {

LabelledFacets label_facets(const Complex& complex) {
    LabelledFacets result = {joined_by_key(complex.arrays()), {}, {}};
    std::map<LabelledFacets::Label, std::int32_t> numbers;
    for (std::int32_t f = 0; f < count_of(result.surface.facets); ++f) {
        FacetSides sides = complex.sides(f);
        if (!sides.back.is_valid() || (sides.front.is_valid() && sides.front < sides.back)) {
            sides = sides.turned();
            std::swap(result.surface.facets[f][1], result.surface.facets[f][2]);
        }
        std::int32_t& patch = result.surface.patch[f];
        const auto next = count_of(result.labels);
        const auto [label, is_new] = numbers.try_emplace({patch, sides}, next);
        if (is_new) result.labels.push_back(label->first);
        patch = label->second;
        if (complex.region_count() > 1) result.walls.push_back(sides.is_wall() ? 1 : 0);
    }
    return result;
}

Complex LabelledFacets::to_complex(SurfaceArrays facets, std::vector<std::string> names) const {
    std::vector<FacetSides> sides;
    for (std::int32_t& patch : facets.patch) {
        const Label& label = labels[patch];
        patch = label.patch;
        if (!names.empty()) sides.push_back(label.sides);
    }
    if (names.empty()) return Complex(separated_surface(facets));
    return {std::move(facets), std::move(sides), std::move(names)};
}

}  // namespace kerf

#include "surface/arrange/hull.h"

#include "surface/arrange/inside/side_labels.h"
#include "surface/regions/divided_space.h"
#include "surface/soup/radial_order.h"

namespace kerf {

std::vector<HullFate> find_hull(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                const std::function<void()>& check_cancelled) {
    const SingleFacets single = single_facets(facets);
    std::vector<std::int32_t> times(single.facets.size(), 0);
    for (std::size_t f = 0; f < facets.size(); ++f)
        if (const std::int32_t u = single.single_of[f]; u >= 0) times[u] += single.is_turned[f] ? -1 : 1;
    check_cancelled();
    const WindingNumber winding(vertices, single.facets, times);
    check_cancelled();
    const std::vector<char> is_inside = find_inside_sides(vertices, single.facets, times, winding, check_cancelled);

    std::vector<HullFate> fate(facets.size(), HullFate::outside);
    std::vector<std::int32_t> stays(single.facets.size(), -1);  // of each single facet the one that stays
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const std::int32_t u = single.single_of[f];
        if (u < 0) continue;
        const bool in_front = is_inside[front_side(u)] != 0, behind = is_inside[back_side(u)] != 0;
        if (in_front == behind) {
            fate[f] = behind ? HullFate::inside : HullFate::outside;
            continue;
        }
        const bool is_right = behind != (single.is_turned[f] != 0);
        fate[f] = HullFate::copy;
        if (stays[u] >= 0 && (!is_right || fate[stays[u]] == HullFate::stays)) continue;
        if (stays[u] >= 0) fate[stays[u]] = HullFate::copy;
        stays[u] = static_cast<std::int32_t>(f);
        fate[f] = is_right ? HullFate::stays : HullFate::turns;
    }
    return fate;
}

}  // namespace kerf

#include "surface/arrange/inside/plane_overlaps.h"

#include <algorithm>
#include <numeric>

#include "base/geometry/box_hierarchy.h"

namespace kerf {

std::vector<FacetPair> plane_overlaps(const DividedFacets& divided, std::vector<char>& is_near, double tolerance,
                                      const std::function<void()>& check_cancelled) {
    const std::vector<Box> boxes = boxes_around(divided.points.all(), divided.facets);
    std::vector<std::int32_t> order(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0);
    const BoxHierarchy<> hierarchy = make_hierarchy(boxes, order);
    for (std::size_t f = 0; f < is_near.size(); ++f)
        if (is_near[f]) open.push_back(static_cast<std::int32_t>(f));
    std::vector<FacetPair> pairs;
    std::vector<char> is_done(is_near.size(), 0);
    while (!open.empty()) {
        check_cancelled();
        const std::int32_t facet = open.back();
        open.pop_back();
        is_done[facet] = 1;
        const Corners p = divided.corners(divided.facets[facet]);
        const int axis = axis_across(p);
        Box box = boxes[facet];
        box.min().array() -= tolerance;
        box.max().array() += tolerance;
        hierarchy.any([&](const BoxNode& node) { return node.box.intersects(box); },
                      [&](std::int32_t item) {
                          const std::int32_t other = order[item];
                          if (is_done[other] || !box.intersects(boxes[other])) return false;
                          const Corners q = divided.corners(divided.facets[other]);
                          if (!lie_in_one_plane(p, q, tolerance) || !share_area(p, q, axis)) return false;
                          pairs.push_back({std::min(facet, other), std::max(facet, other)});
                          if (!std::exchange(is_near[other], 1)) open.push_back(other);
                          return false;
                      });
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

}  // namespace kerf

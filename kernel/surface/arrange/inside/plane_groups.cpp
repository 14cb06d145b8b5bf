// Overlapping pairs are found from facet to facet: each one that is near asks the others whose boxes meet its own, and
// those that share area with it are near, too. Facets that overlap pair by pair may lead around a bend where they are
// small or thin. Facets that are not near the plane of the largest one therefore make groups of their own.
#include "surface/arrange/inside/plane_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/box_hierarchy.h"
#include "base/geometry/union_find.h"

namespace kerf {

namespace {

constexpr double allowed_tolerances = 4;

// Facets with the same corners are divided together, though they may be in no overlapping pair.
void join_copies(const DividedFacets& divided, std::span<const std::int32_t> chosen, UnionFind& joined) {
    std::vector<std::pair<Triangle, std::int32_t>> sorted;
    sorted.reserve(chosen.size());
    for (const std::int32_t f : chosen) {
        Triangle t = divided.facets[f];
        std::sort(t.begin(), t.end());
        sorted.emplace_back(t, f);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (sorted[i].first == sorted[i - 1].first) joined.join(sorted[i].second, sorted[i - 1].second);
}

// Puts those first that are near the plane of the first one, the largest, and returns where the others begin.
std::vector<std::int32_t>::iterator gather_plane(const DividedFacets& divided,
                                                 std::vector<std::int32_t>::iterator begin,
                                                 std::vector<std::int32_t>::iterator end, double allowed) {
    const Corners p = divided.corners(divided.facets[*begin]);
    const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
    return std::stable_partition(begin, end, [&](std::int32_t f) {
        const Corners q = divided.corners(divided.facets[f]);
        return f == *begin || std::all_of(q.begin(), q.end(),
                                          [&](const Vec3& x) { return std::abs(normal.dot(x - p[0])) <= allowed; });
    });
}

double square_of_area(const DividedFacets& divided, std::int32_t facet) {
    const Corners p = divided.corners(divided.facets[facet]);
    return (p[1] - p[0]).cross(p[2] - p[0]).squaredNorm();
}

}  // namespace

std::vector<FacetPair> plane_overlaps(const DividedFacets& divided, std::vector<char>& is_near, double tolerance,
                                      const std::function<void()>& check_cancelled) {
    const std::vector<Box> boxes = boxes_around(divided.points.all(), divided.facets);
    std::vector<std::int32_t> order(boxes.size()), open;
    std::iota(order.begin(), order.end(), 0);
    const BoxHierarchy<> hierarchy = make_hierarchy(boxes, order);
    for (std::int32_t f = 0; f < count_of(is_near); ++f)
        if (is_near[f]) open.push_back(f);
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

PlaneGroups group_planes(const DividedFacets& divided, std::span<const std::int32_t> chosen,
                         std::span<const FacetPair> overlaps, double tolerance) {
    UnionFind joined(divided.facets.size());
    for (const FacetPair& pair : overlaps) joined.join(pair[0], pair[1]);
    join_copies(divided, chosen, joined);
    PlaneGroups groups{{chosen.begin(), chosen.end()}, {0}, std::vector<std::int32_t>(divided.facets.size(), -1)};
    std::vector<std::int32_t>& facets = groups.facets;
    std::stable_sort(facets.begin(), facets.end(),
                     [&](std::int32_t a, std::int32_t b) { return joined.root(a) < joined.root(b); });
    for (auto begin = facets.begin(); begin != facets.end();) {
        const std::int32_t root = joined.root(*begin);
        const auto end = std::find_if(begin, facets.end(), [&](std::int32_t f) { return joined.root(f) != root; });
        std::stable_sort(begin, end, [&](std::int32_t a, std::int32_t b) {
            return square_of_area(divided, a) > square_of_area(divided, b);
        });
        while (begin != end) {
            const auto next = gather_plane(divided, begin, end, allowed_tolerances * tolerance);
            for (; begin != next; ++begin) groups.of[*begin] = groups.count();
            groups.first.push_back(next - facets.begin());
        }
    }
    return groups;
}

}  // namespace kerf

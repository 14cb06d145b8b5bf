// Trees of facets that survive vertices of many facets (facet_tree.h). A fan is the set of facets at an apex of at
// least `least_of_fan` facets; a facet at several of these is in the fan of the vertex of the highest degree. A node of
// a FanTree has, beside the box of its facets, a box around their unit directions from the apex. A facet g in question
// is seen from the apex within a ViewCone of at most four half-spaces, given by inward normals: a node may be left out
// if its directions lie outside of one of them. All this is computed in doubles; a side counts only if it is certain,
// by more than `least_sure`, so that rounding adds pairs but loses none.
#include "surface/diagnosis/inside/facet_tree.h"

#include <algorithm>
#include <numeric>

#include "base/core/ids.h"

namespace kerf {

namespace {

// A product of unit vectors has a certain sign beyond this. Unit vectors between equal points are NaN, and never do.
constexpr double least_sure = 1e-13;

Vec3 unit_towards(const Vec3& from, const Vec3& to) {
    const Vec3 d = to - from;
    return (d / d.cwiseAbs().maxCoeff()).normalized();
}

// Returns a box around all unit directions in the facet's sector: the arc between the two end directions lies within
// the sagitta of its chord.
Box directions_of(const std::vector<Vec3>& vertices, const Triangle& facet, std::int32_t apex) {
    std::array<Vec3, 2> ends;
    std::size_t count = 0;
    for (const std::int32_t v : facet)
        if (v != apex && count < 2) ends[count++] = unit_towards(vertices[apex], vertices[v]);
    const double sagitta = 1 - (ends[0] + ends[1]).norm() / 2 + least_sure;
    if (!(sagitta <= 1 + least_sure)) return Box(Vec3::Constant(-2), Vec3::Constant(2));
    const Vec3 margin = Vec3::Constant(sagitta);
    return Box(ends[0].cwiseMin(ends[1]) - margin, ends[0].cwiseMax(ends[1]) + margin);
}

}  // namespace

ViewCone::ViewCone(const std::vector<Vec3>& vertices, const Triangle& facet, std::int32_t apex) {
    std::array<Vec3, 3> to;
    std::size_t count = 0;
    for (const std::int32_t v : facet)
        if (v != apex) to[count++] = unit_towards(vertices[apex], vertices[v]);
    if (count == 2) {
        const Vec3 normal = to[0].cross(to[1]);
        add(normal);
        add(-normal);
        add(normal.cross(to[0]));
        add(to[1].cross(normal));
    }
    for (std::size_t i = 0; count == 3 && i < 3; ++i) {
        const Vec3 normal = to[i].cross(to[(i + 1) % 3]);
        const double height = normal.dot(to[(i + 2) % 3]);
        if (height > least_sure) add(normal);
        if (height < -least_sure) add(-normal);
    }
}

bool ViewCone::misses(const Box& directions) const {
    return std::any_of(inward_.begin(), inward_.begin() + count_, [&](const Vec3& inward) {
        const Vec3 farthest = inward.cwiseProduct(directions.min()).cwiseMax(inward.cwiseProduct(directions.max()));
        return farthest.sum() < -least_sure;
    });
}

FanTree::FanTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::int32_t apex,
                 std::vector<std::int32_t> fan)
    : vertices_(vertices), facets_(facets), apex_(apex), fan_(std::move(fan)) {
    std::vector<Box> directions;
    for (const std::int32_t f : fan_) directions.push_back(directions_of(vertices, facets[f], apex));
    std::vector<std::int32_t> order(fan_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto halve = [&](std::int32_t first, std::int32_t last) {
        const auto centre_of = [&](std::int32_t i) { return Vec3(directions[i].center()); };
        const auto middle =
            halve_by_centre(order.begin() + first, order.begin() + last, centre_of, [](std::int32_t i) { return i; });
        return middle - order.begin();
    };
    tree_ = BoxHierarchy<Node>(fan_.size(), halve, [&](std::int32_t i) {
        Node node;
        node.box = box_around(vertices, facets[fan_[order[i]]]);
        node.directions = directions[order[i]];
        return node;
    });
    for (std::int32_t& item : order) item = fan_[item];
    fan_ = std::move(order);
}

FacetTree::FacetTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
    : vertices_(vertices), facets_(facets) {
    std::vector<std::int32_t> all(facets.size());
    std::iota(all.begin(), all.end(), 0);
    make_fans(all);
    if (!fans_.empty()) plain_ = std::move(all);
    const std::size_t count = fans_.empty() ? facets.size() : plain_.size();
    tree_ = OverlapTree(count, [&](std::size_t i) { return box_around(vertices_, facets_[plain(i)]); });
}

FacetTree::FacetTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                     const std::vector<std::int32_t>& chosen)
    : vertices_(vertices), facets_(facets), plain_(chosen) {
    make_fans(plain_);
    tree_ = OverlapTree(plain_.size(), [&](std::size_t i) { return box_around(vertices_, facets_[plain_[i]]); });
}

void FacetTree::make_fans(std::vector<std::int32_t>& chosen) {
    std::vector<std::int32_t> degree(vertices_.size(), 0);
    for (const std::int32_t f : chosen)
        for (const std::int32_t v : facets_[f]) ++degree[v];
    if (std::none_of(degree.begin(), degree.end(), [](std::int32_t d) { return d >= least_of_fan; })) return;
    // A facet at several such vertices is in the largest fan.
    const auto apex_of = [&](std::int32_t f) {
        const std::int32_t v = *std::max_element(facets_[f].begin(), facets_[f].end(),
                                                 [&](auto a, auto b) { return degree[a] < degree[b]; });
        return degree[v] >= least_of_fan ? v : -1;
    };
    std::vector<std::vector<std::int32_t>> fans;
    std::vector<std::int32_t> number(vertices_.size(), -1), apexes;
    fan_of_.assign(facets_.size(), -1);
    for (const std::int32_t f : chosen) {
        const std::int32_t apex = apex_of(f);
        if (apex < 0) continue;
        if (number[apex] < 0) {
            number[apex] = count_of(fans);
            apexes.push_back(apex);
            fans.emplace_back();
        }
        fan_of_[f] = number[apex];
        fans[number[apex]].push_back(f);
    }
    std::erase_if(chosen, [&](std::int32_t f) { return fan_of_[f] >= 0; });
    fans_.reserve(fans.size());
    for (std::size_t i = 0; i < fans.size(); ++i) fans_.emplace_back(vertices_, facets_, apexes[i], std::move(fans[i]));
    fan_tree_ = OverlapTree(fans_.size(), [&](std::size_t i) { return fans_[i].box(); });
}

}  // namespace kerf

// Regions are ordered along Morton's curve through the box of the complex, by the centres of their boxes, so that
// regions that follow each other are near each other and mostly come to the same rank. Leaves are shared out by highest
// averages: the next leaf always goes to the region with the most load per leaf, from a priority queue in which the
// smaller number wins ties. `order_` has the regions along the curve, and first_leaf_[i] the first leaf of the i-th of
// them, so that a node is an interval of places. The hash of a node of several regions is that of their shares, by
// which ranks compare their trees.
#include "cut/decompose/inside/region_tree.h"

#include <algorithm>
#include <numeric>
#include <queue>

#include <fmt/format.h>

#include "base/core/check.h"
#include "base/core/error.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

namespace {

RegionMeasures measure(const SurfaceArrays& region, const LoadModel& model) {
    RegionMeasures measures;
    measures.vertices = count_of(region.vertices);
    measures.facets = count_of(region.facets);
    const BoundedVolume volume = bounded_volume(region.vertices, region.facets);
    measures.volume = volume.value;
    measures.volume_error = volume.error;
    for (const Triangle& t : region.facets) measures.area += triangle_area(region.vertices, t);
    measures.load = model.load(measures.vertices, measures.facets,
                               model.depends_on_place() ? model.volume_of(region, volume.value) : volume.value);
    return measures;
}

// Returns a place along a curve on which neighbours mostly follow each other: the bits of three coordinates in turn.
std::uint64_t place_on_curve(const Vec3& point, const Box& box) {
    constexpr int bits = 20;
    std::uint64_t place = 0;
    std::array<std::uint32_t, 3> cell{};
    for (int i = 0; i < 3; ++i) {
        const double share = box.sizes()[i] > 0 ? (point[i] - box.min()[i]) / box.sizes()[i] : 0;
        cell[i] = static_cast<std::uint32_t>(std::clamp(share, 0.0, 1.0) * ((1U << bits) - 1));
    }
    for (int bit = bits; bit-- > 0;)
        for (const std::uint32_t c : cell) place = 2 * place + (c >> bit & 1U);
    return place;
}

std::vector<RegionIndex> spatial_order_of(const Complex& complex) {
    Array<RegionIndex, Box> boxes(complex.region_count());
    Box whole;
    for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
        const FacetSides sides = complex.sides(f);
        for (const std::int32_t v : complex.vertices(f)) {
            for (const RegionIndex region : {sides.back, sides.front})
                if (region.is_valid()) boxes[region].extend(complex.point(v));
            whole.extend(complex.point(v));
        }
    }
    std::vector<std::pair<std::uint64_t, RegionIndex>> places;
    for (const RegionIndex region : boxes.ids())
        places.emplace_back(place_on_curve(boxes[region].center(), whole), region);
    std::sort(places.begin(), places.end());
    std::vector<RegionIndex> order;
    for (const auto& [place, region] : places) order.push_back(region);
    return order;
}

// Returns the number of leaves of each region.
Array<RegionIndex, std::int32_t> share_out(const Array<RegionIndex, RegionMeasures>& measures, std::int32_t parts) {
    Array<RegionIndex, std::int32_t> leaves(measures.size(), 1);
    struct Share {
        double load;  // per leaf
        RegionIndex region;
        bool operator<(const Share& other) const {
            return load != other.load ? load < other.load : region > other.region;
        }
    };
    std::priority_queue<Share> queue;
    for (const RegionIndex r : measures.ids()) queue.push({measures[r].load, r});
    for (auto left = parts - count_of(measures); left > 0; --left) {
        const RegionIndex region = queue.top().region;
        queue.pop();
        ++leaves[region];
        queue.push({measures[region].load / leaves[region], region});
    }
    return leaves;
}

}  // namespace

Array<RegionIndex, RegionMeasures> measure_regions(const Complex& complex, const DecomposeOptions& options) {
    Array<RegionIndex, RegionMeasures> all;
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        all.push_back(measure(complex.arrays_of(region), options.cut_in(region).bisected_load()));
        if (all.back().volume > all.back().volume_error) continue;
        throw Error(ErrorCode::input,
                    fmt::format("The region '{}' has a volume of {:.6g}. Its facets must enclose some, and be turned "
                                "out of it.",
                                complex.region_names()[region.value()], all.back().volume));
    }
    return all;
}

RegionTree::RegionTree(const Complex& complex, const Array<RegionIndex, RegionMeasures>& measures, std::int32_t parts)
    : order_(spatial_order_of(complex)), first_leaf_(1, 0) {
    KERF_CHECK(measures.size() == order_.size() && parts >= complex.region_count());
    const Array<RegionIndex, std::int32_t> leaves = share_out(measures, parts);
    for (const RegionIndex region : order_) first_leaf_.push_back(first_leaf_.back() + leaves[region]);
}

std::array<RegionTree::Node, 2> RegionTree::halves(const Node& node) const {
    KERF_CHECK(node.regions > 1);
    const auto [lower, upper] = children_of(node.id);
    const std::int32_t below = (node.regions + 1) / 2;
    return {Node{lower, node.first, below}, Node{upper, node.first + below, node.regions - below}};
}

TreeNode RegionTree::describe(const Node& node, const Array<RegionIndex, RegionMeasures>& measures) const {
    TreeNode told;
    told.id = node.id;
    told.first_leaf = first_leaf(node);
    told.leaves = leaves(node);
    told.regions = node.regions;
    for (std::int32_t place = node.first; place < node.first + node.regions; ++place) {
        const RegionMeasures& region = measures[order_[place]];
        told.vertices += region.vertices;
        told.facets += region.facets;
        told.mass.volume += region.volume;
        told.mass.volume_error += region.volume_error;
        told.mass.area += region.area;
        const std::array<std::int32_t, 2> share = {order_[place].value(), first_leaf_[place]};
        add_to_cut_hash(told, std::span<const std::int32_t>(share));
    }
    return told;
}

}  // namespace kerf

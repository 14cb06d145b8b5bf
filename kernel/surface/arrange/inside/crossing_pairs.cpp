// Facets near each other are asked for after each other, so that the memory which they read is at hand: in the order of
// the leaves of the hierarchy where they are in it, else in their own.
#include "surface/arrange/inside/crossing_pairs.h"

#include <algorithm>

#include "base/core/ids.h"
#include "base/geometry/box_hierarchy.h"
#include "surface/diagnosis/intersections.h"

namespace kerf {

namespace {

constexpr std::size_t facets_between_checks = 4096;

class CrossingSearch {
 public:
    CrossingSearch(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                   const std::vector<char>& changed, std::size_t most)
        : vertices_(vertices), facets_(facets), changed_(changed), most_(most) {
        for (std::int32_t f = 0; f < count_of(facets); ++f)
            if (changed[f]) order_.push_back(f);
        std::vector<std::int32_t> items(order_.size());
        std::vector<Box> boxes;
        boxes.reserve(order_.size());
        for (std::int32_t i = 0; i < count_of(order_); ++i) {
            items[i] = i;
            boxes.push_back(box_around(vertices, facets[order_[i]]));
        }
        hierarchy_ = make_hierarchy(boxes, items);
        for (std::int32_t& item : items) item = order_[item];
        order_ = std::move(items);
    }

    std::vector<FacetPair> run(const std::function<void()>& check_cancelled) {
        std::size_t asked = 0;
        const auto ask = [&](std::int32_t facet) {
            if (++asked % facets_between_checks == 0) check_cancelled();
            if (pairs_.size() <= most_) find_those_with(facet);
        };
        for (const std::int32_t facet : order_) ask(facet);
        if (order_.size() < facets_.size())
            for (std::int32_t f = 0; f < count_of(facets_); ++f)
                if (!changed_[f]) ask(f);
        std::sort(pairs_.begin(), pairs_.end());
        return std::move(pairs_);
    }

 private:
    // Two that changed are found once, by the larger one.
    void find_those_with(std::int32_t facet) {
        const Triangle& t = facets_[facet];
        const Box box = box_around(vertices_, t);
        hierarchy_.any([&](const BoxNode& node) { return node.box.intersects(box); },
                       [&](std::int32_t item) {
                           const std::int32_t other = order_[item];
                           if (changed_[facet] && other >= facet) return false;
                           const Triangle& s = facets_[other];
                           if (!box.intersects(box_around(vertices_, s))) return false;
                           if (triangles_intersect(corners(t), t, corners(s), s))
                               pairs_.push_back({std::min(facet, other), std::max(facet, other)});
                           return false;
                       });
    }
    std::array<Vec3, 3> corners(const Triangle& t) const { return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]}; }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const std::vector<char>& changed_;
    const std::size_t most_;
    std::vector<std::int32_t> order_;  // facets that changed, as the hierarchy has them
    BoxHierarchy<> hierarchy_;
    std::vector<FacetPair> pairs_;
};

}  // namespace

std::vector<FacetPair> crossing_pairs(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                      const std::vector<char>& changed, std::size_t most,
                                      const std::function<void()>& check_cancelled) {
    return CrossingSearch(vertices, facets, changed, most).run(check_cancelled);
}

}  // namespace kerf

#include "surface/remesh/inside/flat_regions.h"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double turned_cosine = 0.5;  // of a normal against that of its region, below which a facet is turned over

class RegionGrowth {
 public:
    RegionGrowth(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                 const FlatRegionOptions& options)
        : vertices_(vertices), facets_(facets), options_(options), partner_(edge_partners(facets)) {
        for (const Triangle& t : facets) twice_area_.push_back(doubled_area_vector(vertices, t));
    }

    FlatRegions run() {
        regions_.of.assign(facets_.size(), -1);
        std::vector<double> size;
        for (const Vec3& area : twice_area_) size.push_back(area.squaredNorm());
        std::vector<std::int32_t> order(facets_.size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return size[a] > size[b]; });
        for (const std::int32_t seed : order)
            if (regions_.of[seed] < 0) grow(seed);
        return std::move(regions_);
    }

 private:
    void grow(std::int32_t seed) {
        FlatRegion plane = {twice_area_[seed].normalized(), 0, options_.tolerance(seed)};
        for (const std::int32_t v : facets_[seed]) plane.offset += plane.normal.dot(vertices_[v]) / 3;
        const auto number = count_of(regions_.planes);
        regions_.of[seed] = number;
        open_ = {seed};
        while (!open_.empty()) {
            const std::int32_t f = open_.back();
            open_.pop_back();
            for (std::int32_t corner = 3 * f; corner < 3 * f + 3; ++corner) {
                if (partner_[corner] < 0) continue;
                const std::int32_t g = partner_[corner] / 3;
                if (regions_.of[g] >= 0 || options_.is_border(corner) || !lies_in(plane, g)) continue;
                regions_.of[g] = number;
                open_.push_back(g);
            }
        }
        regions_.planes.push_back(plane);
    }

    bool lies_in(const FlatRegion& plane, std::int32_t f) const {
        const Triangle& t = facets_[f];
        const double tolerance = std::min(plane.tolerance, options_.tolerance(f));
        if (!std::all_of(t.begin(), t.end(),
                         [&](std::int32_t v) { return std::abs(plane.height(vertices_[v])) <= tolerance; }))
            return false;
        const double area = twice_area_[f].norm();
        if (twice_area_[f].dot(plane.normal) >= turned_cosine * area) return true;
        double longest = 0;
        for (int i = 0; i < 3; ++i) longest = std::max(longest, (vertices_[t[i]] - vertices_[t[(i + 1) % 3]]).norm());
        return area <= options_.noise * longest;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const FlatRegionOptions& options_;
    std::vector<std::int32_t> partner_, open_;
    std::vector<Vec3> twice_area_;
    FlatRegions regions_;
};

}  // namespace

FlatRegions find_flat_regions(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                              const FlatRegionOptions& options) {
    return RegionGrowth(vertices, facets, options).run();
}

}  // namespace kerf

// Volume below the plane z = s by the divergence theorem with the field (0, 0, z - s): V(s) = sum over the surface
// below of the integral of (z - s) n_z dA; the cap contributes nothing because z = s there. For a whole facet the
// integral is (mean z - s) A n_z; for a crossing facet the part below is the facet minus the corner above, or the
// corner below.
#include "cut/load.h"

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

namespace kerf {

namespace {

constexpr double volume_weight = 0.606;  // seconds of a tetrahedron wanted inside per seconds of a facet

}  // namespace

double LoadModel::load(double vertices, double facets, double volume) const {
    switch (balance) {
        case Balance::nodes:
            return vertices;
        case Balance::faces:
            return facets;
        case Balance::volume:
            return volume;
        case Balance::work:
            return facets + (max_volume > 0 ? volume_weight * volume / max_volume : 0);
    }
    return 0;
}

LoadProfile::LoadProfile(const Surface& surface, const Plane& plane, const LoadModel& model) : model_(model) {
    std::vector<double> height(surface.vertex_count());
    for (std::int32_t v = 0; v < surface.vertex_count(); ++v) height[v] = plane.distance(surface.point(v));
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    lowest_ = *low;
    highest_ = *high;
    facets_.reserve(surface.facet_count());
    for (std::int32_t f = 0; f < surface.facet_count(); ++f) {
        const Triangle t = surface.vertices(f);
        const Vec3 normal_area =
            (surface.point(t[1]) - surface.point(t[0])).cross(surface.point(t[2]) - surface.point(t[0])) / 2;
        std::array<double, 3> z = {height[t[0]], height[t[1]], height[t[2]]};
        std::sort(z.begin(), z.end());
        facets_.push_back({z[0], z[1], z[2], normal_area.dot(plane.normal), (z[0] + z[1] + z[2]) / 3});
    }
    nodes_ = std::move(height);
    total_ = load_below(facets_, nodes_, highest_);
}

double LoadProfile::load_below(const std::vector<Item>& items, const std::vector<double>& nodes, double height) const {
    if (model_.balance == Balance::nodes)
        return static_cast<double>(std::count_if(nodes.begin(), nodes.end(), [&](double z) { return z <= height; }));
    double count = 0, volume = 0;
    for (const Item& f : items) {
        if (f.centroid <= height) ++count;
        if (f.low >= height) continue;
        const double whole = (f.centroid - height) * f.area_z;
        if (f.high <= height) {
            volume += whole;
        } else if (f.mid >= height) {  // one corner below: a similar triangle, centroid a third of its depth below
            const double depth = height - f.low;
            const double share = depth * depth / ((f.mid - f.low) * (f.high - f.low));
            volume -= share * depth / 3 * f.area_z;
        } else {  // one corner above
            const double depth = f.high - height;
            const double share = depth * depth / ((f.high - f.mid) * (f.high - f.low));
            volume += whole - share * depth / 3 * f.area_z;
        }
    }
    return model_.load(0, count, volume);
}

double LoadProfile::fraction_below(double height) const { return load_below(facets_, nodes_, height) / total_; }

double LoadProfile::bisect(double fraction) const {
    double low = lowest_, high = highest_;
    for (int i = 0; i < 40 && high - low > 1e-9 * (highest_ - lowest_); ++i) {
        const double middle = (low + high) / 2;
        (load_below(facets_, nodes_, middle) < fraction * total_ ? low : high) = middle;
    }
    return (low + high) / 2;
}

}  // namespace kerf

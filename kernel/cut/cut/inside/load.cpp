// Volume below the plane z = s by the divergence theorem with the field (0, 0, z - s): V(s) = sum over the surface
// below of the integral of (z - s) n_z dA; the cap contributes nothing because z = s there. For a whole facet the
// integral is (mean z - s) A n_z; for a crossing facet the part below is the facet minus the corner above, or the
// corner below. The second moment, the integral of z^2, is the same with the potential p(z) = z^3/3 in place of z; the
// volume integral is that of its derivative p'.
#include "cut/cut/inside/load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/geometry/triangle.h"
#include "cut/cut/inside/ordered_terms.h"

namespace kerf {

namespace {

double count_up_to(std::span<const double> values, double bound) {
    std::size_t count = 0;
    for (const std::size_t of_range : values_of_ranges(values.size(), items_of_thread, [&](const IndexRange& range) {
             std::size_t own = 0;
             for (std::size_t i = range.first; i < range.last; ++i) own += values[i] <= bound;
             return own;
         }))
        count += of_range;
    return static_cast<double>(count);
}

}  // namespace

double LoadModel::load(double vertices, double facets, double volume) const {
    switch (balance) {
        case Balance::nodes:
            return vertices;
        case Balance::faces:
            return facets;
        case Balance::volume:
        case Balance::inertia:
            return volume;
        case Balance::work:
            return facets + (size.is_empty() ? 0 : volume_weight * volume / size.reference_volume());
    }
    return 0;
}

double LoadModel::volume_of(const SurfaceArrays& surface, double enclosed) const {
    if (!needs_volume()) return 0;
    return depends_on_place() ? sized_volume(size, surface.vertices, surface.facets, enclosed) : enclosed;
}

LoadModel LoadModel::of(const Surface& surface) const {
    LoadModel model = *this;
    if (!depends_on_place()) return model;
    const SurfaceArrays arrays = surface.arrays();
    model.samples =
        std::make_shared<const std::vector<VolumeSample>>(sample_volume(size, arrays.vertices, arrays.facets));
    return model;
}

LoadProfile::LoadProfile(const Surface& surface, const Plane& plane, const LoadModel& model) : model_(model) {
    KERF_CHECK(surface.facet_count() > 0 && plane.is_orthonormal());
    if (model_.depends_on_place()) {
        if (!model_.samples) model_ = model_.of(surface);
        for (const VolumeSample& sample : *model_.samples)
            samples_.emplace_back(plane.distance(sample.point), sample.sized_volume);
        std::sort(samples_.begin(), samples_.end());
        for (std::size_t i = 1; i < samples_.size(); ++i) samples_[i].second += samples_[i - 1].second;
    }
    Array<Vertex, double> height(surface.vertex_count());
    std::tie(lowest_, highest_) = bounds_on_threads(
        height.size(), [&](std::size_t v) { return height[v] = plane.distance(surface.point(Vertex(v))); });
    if (model_.needs_volume() && !model_.depends_on_place())
        find_items(surface, plane, height);
    else if (model_.balance == Balance::nodes)
        centroids_ = std::move(height);
    else
        find_centroids(surface, height);
    total_ =
        items_.empty() ? load_of(count_up_to(centroids_, highest_), 0, highest_) : load_below(items_, {}, highest_);
}

void LoadProfile::find_items(const Surface& surface, const Plane& plane, const Array<Vertex, double>& height) {
    items_.resize(surface.facet_count());
    for_ranges_on_threads(items_.size(), items_of_thread, [&](const IndexRange& range) {
        for (std::size_t f = range.first; f < range.last; ++f) {
            const auto t = surface.corners(Facet(f));
            const Vec3 normal_area = area_vector(surface.point(t[0]), surface.point(t[1]), surface.point(t[2]));
            std::array<double, 3> z = {height[t[0]], height[t[1]], height[t[2]]};
            std::sort(z.begin(), z.end());
            items_[f] = {z[0],
                         z[1],
                         z[2],
                         normal_area.dot(plane.normal),
                         (z[0] + z[1] + z[2]) / 3,
                         mean_potential(z[0], z[1], z[2])};
        }
    });
}

void LoadProfile::find_centroids(const Surface& surface, const Array<Vertex, double>& height) {
    centroids_.resize(surface.facet_count());
    for_ranges_on_threads(centroids_.size(), items_of_thread, [&](const IndexRange& range) {
        for (std::size_t f = range.first; f < range.last; ++f) {
            const auto t = surface.corners(Facet(f));
            std::array<double, 3> z = {height[t[0]], height[t[1]], height[t[2]]};
            std::sort(z.begin(), z.end());  // the sum of three depends on their order
            centroids_[f] = (z[0] + z[1] + z[2]) / 3;
        }
    });
}

double LoadProfile::load_of(double count, double integral, double height) const {
    return model_.load(count, count, model_.depends_on_place() ? sampled_volume_below(height) : integral);
}

void LoadProfile::Below::add(const Item& item) {
    count += 1;
    area_z += item.area_z;
    integral += item.area_z * item.potential;
}

double LoadProfile::potential(double height) const {
    return model_.balance == Balance::inertia ? height * height * height / 3 : height;
}

// Over a triangle with these heights: of z the mean of the three, of z^3 that of the ten products of three of them.
double LoadProfile::mean_potential(double a, double b, double c) const {
    if (model_.balance != Balance::inertia) return (a + b + c) / 3;
    return ((a * a + b * b + c * c) * (a + b + c) + a * b * c) / 30;
}

double LoadProfile::sampled_volume_below(double height) const {
    const auto above = std::upper_bound(samples_.begin(), samples_.end(), std::pair(height, double{INFINITY}));
    return above == samples_.begin() ? 0 : std::prev(above)->second;
}

double LoadProfile::load_below(std::span<const Item> items, const Below& below, double height) const {
    const double level = potential(height);
    double count = below.count, integral = below.integral - level * below.area_z;
    for (const Item& f : items) {
        if (f.centroid <= height) ++count;
        if (f.low >= height) continue;
        const double whole = (f.potential - level) * f.area_z;
        if (f.high <= height) {
            integral += whole;
        } else if (f.mid >= height) {  // one corner below: a similar triangle
            const double depth = height - f.low;
            const double share = depth * depth / ((f.mid - f.low) * (f.high - f.low));
            integral += share * (mean_potential(f.low, height, height) - level) * f.area_z;
        } else {  // one corner above
            const double depth = f.high - height;
            const double share = depth * depth / ((f.high - f.mid) * (f.high - f.low));
            integral += whole - share * (mean_potential(f.high, height, height) - level) * f.area_z;
        }
    }
    return load_of(count, integral, height);
}

double LoadProfile::fraction_below(double height) const {
    if (items_.empty()) return load_of(count_up_to(centroids_, height), 0, height) / total_;
    return load_below(items_, {}, height) / total_;
}

void LoadProfile::settle(double low, double high, std::vector<Item>& open, Below& below) {
    std::size_t kept = 0;
    for (const Item& item : open) {
        if (item.high <= low)
            below.add(item);
        else if (item.low < high)
            open[kept++] = item;
    }
    open.resize(kept);
}

std::vector<double> LoadProfile::fractions_below(const std::vector<double>& heights) const {
    std::vector<double> fractions;
    if (items_.empty())
        for (const double height : heights) fractions.push_back(fraction_below(height));
    if (heights.empty() || items_.empty()) return fractions;
    const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
    std::vector<Item> open = items_;
    Below below;
    settle(*low, std::nextafter(*high, INFINITY), open, below);  // vertices at the highest height lie below it
    for (const double height : heights) fractions.push_back(load_below(open, below, height) / total_);
    return fractions;
}

// Items that fall out of the bracket are settled, so the work halves with every step.
double LoadProfile::bisect(double fraction) const {
    KERF_CHECK(fraction >= 0 && fraction <= 1);
    if (items_.empty()) return bisect_count(fraction);
    std::vector<Item> open = items_;
    Below below;
    double low = lowest_, high = highest_;
    for (int i = 0; i < 40 && high - low > 1e-9 * (highest_ - lowest_); ++i) {
        const double middle = (low + high) / 2;
        (load_below(open, below, middle) < fraction * total_ ? low : high) = middle;
        settle(low, high, open, below);
    }
    return (low + high) / 2;
}

double LoadProfile::bisect_count(double fraction) const {
    std::vector<double> open = centroids_;
    double below = 0, low = lowest_, high = highest_;
    for (int i = 0; i < 40 && high - low > 1e-9 * (highest_ - lowest_); ++i) {
        const double middle = (low + high) / 2, up_to_middle = count_up_to(open, middle);
        const bool is_low = load_of(below + up_to_middle, 0, middle) < fraction * total_;
        (is_low ? low : high) = middle;
        if (is_low) below += up_to_middle;
        std::size_t kept = 0;
        for (const double z : open) {
            open[kept] = z;
            kept += (z > middle) == is_low;
        }
        open.resize(kept);
    }
    return (low + high) / 2;
}

}  // namespace kerf

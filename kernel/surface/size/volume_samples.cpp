// A cell is split as long as it is the one that may hold most tetrahedra: its volume over the cube of the least size
// that the growth allows in it. So no fine place hides between samples.
#include "surface/size/volume_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>

#include "base/core/check.h"
#include "base/geometry/box_tree.h"
#include "surface/complex/mass_properties.h"

namespace kerf {

namespace {

constexpr std::size_t most_cells = 10'000;
constexpr int first_cells = 512, most_first_splits = 64;  // nearly cubes; on each side of the box
constexpr std::size_t few_samples = 200;

struct OctreeCell {
    double most = 0;  // tetrahedra that may be wanted
    Vec3 low, high;

    Vec3 centre() const { return (low + high) / 2; }
    double volume() const { return (high - low).prod(); }
};

bool wants_less(const OctreeCell& a, const OctreeCell& b) {
    return std::tie(a.most, a.low.x(), a.low.y(), a.low.z()) < std::tie(b.most, b.low.x(), b.low.y(), b.low.z());
}

class Octree {
 public:
    Octree(const SizeField& field, const Box& box) : field_(field) {
        const double edge = std::max(std::cbrt(box.volume() / first_cells), box.sizes().maxCoeff() / most_first_splits);
        std::array<int, 3> count{};
        for (int axis = 0; axis < 3; ++axis) count[axis] = std::max(1L, std::lround(box.sizes()[axis] / edge));
        split(box.min(), box.max(), count);
    }

    std::vector<OctreeCell> take() {
        while (cells_.size() < most_cells) {
            std::pop_heap(cells_.begin(), cells_.end(), wants_less);
            const OctreeCell cell = cells_.back();
            cells_.pop_back();
            split(cell.low, cell.high, {2, 2, 2});
        }
        return std::move(cells_);
    }

 private:
    void split(const Vec3& low, const Vec3& high, const std::array<int, 3>& count) {
        const Vec3 step = (high - low).cwiseQuotient(Vec3(count[0], count[1], count[2]));
        for (int i = 0; i < count[0]; ++i)
            for (int j = 0; j < count[1]; ++j)
                for (int k = 0; k < count[2]; ++k) {
                    const Vec3 corner = low + Vec3(i, j, k).cwiseProduct(step);
                    add({0, corner, corner + step});
                }
    }
    void add(OctreeCell cell) {
        const double radius = (cell.high - cell.low).norm() / 2;
        const double least = std::max(field_.smallest(), field_.at(cell.centre()) - field_.growth() * radius);
        cell.most = cell.volume() / (least * least * least);
        cells_.push_back(cell);
        std::push_heap(cells_.begin(), cells_.end(), wants_less);
    }

    const SizeField& field_;
    std::vector<OctreeCell> cells_;  // a heap
};

// Tells the inside by the facets above a point. Rounding may tell a point next to an edge wrongly.
class InsideTest {
 public:
    InsideTest(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets)
        : vertices_(vertices), facets_(facets), tree_(boxes_around(vertices, facets)) {}

    bool operator()(const Vec3& p) const {
        Vec3 top = p;
        top.z() = std::numeric_limits<double>::max();
        int turns = 0;
        tree_.for_each_meeting(Box(p, top), [&](std::int32_t f) { turns += turns_above(p, f); });
        return turns != 0;
    }

 private:
    // Twice the area of the projection of the triangle p, a, b.
    static double area(const Vec3& p, const Vec3& a, const Vec3& b) {
        return (a.x() - p.x()) * (b.y() - p.y()) - (a.y() - p.y()) * (b.x() - p.x());
    }
    // Whether p lies left of the line from a to b; the opposite for b and a exchanged, also on the line, where the
    // answer is that for a point moved by a little in y, and by much less in -x.
    static bool is_left(const Vec3& p, const Vec3& a, const Vec3& b) {
        if (std::tie(b.x(), b.y()) < std::tie(a.x(), a.y())) return !is_left(p, b, a);
        return area(p, a, b) >= 0;
    }
    int turns_above(const Vec3& p, std::int32_t facet) const {
        const auto& [i, j, k] = facets_[facet];
        const Vec3 &a = vertices_[i], &b = vertices_[j], &c = vertices_[k];
        const bool left = is_left(p, a, b);
        if (is_left(p, b, c) != left || is_left(p, c, a) != left) return 0;
        const double of_a = area(p, b, c), of_b = area(p, c, a), of_c = area(p, a, b), sum = of_a + of_b + of_c;
        if (sum == 0) return 0;
        const double height = (of_a * a.z() + of_b * b.z() + of_c * c.z()) / sum;
        return height > p.z() ? (left ? 1 : -1) : 0;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    BoxTree tree_;
};

}  // namespace

std::vector<VolumeSample> sample_volume(const SizeField& field, const std::vector<Vec3>& vertices,
                                        const std::vector<Triangle>& facets) {
    KERF_CHECK(!field.is_constant() && !facets.empty());
    Box box;
    Vec3 mean = Vec3::Zero();
    for (const Triangle& t : facets)
        for (const std::int32_t v : t) {
            box.extend(vertices[v]);
            mean += vertices[v] / (3 * facets.size());
        }
    const InsideTest is_inside(vertices, facets);
    std::vector<VolumeSample> samples;
    double volume = 0;
    for (const OctreeCell& cell : Octree(field, box).take()) {
        if (!is_inside(cell.centre())) continue;
        volume += cell.volume();
        samples.push_back({cell.centre(), cell.volume()});
    }
    if (samples.empty()) {
        samples.push_back({mean, 1});
        volume = 1;
    }
    // The volume is known, and so is its part of the integral with the least density of all; where the samples are few,
    // so is all of it.
    const double correction = std::abs(enclosed_volume(vertices, facets)) / volume;
    double least = 1;
    std::vector<double> density;
    for (const VolumeSample& sample : samples) {
        density.push_back(field.reference_volume() / field.max_volume_at(sample.point));
        least = std::min(least, density.back());
    }
    const double beyond_least = samples.size() < few_samples ? correction : 1;
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].sized_volume *= correction * least + beyond_least * (density[i] - least);
    return samples;
}

double sized_volume(const SizeField& field, const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                    double volume) {
    if (field.is_constant()) return volume;
    double sum = 0;
    for (const VolumeSample& sample : sample_volume(field, vertices, facets)) sum += sample.sized_volume;
    return sum;
}

}  // namespace kerf

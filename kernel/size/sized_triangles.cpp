#include "size/sized_triangles.h"

#include <algorithm>
#include <cmath>

#include "surface/closest_point.h"

namespace kerf {

namespace {

constexpr std::int32_t triangles_of_leaf = 4;
constexpr double more = 1 + 1e-9;  // what is as good to so much stays, however it is computed
constexpr double cells_per_side = 8;
constexpr double less = 1 - 1e-12;  // boxes promise a little less than they hold, so that rounding hides nothing

// No size_at() is less: equal sizes are kept to the last bit, and what is added for the distance is not negative.
double floor_of(const SizedTriangle& t) { return t.is_uniform() ? t.smallest() : less * t.smallest(); }

}  // namespace

Vec3 SizedTriangle::closest(const Vec3& p) const {
    const Vec3 a = corner(0), b = corner(1), c = corner(2);
    return a != b || a != c ? closest_barycentric(p, a, b, c) : Vec3(Vec3::UnitX());
}

double SizedTriangle::distance(const Vec3& p) const {
    const Vec3 t = closest(p);
    return (p - t[0] * corner(0) - t[1] * corner(1) - t[2] * corner(2)).norm();
}

double SizedTriangle::size_at(const Vec3& p, double growth) const {
    const Vec3 t = closest(p);
    const double distance = (p - t[0] * corner(0) - t[1] * corner(1) - t[2] * corner(2)).norm();
    // Equal sizes stay as they are, whatever the coordinates add up to.
    const double here = size[0] + t[1] * (size[1] - size[0]) + t[2] * (size[2] - size[0]);
    return here + growth * std::max(0.0, distance - reach);
}

// Moeller and Trumbore 1997.
double SizedTriangle::hit(const Vec3& origin, const Vec3& direction) const {
    const Vec3 a = corner(0), ab = corner(1) - a, ac = corner(2) - a;
    const Vec3 across = direction.cross(ac);
    const double volume = ab.dot(across);
    if (volume == 0) return std::numeric_limits<double>::infinity();
    const Vec3 from_a = origin - a;
    const double u = from_a.dot(across) / volume;
    const Vec3 turned = from_a.cross(ab);
    const double v = direction.dot(turned) / volume, distance = ac.dot(turned) / volume;
    const bool is_inside = u >= 0 && v >= 0 && u + v <= 1 && distance >= 0;
    return is_inside ? distance : std::numeric_limits<double>::infinity();
}

SizedTriangles::SizedTriangles(std::vector<SizedTriangle> triangles) : triangles_(std::move(triangles)) {
    std::stable_sort(triangles_.begin(), triangles_.end(),
                     [](const SizedTriangle& s, const SizedTriangle& t) { return s.reach < t.reach; });
    order(0, static_cast<std::int32_t>(triangles_.size()));
    build_nodes();
}

// Where a node is divided: in halves or, as one far reach would hide that others are short, between two reaches.
std::int32_t SizedTriangles::middle(std::int32_t first, std::int32_t last) const {
    const std::int32_t half = first + (last - first) / 2;
    if (triangles_[first].reach == triangles_[last - 1].reach) return half;
    const auto begin = triangles_.begin();
    const auto [low, high] =
        std::equal_range(begin + first, begin + last, triangles_[half],
                         [](const SizedTriangle& s, const SizedTriangle& t) { return s.reach < t.reach; });
    const auto below = static_cast<std::int32_t>(low - begin), above = static_cast<std::int32_t>(high - begin);
    return above == last || (below > first && half - below <= above - half) ? below : above;
}

// Halves of one reach are made along the longest side of the box around the centres.
void SizedTriangles::order(std::int32_t first, std::int32_t last) {
    if (last - first <= triangles_of_leaf) return;
    const std::int32_t half = middle(first, last);
    if (triangles_[first].reach != triangles_[last - 1].reach) {
        order(first, half);
        order(half, last);
        return;
    }
    const auto centre = [](const SizedTriangle& t) { return Vec3(t.corner(0) + t.corner(1) + t.corner(2)); };
    Eigen::AlignedBox3d centres;
    for (std::int32_t i = first; i < last; ++i) centres.extend(centre(triangles_[i]));
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const auto begin = triangles_.begin();
    std::nth_element(begin + first, begin + half, begin + last, [&](const SizedTriangle& s, const SizedTriangle& t) {
        return std::pair(centre(s)[axis], s.coordinates) < std::pair(centre(t)[axis], t.coordinates);
    });
    order(first, half);
    order(half, last);
}

void SizedTriangles::build_nodes() {
    nodes_.clear();
    if (!triangles_.empty()) add_node(0, static_cast<std::int32_t>(triangles_.size()));
}

std::int32_t SizedTriangles::add_node(std::int32_t first, std::int32_t last) {
    const auto number = static_cast<std::int32_t>(nodes_.size());
    Node node;
    node.first = first;
    node.last = last;
    nodes_.push_back(node);
    const auto take = [&](const Eigen::AlignedBox3d& box, double size, double reach, double floor) {
        node.box.extend(box);
        node.size = std::min(node.size, size);
        node.reach = std::max(node.reach, reach);
        node.floor = std::min(node.floor, floor);
    };
    if (last - first <= triangles_of_leaf) {
        for (std::int32_t i = first; i < last; ++i) {
            Eigen::AlignedBox3d box;
            const SizedTriangle& t = triangles_[i];
            for (int c = 0; c < 3; ++c) box.extend(t.corner(c));
            take(box, t.smallest(), t.reach, floor_of(t));
        }
    } else {
        const std::int32_t half = middle(first, last), left = add_node(first, half);
        node.right = add_node(half, last);
        for (const std::int32_t child : {left, node.right})
            take(nodes_[child].box, nodes_[child].size, nodes_[child].reach, nodes_[child].floor);
    }
    nodes_[number] = node;
    return number;
}

double SizedTriangles::size_at(const Vec3& p, double growth, double bound, std::int64_t* asked) const {
    return least(
        bound,
        [&](const Node& node) {
            return std::max(node.floor,
                            less * (node.size + growth * std::max(0.0, node.box.exteriorDistance(p) - node.reach)));
        },
        [&](const SizedTriangle& t) {
            if (asked) ++*asked;
            return t.size_at(p, growth);
        });
}

// Not more than the bound, either.
SizedTriangles::Ceiling SizedTriangles::largest_in(const Eigen::AlignedBox3d& cell, double growth, double bound) const {
    const Vec3 centre = cell.center();
    const double radius = cell.diagonal().norm() / 2;
    const double rounding = 1e-12 * cell.min().cwiseAbs().cwiseMax(cell.max().cwiseAbs()).maxCoeff();  // of distances
    Ceiling ceiling{bound, none};
    least(
        bound,
        [&](const Node& node) {
            return std::max(node.size, less * (node.size + growth * std::max(0.0, node.box.exteriorDistance(centre) +
                                                                                      radius - node.reach)));
        },
        [&](const SizedTriangle& t) {
            const double distance = t.distance(centre) + radius;
            const double size = t.largest() + growth * std::max(0.0, distance - t.reach);
            if (size < ceiling.size) {
                const bool is_exact = t.is_uniform() && distance * more + rounding < t.reach;
                ceiling = {size, is_exact ? static_cast<std::int32_t>(&t - triangles_.data()) : none};
            }
            return size;
        });
    return ceiling;
}

// Marks those below a node that may have less than the ceiling in the cell, or as much where no single triangle has
// that; returns whether all are marked.
bool SizedTriangles::mark(std::int32_t number, const Eigen::AlignedBox3d& cell, double growth, const Ceiling& ceiling,
                          std::vector<char>& node_is_kept, std::vector<char>& is_kept) const {
    if (node_is_kept[number] != 0) return true;
    const Node& node = nodes_[number];
    const auto may_ask = [&](double size, double floor, const Eigen::AlignedBox3d& box, double reach) {
        if (ceiling.triangle != none && floor >= ceiling.size) return false;
        return less * (size + growth * std::max(0.0, box.exteriorDistance(cell) - reach)) <= more * ceiling.size;
    };
    if (!may_ask(node.size, node.floor, node.box, node.reach)) return false;
    bool all = true;
    if (node.right > 0) {
        for (const std::int32_t child : {number + 1, node.right})
            all = mark(child, cell, growth, ceiling, node_is_kept, is_kept) && all;
    } else {
        for (std::int32_t i = node.first; i < node.last; ++i) {
            const SizedTriangle& t = triangles_[i];
            Eigen::AlignedBox3d box;
            for (int c = 0; c < 3; ++c) box.extend(t.corner(c));
            if (may_ask(t.smallest(), floor_of(t), box, t.reach)) is_kept[i] = 1;
            all = all && is_kept[i] != 0;
        }
    }
    node_is_kept[number] = all ? 1 : 0;
    return all;
}

SizedTriangles SizedTriangles::within(const Eigen::AlignedBox3d& box, double growth,
                                      const std::function<double(const Eigen::AlignedBox3d&)>& bound) const {
    if (empty()) return {};
    std::vector<char> node_is_kept(nodes_.size(), 0), is_kept(triangles_.size(), 0);
    const double side = box.sizes().maxCoeff() / cells_per_side;
    std::array<int, 3> count = {1, 1, 1};
    for (int axis = 0; axis < 3; ++axis)
        if (side > 0) count[axis] = std::max(1, static_cast<int>(std::ceil(box.sizes()[axis] / side)));
    const Vec3 step = box.sizes().cwiseQuotient(Vec3(count[0], count[1], count[2]));
    for (int i = 0; i < count[0]; ++i)
        for (int j = 0; j < count[1]; ++j)
            for (int k = 0; k < count[2]; ++k) {
                const Vec3 low = box.min() + step.cwiseProduct(Vec3(i, j, k));
                const Eigen::AlignedBox3d cell(low, low + step);
                const Ceiling ceiling = largest_in(cell, growth, bound(cell));
                if (ceiling.triangle != none) is_kept[ceiling.triangle] = 1;
                mark(0, cell, growth, ceiling, node_is_kept, is_kept);
            }
    std::vector<SizedTriangle> kept;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (is_kept[t] != 0) kept.push_back(triangles_[t]);
    if (kept.empty()) kept.push_back(triangles_.front());
    return SizedTriangles(std::move(kept));
}

// Where the ray enters the box, 0 if it begins inside, infinity if it misses it.
double SizedTriangles::entry(const Eigen::AlignedBox3d& box, const Vec3& origin, const Vec3& direction) {
    double low = 0, high = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) {
            if (origin[axis] < box.min()[axis] || origin[axis] > box.max()[axis]) return infinity;
            continue;
        }
        const double first = (box.min()[axis] - origin[axis]) / direction[axis];
        const double second = (box.max()[axis] - origin[axis]) / direction[axis];
        low = std::max(low, std::min(first, second));
        high = std::min(high, std::max(first, second));
    }
    return low * less <= high ? low * less : infinity;
}

}  // namespace kerf

// A minimum over many triangles t of s_t(p) + growth * max(0, d_t(p) - reach_t), where s_t is linear on the triangle
// and d_t the distance. The tree is one of boxes, but nodes are divided between two reaches before they are divided in
// space, because one triangle with a long reach would make the bound of a node useless for all others. Bounds of nodes
// are lowered by `less`, so that rounding never hides a triangle, and `floor` is a bound that is exact for triangles of
// equal sizes: it ends a search at once where many triangles reach as far as p.
// within() drops triangles for a box without changing any answer there. In each cell the ceiling is an upper bound of
// the minimum; triangles that cannot have less in the cell are dropped, and if one triangle has exactly the ceiling
// everywhere in the cell, so are all that can have no less than that.
#include "surface/size/inside/sized_triangles.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/closest_point.h"
#include "base/geometry/ray.h"

namespace kerf {

namespace {

constexpr double more = 1 + 1e-9;  // an answer up to so much larger may be the same, computed otherwise
constexpr double cells_per_side = 8;
constexpr double less = 1 - 1e-12;  // boxes promise a little less than they hold, so that rounding hides nothing

// A lower bound of size_at(): equal sizes are kept to the last bit, and the addition for the distance is not negative.
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

double SizedTriangle::hit(const Vec3& origin, const Vec3& direction) const {
    const double distance = line_triangle_distance(origin, direction, corner(0), corner(1), corner(2));
    return distance >= 0 ? distance : std::numeric_limits<double>::infinity();
}

SizedTriangles::Node::Node(const SizedTriangle& triangle)
    : size(triangle.smallest()), reach(triangle.reach), floor(floor_of(triangle)) {
    for (int c = 0; c < 3; ++c) box.extend(triangle.corner(c));
}

void SizedTriangles::Node::add(const Node& other) {
    BoxNode::add(other);
    size = std::min(size, other.size);
    reach = std::max(reach, other.reach);
    floor = std::min(floor, other.floor);
}

SizedTriangles::SizedTriangles(std::vector<SizedTriangle> triangles) : triangles_(std::move(triangles)) {
    std::stable_sort(triangles_.begin(), triangles_.end(),
                     [](const SizedTriangle& s, const SizedTriangle& t) { return s.reach < t.reach; });
    build_tree(Order::to_be_made);
}

// Returns the place where a node is divided: in the middle or, as one long reach would hide that others are short,
// between two reaches.
std::int32_t SizedTriangles::middle(std::int32_t first, std::int32_t last) const {
    const std::int32_t half = first + (last - first) / 2;
    if (triangles_[first].reach == triangles_[last - 1].reach) return half;
    const auto begin = triangles_.begin();
    const auto [low, high] =
        std::equal_range(begin + first, begin + last, triangles_[half],
                         [](const SizedTriangle& s, const SizedTriangle& t) { return s.reach < t.reach; });
    const std::int32_t below = low - begin, above = high - begin;
    return above == last || (below > first && half - below <= above - half) ? below : above;
}

// Halves of one reach are made along the longest side of the box around the centres.
void SizedTriangles::build_tree(Order order) {
    const auto centre_of = [](const SizedTriangle& t) { return Vec3(t.corner(0) + t.corner(1) + t.corner(2)); };
    const auto coordinates_of = [](const SizedTriangle& t) -> const auto& { return t.coordinates; };
    const auto halve = [&](std::int32_t first, std::int32_t last) {
        const auto begin = triangles_.begin();
        if (order == Order::to_be_made && triangles_[first].reach == triangles_[last - 1].reach)
            halve_by_centre(begin + first, begin + last, centre_of, coordinates_of);
        return middle(first, last);
    };
    tree_ = {triangles_.size(), halve, [&](std::int32_t i) { return Node(triangles_[i]); }};
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

// Returns an upper bound of the size in the cell, at most `bound`.
SizedTriangles::Ceiling SizedTriangles::largest_in(const Box& cell, double growth, double bound) const {
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
bool SizedTriangles::mark(std::int32_t number, const Box& cell, double growth, const Ceiling& ceiling,
                          std::vector<char>& node_is_kept, std::vector<char>& is_kept) const {
    if (node_is_kept[number] != 0) return true;
    const Node& node = tree_.nodes()[number];
    const auto may_ask = [&](const Node& below) {
        if (ceiling.triangle != none && below.floor >= ceiling.size) return false;
        const double distance = std::max(0.0, below.box.exteriorDistance(cell) - below.reach);
        return less * (below.size + growth * distance) <= more * ceiling.size;
    };
    if (!may_ask(node)) return false;
    bool all = true;
    if (node.left > 0) {
        for (const std::int32_t child : {node.left, node.left + 1})
            all = mark(child, cell, growth, ceiling, node_is_kept, is_kept) && all;
    } else {
        for (std::int32_t i = node.first; i < node.last; ++i) {
            if (may_ask(Node(triangles_[i]))) is_kept[i] = 1;
            all = all && is_kept[i] != 0;
        }
    }
    node_is_kept[number] = all ? 1 : 0;
    return all;
}

SizedTriangles SizedTriangles::within(const Box& box, double growth,
                                      const std::function<double(const Box&)>& bound) const {
    if (empty()) return {};
    std::vector<char> node_is_kept(tree_.nodes().size(), 0), is_kept(triangles_.size(), 0);
    const double side = box.sizes().maxCoeff() / cells_per_side;
    std::array<int, 3> count = {1, 1, 1};
    for (int axis = 0; axis < 3; ++axis)
        if (side > 0) count[axis] = std::max(1, static_cast<int>(std::ceil(box.sizes()[axis] / side)));
    const Vec3 step = box.sizes().cwiseQuotient(Vec3(count[0], count[1], count[2]));
    for (int i = 0; i < count[0]; ++i)
        for (int j = 0; j < count[1]; ++j)
            for (int k = 0; k < count[2]; ++k) {
                const Vec3 low = box.min() + step.cwiseProduct(Vec3(i, j, k));
                const Box cell(low, low + step);
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

// Returns the distance at which the ray enters the box, 0 if it begins inside, infinity if it misses it.
double SizedTriangles::entry(const Box& box, const Vec3& origin, const Vec3& direction) {
    const RayPiece piece = piece_in_box(box, origin, direction, {});
    return piece.from * less <= piece.to ? piece.from * less : infinity;
}

}  // namespace kerf

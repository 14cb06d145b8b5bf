// The segment leaves the bounding box of the shell nearly parallel to a coordinate axis, so that its own box is thin
// and most facets are dismissed by comparing boxes.
#include "surface/soup/ray_parity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/geometry/predicates.h"

namespace kerf {

namespace {

constexpr int attempts = 24;

enum class Crossing { none, proper, touching };

// The way in which the segment st, with t outside of the convex hull of the shell, crosses the triangle abc.
Crossing crossing(const Vec3& s, const Vec3& t, const Vec3& a, const Vec3& b, const Vec3& c) {
    const int side_s = orientation(a, b, c, s), side_t = orientation(a, b, c, t);
    if (side_s * side_t > 0) return Crossing::none;
    std::array<int, 3> pass = {orientation(s, t, a, b), orientation(s, t, b, c), orientation(s, t, c, a)};
    std::sort(pass.begin(), pass.end());
    if (pass[0] < 0 && pass[2] > 0) return Crossing::none;
    return side_s * side_t == 0 || pass[0] == 0 || pass[2] == 0 || pass[1] == 0 ? Crossing::touching : Crossing::proper;
}

// A point beyond the box, each attempt through another side and with another slant.
Vec3 point_beyond(const Box& box, const Vec3& point, int attempt) {
    const int axis = attempt % 3;
    const bool upper = attempt / 3 % 2 == 0;
    const double size = box.diagonal().norm();
    const double slant = 0.0071 * size * (1 + attempt / 6);
    Vec3 target = point;
    target[axis] = upper ? box.max()[axis] + 0.1 * size : box.min()[axis] - 0.1 * size;
    target[(axis + 1) % 3] += slant;
    target[(axis + 2) % 3] += 0.618034 * slant;
    return target;
}

// Calls visit(facet) for the facets whose boxes meet the box, and perhaps for others.
template <class Visit>
void for_each_facet_near(const Shell& shell, const BoxTree* tree, const Box& box, Visit visit) {
    if (tree)
        tree->for_each_meeting(box, [&](std::int32_t f) { visit(shell.facets[f]); });
    else
        for (const Triangle& t : shell.facets) visit(t);
}

std::optional<bool> crosses_odd_times(const std::vector<Vec3>& vertices, const Shell& shell, const BoxTree* tree,
                                      const Vec3& s, const Vec3& t) {
    const Vec3 low = s.cwiseMin(t), high = s.cwiseMax(t);
    bool odd = false, touches = false;
    for_each_facet_near(shell, tree, Box(low, high), [&](const Triangle& facet) {
        const Vec3 &a = vertices[facet[0]], &b = vertices[facet[1]], &c = vertices[facet[2]];
        bool apart = touches;
        for (int x = 0; x < 3; ++x)
            apart |= std::max({a[x], b[x], c[x]}) < low[x] || std::min({a[x], b[x], c[x]}) > high[x];
        if (apart) return;
        const Crossing kind = crossing(s, t, a, b, c);
        touches |= kind == Crossing::touching;
        odd ^= kind == Crossing::proper;
    });
    if (touches) return std::nullopt;
    return odd;
}

// Returns a tree of the facets of a shell that is asked often, else null. Building it takes as long as some tens of
// questions.
const BoxTree* tree_for_question(const std::vector<Vec3>& vertices, const Shell& shell) {
    constexpr std::int32_t few = 32;
    constexpr std::size_t small = 64;
    if (shell.facets.size() < small) return nullptr;
    Shell::Memory& memory = *shell.memory;
    if (memory.questions <= few && ++memory.questions <= few) return nullptr;
    std::call_once(memory.is_built,
                   [&] { memory.tree = std::make_unique<const BoxTree>(boxes_around(vertices, shell.facets)); });
    return memory.tree.get();
}

}  // namespace

std::vector<Shell> collect_shells(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                  const std::vector<std::int32_t>& shell_of_facet, std::int32_t count) {
    KERF_CHECK(shell_of_facet.size() == facets.size());
    KERF_CHECK(are_in_range(facets, vertices.size()));
    std::vector<Shell> shells(count);
    std::vector<std::int32_t> size(count, 0);
    for (const std::int32_t shell : shell_of_facet) {
        KERF_CHECK(shell >= 0 && shell < count);
        ++size[shell];
    }
    for (std::int32_t i = 0; i < count; ++i) shells[i].facets.reserve(size[i]);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        Shell& shell = shells[shell_of_facet[f]];
        shell.facets.push_back(facets[f]);
        shell.box.extend(box_around(vertices, facets[f]));
    }
    return shells;
}

BoxTree boxes_of(const std::vector<Shell>& shells) {
    std::vector<Box> boxes;
    for (const Shell& shell : shells) boxes.push_back(shell.box);
    return BoxTree(std::move(boxes));
}

std::vector<std::int32_t> by_falling_boxes(const std::vector<Shell>& shells) {
    const auto measure = [&](std::int32_t i) {
        const Vec3 &low = shells[i].box.min(), &high = shells[i].box.max();
        return std::array{(high - low).sum(), -low.x(), -low.y(), -low.z(), high.x(), high.y(), high.z()};
    };
    std::vector<std::int32_t> order(shells.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::int32_t i, std::int32_t j) { return measure(i) > measure(j); });
    return order;
}

std::optional<bool> encloses(const std::vector<Vec3>& vertices, const Shell& shell, const Vec3& point) {
    if (!shell.box.contains(point)) return false;
    const BoxTree* const tree = tree_for_question(vertices, shell);
    for (int attempt = 0; attempt < attempts; ++attempt)
        if (const auto odd = crosses_odd_times(vertices, shell, tree, point, point_beyond(shell.box, point, attempt)))
            return odd;
    return std::nullopt;
}

}  // namespace kerf

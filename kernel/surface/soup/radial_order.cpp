// Each facet is a spoke. Half turns from the first one divide the others into four classes, within which the sign of
// one orientation compares two spokes.
#include "surface/soup/radial_order.h"

#include <algorithm>

#include "base/geometry/predicates.h"

namespace kerf {

namespace {

struct Spoke {
    std::int32_t corner;
    Vec3 apex;
    int half = 0;  // 0: as the first facet, 1: up to half a turn from it, 2: opposite, 3: beyond
};

// Spokes at an edge from a to b.
class SpokeOrder {
 public:
    SpokeOrder(const Vec3& a, const Vec3& b, std::vector<Spoke> spokes) : a_(a), b_(b), spokes_(std::move(spokes)) {}

    RadialOrder run() {
        if (!find_halves()) return {{}, RadialDefect::no_area};
        std::sort(spokes_.begin(), spokes_.end(),
                  [&](const Spoke& s, const Spoke& t) { return s.half != t.half ? s.half < t.half : turn(s, t) > 0; });
        RadialOrder order;
        for (std::size_t i = 0; i < spokes_.size(); ++i) {
            if (i > 0 && spokes_[i - 1].half == spokes_[i].half && turn(spokes_[i - 1], spokes_[i]) == 0)
                return {{}, RadialDefect::coincident};
            order.corners.push_back(spokes_[i].corner);
        }
        return order;
    }

 private:
    // 1 if t is less than half a turn ahead of s, 0 if both lie in one plane.
    int turn(const Spoke& s, const Spoke& t) const { return orientation(a_, b_, s.apex, t.apex); }

    bool find_halves() {
        Vec3 beside;
        if (!find_point_beside(spokes_[0].apex, beside)) return false;
        const int first_side = orientation(a_, b_, spokes_[0].apex, beside);
        for (Spoke& s : spokes_) {
            const int ahead = turn(spokes_[0], s);
            if (ahead != 0) {
                s.half = ahead > 0 ? 1 : 3;
                continue;
            }
            const int side = orientation(a_, b_, s.apex, beside);
            if (side == 0) return false;
            s.half = side == first_side ? 0 : 2;
        }
        return true;
    }

    // Any point off the plane of a, b and c: a with another coordinate, which is exact.
    bool find_point_beside(const Vec3& c, Vec3& point) const {
        for (int axis = 0; axis < 3; ++axis) {
            point = a_;
            point[axis] = point[axis] == 0 ? 1 : -point[axis];
            if (orientation(a_, b_, c, point) != 0) return true;
        }
        return false;
    }

    const Vec3 &a_, &b_;
    std::vector<Spoke> spokes_;
};

}  // namespace

RadialOrder radial_order(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets, std::int32_t low,
                         std::span<const EdgeCorners::Corner> corners) {
    std::vector<Spoke> spokes;
    for (const EdgeCorners::Corner& c : corners)
        spokes.push_back({c.corner, vertices[start_vertex(facets, next_corner(next_corner(c.corner)))]});
    return SpokeOrder(vertices[low], vertices[corners[0].high], std::move(spokes)).run();
}

}  // namespace kerf

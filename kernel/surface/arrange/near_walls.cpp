// Each facet is compared with those whose boxes are within the tolerance; it is near another if the corners of the
// smaller are within the tolerance of the plane of the larger and both share area in the projection. The first pass
// finds facets near another body, and among these thin ones: their own body has another facet within 4 tolerances, so
// that moving one wall could flatten the body. The second pass measures the distance of facets that are near. Thin
// facets are no walls, and facets near thin ones alone are none either; thin ones are measured only to be reported. A
// distance counts heights, and the gaps of corners to corners and edges that are within the tolerance: 0 means that
// both are alike already.
#include "surface/arrange/near_walls.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "base/core/ids.h"
#include "base/geometry/box_tree.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/triangle.h"
#include "surface/arrange/inside/facet_contact.h"

namespace kerf {

namespace {

class NearWallFinder {
 public:
    NearWallFinder(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                   const std::vector<std::int32_t>& body, double tolerance, double nothing)
        : vertices_(vertices),
          facets_(facets),
          body_(body),
          tolerance_(tolerance),
          nothing_(nothing),
          tree_(boxes_around(vertices, facets)) {
        found_.is_wall.assign(facets.size(), 0);
        found_.apart.assign(facets.size(), 0);
    }

    NearWalls run(const std::function<void()>& check_cancelled) {
        constexpr std::size_t walls_between_checks = 4096;
        std::vector<char> is_near(facets_.size(), 0), thin(facets_.size(), 0);
        for (std::int32_t f = 0; f < count_of(facets_); ++f) {
            if (f % walls_between_checks == 0) check_cancelled();
            for_each_near(f, tolerance_, [&](std::int32_t g) { is_near[f] |= body_[g] != body_[f]; });
            if (!is_near[f] || !is_thin(f)) continue;
            thin[f] = 1;
            found_.thin.push_back(f);
        }
        for (std::int32_t f = 0; f < count_of(facets_); ++f) {
            if (!is_near[f]) continue;
            for_each_near(f, tolerance_, [&](std::int32_t g) {
                if (body_[g] == body_[f] || (thin[g] && !thin[f])) return;
                found_.is_wall[f] = !thin[f];
                found_.apart[f] = std::max(found_.apart[f], distance(f, g));
            });
        }
        return std::move(found_);
    }

 private:
    Corners corners(std::int32_t f) const {
        const auto& [a, b, c] = facets_[f];
        return {vertices_[a], vertices_[b], vertices_[c]};
    }
    template <class Visit>
    void for_each_near(std::int32_t f, double tolerance, const Visit& visit) const {
        const Corners p = corners(f);
        const int axis = axis_across(p);
        if (axis < 0) return;
        Box box = box_around(p);
        box.min().array() -= tolerance;
        box.max().array() += tolerance;
        tree_.for_each_meeting(box, [&](std::int32_t g) {
            if (g == f) return;
            const Corners q = corners(g);
            if (lie_in_one_plane(p, q, tolerance) && share_area(p, q, axis)) visit(g);
        });
    }
    bool is_thin(std::int32_t f) const {
        constexpr double both_sides = 4;  // so that either wall may move, and they are not walls of each other
        bool is = false;
        for_each_near(f, both_sides * tolerance_, [&](std::int32_t g) {
            const Triangle &s = facets_[f], &t = facets_[g];
            is |= body_[g] == body_[f] && std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) == s.end();
        });
        return is;
    }
    // Returns the distance of two facets that lie on one another; 0: all that is near is the same.
    double distance(std::int32_t f, std::int32_t g) const {
        Corners large = corners(f), small = corners(g);
        if (doubled_area_vector(large).squaredNorm() < doubled_area_vector(small).squaredNorm())
            std::swap(large, small);
        const Vec3 normal = doubled_area_vector(large).normalized();
        double most = 0;
        for (const Vec3& x : small) most = std::max(most, std::abs(normal.dot(x - large[0])));
        for (int turn = 0; turn < 2; ++turn, std::swap(large, small))
            for (const Vec3& x : small)
                for (std::size_t i = 0; i < 3; ++i) {
                    const Vec3 &a = large[i], &b = large[(i + 1) % 3];
                    for (const double off : {(x - a).norm(), (closest_on_segment(x, a, b) - x).norm()})
                        if (off <= tolerance_) most = std::max(most, off);
                }
        return most > nothing_ ? most : 0;
    }

    const std::vector<Vec3>& vertices_;
    const std::vector<Triangle>& facets_;
    const std::vector<std::int32_t>& body_;
    const double tolerance_, nothing_;
    const BoxTree tree_;
    NearWalls found_;
};

}  // namespace

NearWalls find_near_walls(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                          const std::vector<std::int32_t>& body, double tolerance, double nothing,
                          const std::function<void()>& check_cancelled) {
    return NearWallFinder(vertices, facets, body, tolerance, nothing).run(check_cancelled);
}

}  // namespace kerf

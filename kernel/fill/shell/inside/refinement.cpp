// Delaunay refinement (Ruppert 1995, ruppert1995; Shewchuk 1998, shewchuk1998) in a body whose boundary must not be
// split. A cell is to be divided if it is too large or too slender; the one with the largest sphere comes first, and a
// point goes to its circumcentre. Faces that stay cannot give way, so a point is refused instead: inside of the
// smallest sphere around a constrained face that it sees, too near to a vertex, or if it made a cell that is bad and
// worse than all that it replaces. Least lengths of new edges are why this ends. Where flips have left cells that are
// not Delaunay, a point may not remove all in whose spheres it lies; flips follow (fill/delaunay/delaunay_flips.h). A
// cell in the list is stale if its vertices are others by now.
#include "fill/shell/inside/refinement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/core/ids.h"
#include "fill/delaunay/delaunay_flips.h"
#include "fill/improve/cell_shape.h"

namespace kerf {

namespace {

// Least angles of new cells, also to 180 degrees; larger at faces that stay, where a bad cell is hard to mend.
constexpr double least_angle_at_face_deg = 12, least_angle_deg = 5;
// Least length of an edge to a new point, as a share of the wanted one. A bound of the volume is to be kept on coarse
// facets, too.
constexpr double least_edge_share = 0.65, least_edge_share_of_bound = 0.4;
// Least length of an edge to the point for a cell, as a share of the cell's circumradius.
constexpr double least_radius_share = 0.5;

struct BadCell {
    CellId cell;
    Tetrahedron vertices;  // vertices of the cell when it was found
};

// Bad cells, those with the largest spheres first: where there is much room, points do no harm. Radii count in steps of
// a fifth, and within a step the cell that was found last comes first, because it is in the cache.
class CellsByRadius {
 public:
    void add(double radius_sq, const BadCell& bad) {
        const std::size_t step = step_of(radius_sq);
        steps_[step].push_back(bad);
        largest_ = std::max(largest_, step);
    }

    std::optional<BadCell> pop_largest() {
        while (largest_ > 0 && steps_[largest_].empty()) --largest_;
        if (steps_[largest_].empty()) return std::nullopt;
        const BadCell bad = steps_[largest_].back();
        steps_[largest_].pop_back();
        return bad;
    }

 private:
    static constexpr int count = 4096;

    // Returns the step of a radius: two steps to a factor of two in its square.
    static std::size_t step_of(double radius_sq) {
        int exponent = 0;
        const double mantissa = std::frexp(radius_sq, &exponent);
        const int step = 2 * exponent + (mantissa >= std::numbers::sqrt2 / 2 ? 1 : 0) + count / 2;
        return std::isfinite(radius_sq) ? std::clamp(step, 0, count - 1) : count - 1;
    }

    std::vector<std::vector<BadCell>> steps_{count};
    std::size_t largest_ = 0;
};

class Refinement {
 public:
    Refinement(SpatialTriangulation& triangulation, const RefinementBounds& bounds)
        : t_(triangulation),
          size_(bounds.size),
          most_ratio_sq_(bounds.radius_edge > 0 ? bounds.radius_edge * bounds.radius_edge : infinity),
          most_at_face_(square_from_degrees(least_angle_at_face_deg)),
          most_(square_from_degrees(least_angle_deg)) {}

    std::int64_t run() {
        for (const CellId cell : t_.cells()) push(cell);
        std::int64_t points = 0;
        while (const std::optional<BadCell> bad = bad_.pop_largest())
            if (has_cell(*bad)) points += insert_for(bad->cell);
        return points;
    }

 private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    const Vec3& point(std::int32_t vertex) const { return t_.points()[vertex]; }
    bool has_cell(const BadCell& bad) const {
        return bad.cell.value() < t_.cell_count() && t_.vertices(bad.cell) == bad.vertices;
    }
    void push(CellId cell) {
        const auto [a, b, c, d] = corners_of(cell);
        const double radius_sq = radius_sq_to_divide(CellGeometry(a, b, c, d), a, b, c, d);
        if (radius_sq > 0) bad_.add(radius_sq, {cell, t_.vertices(cell)});
    }

    using Corners = std::array<Vec3, 4>;
    Corners corners_of(CellId cell) const {
        const Tetrahedron& v = t_.vertices(cell);
        return {point(v[0]), point(v[1]), point(v[2]), point(v[3])};
    }

    // Returns the square of the circumradius of a cell that is to be divided; 0 for any other.
    double radius_sq_to_divide(const CellGeometry& cell, const Vec3& a, const Vec3& b, const Vec3& c,
                               const Vec3& d) const {
        const double scaled = cell.scaled_circumradius_sq(), scale = 4 * cell.six_volumes() * cell.six_volumes();
        const bool is_to_be_divided = scaled > scale * most_ratio_sq_ * cell.shortest_edge_sq() ||
                                      (!size_.is_empty() && is_too_large(size_, {a, b, c, d}));
        return is_to_be_divided ? scaled / scale : 0;
    }
    double least_edge_sq_at(const Vec3& p) const {
        const double share = size_.is_constant() ? least_edge_share_of_bound : least_edge_share;
        return std::pow(share * size_.at(p), 2);
    }

    static double shortest_edge_sq(const Corners& corners) {
        const Vec3 &a = corners[0], u = corners[1] - a, w = corners[2] - a, x = corners[3] - a;
        return std::min({u.squaredNorm(), w.squaredNorm(), x.squaredNorm(), (w - u).squaredNorm(),
                         (x - u).squaredNorm(), (x - w).squaredNorm()});
    }

    // Returns the circumcentre, counted from corner 0.
    static Vec3 circumcentre_from_first(const Corners& corners) {
        const Vec3 &a = corners[0], u = corners[1] - a, w = corners[2] - a, x = corners[3] - a;
        const Vec3 sum = u.squaredNorm() * w.cross(x) + w.squaredNorm() * x.cross(u) + x.squaredNorm() * u.cross(w);
        return sum / (2 * u.cross(w).dot(x));
    }

    // Inserts a point for a cell. A large cell gets no edge that is much shorter than wanted, a slender one none that
    // is shorter than its own: so this ends. Neither gets one that is much shorter than its radius: where cells are
    // Delaunay there is none, but where flips have left others, a few short edges would fill the body with their like.
    bool insert_for(CellId cell) {
        const Corners corners = corners_of(cell);
        const Vec3 from_first = circumcentre_from_first(corners), circumcentre = corners[0] + from_first;
        if (!circumcentre.allFinite()) return false;
        const Vec3 centroid = (corners[0] + corners[1] + corners[2] + corners[3]) / 4;
        const double least_edge_sq = least_edge_sq_at(centroid);
        const bool is_large = is_too_large(size_, corners), exceeds_bound = is_large && size_.is_constant();
        const double radius_sq = least_radius_share * least_radius_share * from_first.squaredNorm();
        const double least_sq =
            is_large ? least_edge_sq : std::min(std::max(shortest_edge_sq(corners), radius_sq), least_edge_sq);
        if (insert(circumcentre, least_sq, cell, !exceeds_bound)) return true;
        return exceeds_bound && (insert((circumcentre + centroid) / 2, least_edge_sq, cell, false) ||
                                 insert(centroid, least_edge_sq, cell, false));
    }

    // Whether the smallest sphere around a face contains the point.
    bool is_near_face(const Vec3& p, const Triangle& face) const {
        const Vec3 &a = point(face[0]), u = point(face[1]) - a, v = point(face[2]) - a;
        const Vec3 normal = u.cross(v);
        const Vec3 centre =
            (u.squaredNorm() * v.cross(normal) + v.squaredNorm() * normal.cross(u)) / (2 * normal.squaredNorm());
        return (p - a - centre).squaredNorm() < centre.squaredNorm();
    }

    // Whether the point is too near to a vertex of the cell in which it lies. is_good() would say so, too; but where
    // cells are not Delaunay, most points are too near, and very many cells may be in their way.
    bool is_too_near(const Vec3& p, double least_edge_sq, CellId cell) const {
        const Corners corners = corners_of(cell);
        return std::any_of(corners.begin(), corners.end(),
                           [&](const Vec3& corner) { return (corner - p).squaredNorm() < least_edge_sq; });
    }

    bool insert(const Vec3& p, double least_edge_sq, CellId cell, bool keeps_off_faces) {
        const CellId at = t_.locate_in_sight(p, cell);
        if (!at.is_valid() || is_too_near(p, least_edge_sq, at)) return false;
        const auto before = count_of(t_.points());
        InsertionConditions conditions = {.accepts = [&](const Star& star) { return is_good(p, least_edge_sq, star); }};
        if (keeps_off_faces) conditions.is_kept_off_by = [&](const Triangle& face) { return is_near_face(p, face); };
        const std::int32_t vertex = t_.insert_if(p, at, conditions);
        if (vertex < before) return false;  // refused, or there was a vertex already
        for (std::size_t k = made_radius_sq_.size(); k-- > 0;) {
            const CellId made = t_.made_cells()[k];
            if (made_radius_sq_[k] > 0) bad_.add(made_radius_sq_[k], {made, t_.vertices(made)});
        }
        if (t_.has_left_cells()) flip_to_delaunay(t_, t_.made_cells(), [&](CellId made) { push(made); });
        return true;
    }

    // Whether no new cell is both bad and worse than all that it replaces. A cell that will be divided anyway may be
    // so, but not next to a face that stays. Fills made_radius_sq_.
    bool is_good(const Vec3& p, double least_edge_sq, const Star& star) {
        made_radius_sq_.clear();
        double allowed = -infinity;  // worst badness of the cells removed; negative: not computed yet
        return std::all_of(star.faces.begin(), star.faces.end(), [&](const Star::Face& face) {
            const Vec3 &a = point(face.vertices[0]), &b = point(face.vertices[1]), &c = point(face.vertices[2]);
            if (std::min({(a - p).squaredNorm(), (b - p).squaredNorm(), (c - p).squaredNorm()}) < least_edge_sq)
                return false;
            const CellGeometry cell(p, a, b, c);
            made_radius_sq_.push_back(radius_sq_to_divide(cell, p, a, b, c));
            if (!face.is_constrained && made_radius_sq_.back() > 0) return true;
            const double badness = cell.shape().badness();
            if (badness < (face.is_constrained ? most_at_face_ : most_)) return true;
            if (allowed < 0) allowed = worst_of(star.removed);
            return badness < allowed;
        });
    }

    double worst_of(std::span<const CellId> cells) const {
        double worst = 0;
        for (const CellId cell : cells) {
            const Tetrahedron& v = t_.vertices(cell);
            worst = std::max(worst, cell_shape(point(v[0]), point(v[1]), point(v[2]), point(v[3])).badness());
        }
        return worst;
    }

    SpatialTriangulation& t_;
    const SizeField& size_;
    double most_ratio_sq_, most_at_face_, most_;
    CellsByRadius bad_;
    std::vector<double> made_radius_sq_;  // results of radius_sq_to_divide() for the cells of a star, in its order
};

}  // namespace

std::int64_t refine(SpatialTriangulation& triangulation, const RefinementBounds& bounds) {
    return Refinement(triangulation, bounds).run();
}

}  // namespace kerf

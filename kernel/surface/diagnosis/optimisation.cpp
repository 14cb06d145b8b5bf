// Sweeps of Gauss and Seidel over the vertices that may move, in ascending order. Notation: v a vertex, v_j its
// neighbours, its star the facets around it, x a sample point of the original surface, c the point of the current
// surface closest to x (the foot of x), b the barycentric coordinate of c at v, n the normal of the facet of c. When v
// moves by d and the facets of the feet are kept, the energy is to first order
//     sum_x (n . (x - c) - b n . d)^2 + spring sum_j |v + d - v_j|^2,
// distances to planes: along the surface only the springs act, so that a vertex glides at full speed where Hoppe's
// fixed feet would hold it. The minimum is a 3 x 3 system; its solution is shortened until the true energy falls and
// the guards agree. Each sample belongs to the facet of its foot; it changes over only within the star of the vertex
// that is being moved and only to a closer facet, so the energy falls with every move. A vertex that could not move is
// tried again when a neighbour has moved.
#include "surface/diagnosis/optimisation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "base/core/check.h"
#include "base/core/elements.h"
#include "base/core/ids.h"
#include "base/geometry/closest_point.h"
#include "base/geometry/triangle.h"
#include "surface/soup/edge_corners.h"

namespace kerf {

namespace {

constexpr double least_step_rel = 1e-3;  // per edge length: less is no move
constexpr std::array<double, 3> step_lengths = {1, 0.5, 0.25};

double cosine_of_deg(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

// Items grouped by row, ascending within each.
class Rows {
 public:
    // Item i belongs to row_of[i].
    Rows(std::size_t row_count, const std::vector<std::int32_t>& row_of)
        : first_(row_count + 1, 0), items_(row_of.size()) {
        for (std::int32_t row : row_of) ++first_[row + 1];
        for (std::size_t row = 0; row < row_count; ++row) first_[row + 1] += first_[row];
        std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
        for (std::int32_t i = 0; i < count_of(row_of); ++i) items_[next[row_of[i]]++] = i;
    }
    std::span<const std::int32_t> operator[](std::int32_t row) const {
        return {items_.data() + first_[row], items_.data() + first_[row + 1]};
    }

 private:
    std::vector<std::int32_t> first_;
    std::vector<std::int32_t> items_;
};

std::vector<std::int32_t> corner_vertices(const std::vector<Triangle>& facets) {
    std::vector<std::int32_t> corners;
    corners.reserve(3 * facets.size());
    for (const Triangle& t : facets) corners.insert(corners.end(), t.begin(), t.end());
    return corners;
}

// Zero for a facet without area.
Vec3 unit_normal(const std::vector<Vec3>& points, const Triangle& t) {
    return doubled_area_vector(points, t).normalized();
}

std::vector<Vec3> unit_normals(const std::vector<Vec3>& points, const std::vector<Triangle>& facets) {
    std::vector<Vec3> normals;
    normals.reserve(facets.size());
    for (const Triangle& t : facets) normals.push_back(unit_normal(points, t));
    return normals;
}

// Both ends of every feature edge are marked.
void mark_features(const std::vector<Triangle>& facets, const std::vector<Vec3>& normals,
                   const std::vector<std::int32_t>& patch, double feature_cosine, std::vector<char>& marked) {
    EdgeCorners(facets).for_each_edge([&](std::int32_t low, std::span<const EdgeCorners::Corner> corners) {
        const std::int32_t a = corners.front().corner, b = corners.back().corner;
        const bool is_smooth = corners.size() == 2 && start_vertex(facets, a) != start_vertex(facets, b) &&
                               patch[a / 3] == patch[b / 3] && normals[a / 3].dot(normals[b / 3]) >= feature_cosine;
        if (!is_smooth) marked[low] = marked[corners.front().high] = 1;
    });
}

// Returns the mean length at each vertex of the edges by which its facets leave it; 0 without facets.
std::vector<double> mean_edge_lengths(const std::vector<Vec3>& points, const std::vector<Triangle>& facets) {
    std::vector<double> sum(points.size(), 0);
    std::vector<std::int32_t> count(points.size(), 0);
    for (const Triangle& t : facets)
        for (int i = 0; i < 3; ++i) {
            sum[t[i]] += (points[t[(i + 1) % 3]] - points[t[i]]).norm();
            ++count[t[i]];
        }
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] /= std::max(count[v], 1);
    return sum;
}

// The cosine of the smallest angle.
double largest_cosine(const std::vector<Vec3>& points, const Triangle& t) {
    const Vec3 ab = (points[t[1]] - points[t[0]]).normalized();
    const Vec3 bc = (points[t[2]] - points[t[1]]).normalized();
    const Vec3 ca = (points[t[0]] - points[t[2]]).normalized();
    return std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
}

// The point to which a sample is measured.
struct Foot {
    std::int32_t sample, facet;
    Vec3 barycentric;
    double distance_sq;
    bool is_inside() const { return barycentric.minCoeff() > 0; }
};

class NodeOptimiser {
 public:
    NodeOptimiser(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                  const std::vector<std::int32_t>& patch, std::vector<char> fixed, const OptimisationOptions& options);

    // Returns whether any vertex moved.
    bool sweep();
    std::vector<Vec3> take_points() { return std::move(points_); }

 private:
    std::span<const std::int32_t> star(std::int32_t v) const { return corners_[v]; }  // as corners: 3 facet + place
    std::int32_t successor(std::int32_t corner) const { return facets_[corner / 3][(corner % 3 + 1) % 3]; }
    void add_sample(const Vec3& point, std::int32_t facet);

    bool move(std::int32_t v);
    void take_feet(std::int32_t v);
    void give_feet_back();
    Foot find_foot(std::int32_t sample, std::int32_t facet) const;
    void improve_feet(std::int32_t v, std::vector<Foot>& feet) const;
    Vec3 find_step(std::int32_t v) const;
    bool shorten_step(std::int32_t v, const Vec3& step);
    double star_energy(std::int32_t v, const std::vector<Foot>& feet) const;
    double star_cosine(std::int32_t v) const;
    bool keeps_normals(std::int32_t v) const;
    bool keeps_near(std::int32_t v) const;

    const std::vector<Vec3>& original_;
    const std::vector<Triangle>& facets_;
    OptimisationOptions options_;
    double turn_cosine_;
    std::vector<Vec3> points_;
    std::vector<Vec3> normals_;  // of the original facets
    Rows corners_;               // by vertex
    std::vector<double> size_;   // mean original length of the edges at a vertex
    std::vector<char> is_fixed_, is_awake_;
    std::vector<Vec3> samples_;
    std::vector<std::int32_t> first_sample_, next_sample_;  // lists by facet; -1 ends a list
    std::vector<Foot> feet_, tried_feet_;                   // of the vertex that is being moved
};

NodeOptimiser::NodeOptimiser(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                             const std::vector<std::int32_t>& patch, std::vector<char> fixed,
                             const OptimisationOptions& options)
    : original_(vertices),
      facets_(facets),
      options_(options),
      turn_cosine_(cosine_of_deg(options.max_turn_deg)),
      points_(vertices),
      normals_(unit_normals(vertices, facets)),
      corners_(vertices.size(), corner_vertices(facets)),
      size_(mean_edge_lengths(vertices, facets)),
      is_fixed_(std::move(fixed)),
      first_sample_(facets.size(), -1) {
    is_fixed_.resize(vertices.size(), 0);
    mark_features(facets, normals_, patch, cosine_of_deg(options.feature_angle_deg), is_fixed_);
    for (std::int32_t v = 0; v < count_of(vertices); ++v) {
        const auto corners = star(v);
        if (!corners.empty()) add_sample(vertices[v], corners.front() / 3);
        is_awake_.push_back(!corners.empty() && !is_fixed_[v]);
    }
    for (std::int32_t f = 0; f < count_of(facets); ++f) {
        const Triangle& t = facets[f];
        add_sample((vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3, f);
    }
}

void NodeOptimiser::add_sample(const Vec3& point, std::int32_t facet) {
    next_sample_.push_back(first_sample_[facet]);
    first_sample_[facet] = count_of(samples_);
    samples_.push_back(point);
}

bool NodeOptimiser::sweep() {
    bool any_moved = false;
    for (std::int32_t v = 0; v < count_of(points_); ++v) {
        if (!is_awake_[v]) continue;
        is_awake_[v] = move(v);
        if (!is_awake_[v]) continue;
        any_moved = true;
        for (std::int32_t corner : star(v)) is_awake_[successor(corner)] = !is_fixed_[successor(corner)];
    }
    return any_moved;
}

bool NodeOptimiser::move(std::int32_t v) {
    take_feet(v);
    improve_feet(v, feet_);
    const Vec3 step = find_step(v);
    const bool moved = step.norm() > least_step_rel * size_[v] && shorten_step(v, step);
    give_feet_back();
    return moved;
}

void NodeOptimiser::take_feet(std::int32_t v) {
    feet_.clear();
    for (std::int32_t corner : star(v)) {
        std::int32_t& first = first_sample_[corner / 3];
        for (; first >= 0; first = next_sample_[first]) feet_.push_back(find_foot(first, corner / 3));
    }
}

void NodeOptimiser::give_feet_back() {
    for (const Foot& foot : feet_) {
        next_sample_[foot.sample] = first_sample_[foot.facet];
        first_sample_[foot.facet] = foot.sample;
    }
}

Foot NodeOptimiser::find_foot(std::int32_t sample, std::int32_t facet) const {
    const Vec3 &a = points_[facets_[facet][0]], &b = points_[facets_[facet][1]], &c = points_[facets_[facet][2]];
    const Vec3 t = closest_barycentric(samples_[sample], a, b, c);
    return {sample, facet, t, (samples_[sample] - t[0] * a - t[1] * b - t[2] * c).squaredNorm()};
}

// Feet on the border of a facet go to the closest facet of the star.
void NodeOptimiser::improve_feet(std::int32_t v, std::vector<Foot>& feet) const {
    for (Foot& foot : feet)
        for (std::int32_t corner : star(v)) {
            if (foot.is_inside()) break;
            const Foot other = find_foot(foot.sample, corner / 3);
            if (other.distance_sq < foot.distance_sq) foot = other;
        }
}

Vec3 NodeOptimiser::find_step(std::int32_t v) const {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    for (std::int32_t corner : star(v)) {
        matrix.diagonal().array() += options_.spring;
        right += options_.spring * (points_[successor(corner)] - points_[v]);
    }
    for (const Foot& foot : feet_) {
        const Triangle& t = facets_[foot.facet];
        const Vec3 n = unit_normal(points_, t);
        const double b = foot.barycentric[std::find(t.begin(), t.end(), v) - t.begin()];
        matrix += b * b * n * n.transpose();
        right += b * n.dot(samples_[foot.sample] - points_[v]) * n;
    }
    return matrix.llt().solve(right);
}

// Moves v by the longest part of the step that lowers the energy within the guards; it stays if there is none.
bool NodeOptimiser::shorten_step(std::int32_t v, const Vec3& step) {
    const Vec3 from = points_[v];
    const double energy = star_energy(v, feet_), cosine = star_cosine(v);
    for (double length : step_lengths) {
        points_[v] = from + length * step;
        if (!(star_cosine(v) <= cosine) || !keeps_normals(v) || !keeps_near(v)) continue;
        tried_feet_.clear();
        for (const Foot& foot : feet_) tried_feet_.push_back(find_foot(foot.sample, foot.facet));
        improve_feet(v, tried_feet_);
        if (!(star_energy(v, tried_feet_) < energy)) continue;
        feet_.swap(tried_feet_);
        return true;
    }
    points_[v] = from;
    return false;
}

// The part of the energy that depends on v.
double NodeOptimiser::star_energy(std::int32_t v, const std::vector<Foot>& feet) const {
    double distance = 0, spring = 0;
    for (std::int32_t corner : star(v)) spring += (points_[successor(corner)] - points_[v]).squaredNorm();
    for (const Foot& foot : feet) distance += foot.distance_sq;
    return distance + options_.spring * spring;
}

double NodeOptimiser::star_cosine(std::int32_t v) const {
    double largest = -1;
    for (std::int32_t corner : star(v)) largest = std::max(largest, largest_cosine(points_, facets_[corner / 3]));
    return largest;
}

bool NodeOptimiser::keeps_normals(std::int32_t v) const {
    return std::all_of(star(v).begin(), star(v).end(), [&](std::int32_t corner) {
        return unit_normal(points_, facets_[corner / 3]).dot(normals_[corner / 3]) >= turn_cosine_;
    });
}

// Whether v is near the original facets around v or its neighbours; a vertex hardly goes further, and is refused there.
bool NodeOptimiser::keeps_near(std::int32_t v) const {
    const double tolerance = options_.tolerance_rel * size_[v];
    const auto is_near = [&](std::int32_t corner) {
        const Triangle& t = facets_[corner / 3];
        return point_triangle_distance(points_[v], original_[t[0]], original_[t[1]], original_[t[2]]) <= tolerance;
    };
    const auto has_near = [&](std::int32_t vertex) {
        return std::any_of(star(vertex).begin(), star(vertex).end(), is_near);
    };
    return has_near(v) || std::any_of(star(v).begin(), star(v).end(),
                                      [&](std::int32_t corner) { return has_near(successor(corner)); });
}

}  // namespace

std::vector<Vec3> optimise_nodes(const std::vector<Vec3>& vertices, const std::vector<Triangle>& facets,
                                 const std::vector<std::int32_t>& patch, const std::vector<char>& fixed,
                                 const OptimisationOptions& options) {
    KERF_CHECK(are_in_range(facets, vertices.size()) && have_distinct_corners(facets));
    KERF_CHECK(patch.size() == facets.size() && (fixed.empty() || fixed.size() == vertices.size()));
    KERF_CHECK(options.spring > 0);
    NodeOptimiser optimiser(vertices, facets, patch, fixed, options);
    for (int i = 0; i < options.sweeps && optimiser.sweep(); ++i) {
    }
    return optimiser.take_points();
}

}  // namespace kerf

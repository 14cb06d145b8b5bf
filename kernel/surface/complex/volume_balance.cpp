// Chords of a convex face lie inside of it, so that facets enclose too little. Each vertex v has a wanted move m_v,
// which lifts its facets by the mean height (`rise`) of their faces over them: the damped least-squares solution of one
// equation for each curved face at v, within all planar faces at v. The vertices go to start_v + s_v m_v. The scales
// s_v begin at 1 and are corrected by at most `secant_steps` steps: the derivatives of the volumes by the scales
// (`gain`, an entry for each vertex and region) are computed anew, and of all changes of the scales that make up for
// the missing volumes the smallest one, weighted by the gains, is found by conjugate gradients on one multiplier for
// each region. If facets have turned too far, the moves of their corners are set to 0, and the balance begins again.
#include "surface/complex/volume_balance.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/core/ids.h"
#include "base/geometry/triangle.h"

namespace kerf {

namespace {

// Faces that are tangent at their common edge ask for the same move twice, and planes may forbid most of it: this keeps
// it from becoming long.
constexpr double damping = 0.1;
constexpr double least_independence = 1e-9;  // of the normal of a plane from those of others
// Moves of a sagitta turn facets by a few degrees; but needles across them stand up, and become creases.
constexpr double least_turn_cosine = 0.985;
constexpr double least_gain = 1e-14;  // of the volume of a region by a vertex: less is rounding

struct FaceCorner {
    std::int32_t vertex, patch, facet;
};

std::vector<FaceCorner> corners_by_face(const FacetsOfFaces& mesh) {
    std::vector<FaceCorner> corners;
    corners.reserve(3 * mesh.facets.size());
    for (std::int32_t f = 0; f < count_of(mesh.facets); ++f)
        for (const std::int32_t v : mesh.facets[f]) corners.push_back({v, mesh.patch[f], f});
    std::sort(corners.begin(), corners.end(), [](const FaceCorner& a, const FaceCorner& b) {
        return std::tie(a.vertex, a.patch, a.facet) < std::tie(b.vertex, b.patch, b.facet);
    });
    return corners;
}

// The move of a vertex that fits the faces around it.
class MoveOfFaces {
 public:
    void stay_in_plane(const Vec3& normal) {
        const Vec3 rest = allowed_ * normal;
        if (rest.norm() < least_independence) return;
        const Vec3 direction = rest.normalized();
        allowed_ -= direction * direction.transpose();
    }
    void rise(const Vec3& normal, double height) {
        matrix_ += normal * normal.transpose();
        wanted_ += height * normal;
    }
    Vec3 best() const {
        const Eigen::Matrix3d matrix = allowed_ * matrix_ * allowed_ + damping * Eigen::Matrix3d::Identity();
        return allowed_ * matrix.inverse() * allowed_ * wanted_;
    }

 private:
    Eigen::Matrix3d allowed_ = Eigen::Matrix3d::Identity(), matrix_ = Eigen::Matrix3d::Zero();
    Vec3 wanted_ = Vec3::Zero();
};

// The volumes of the regions, as sums of tetrahedra between their facets and a vertex: their derivatives by the moves
// of vertices are sums over facets. A vertex has few regions, so the matrix of derivatives is kept by its entries.
class RegionVolumes {
 public:
    RegionVolumes(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const std::vector<Vec3>& moves,
                  const Array<RegionIndex, double>& volumes)
        : regions_(volumes.size()), weight_(moves.size()) {
        std::vector<Entry> entries;
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const Vec3 lifted = area_vector(vertices, mesh.facets[f]) / 3;
            for (const std::int32_t v : mesh.facets[f]) {
                const double gain = lifted.dot(moves[v]);
                if (gain == 0) continue;
                const FacetSides sides = mesh.sides_of(f);
                if (sides.back.is_valid()) entries.push_back({v, sides.back, gain});
                if (sides.front.is_valid()) entries.push_back({v, sides.front, -gain});
            }
        }
        std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return std::tie(a.vertex, a.region) < std::tie(b.vertex, b.region);
        });
        for (const Entry& e : entries)
            if (!entries_.empty() && entries_.back().vertex == e.vertex && entries_.back().region == e.region)
                entries_.back().gain += e.gain;
            else
                entries_.push_back(e);
        std::erase_if(entries_, [&](const Entry& e) { return std::abs(e.gain) < least_gain * volumes[e.region]; });
        for (const Entry& e : entries_) weight_[e.vertex] += std::abs(e.gain);
    }

    /// Returns the smallest changes of the scales of vertices, weighted by the volume that each changes, that give the
    /// regions their missing volumes. Found by conjugate gradients, since there are as many ways as there are walls
    /// that two regions could use.
    Eigen::VectorXd scales_for(const Eigen::VectorXd& missing) const {
        Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(missing.size()), residual = missing, direction = residual;
        double square = residual.squaredNorm();
        const double enough = 1e-20 * square;
        for (std::size_t i = 0; i < 2 * regions_ + balance_limits::most_rounds && square > enough; ++i) {
            const Eigen::VectorXd image = gains_of(scales_of(direction));
            const double curvature = direction.dot(image);
            if (!(curvature > 0)) break;
            multipliers += square / curvature * direction;
            residual -= square / curvature * image;
            const double next = residual.squaredNorm();
            direction = residual + next / square * direction;
            square = next;
        }
        return scales_of(multipliers);
    }

 private:
    struct Entry {
        std::int32_t vertex;
        RegionIndex region;
        double gain;  // of volume by the whole move
    };
    Eigen::VectorXd scales_of(const Eigen::VectorXd& of_regions) const {
        Eigen::VectorXd scales = Eigen::VectorXd::Zero(weight_.size());
        for (const Entry& e : entries_)
            if (weight_[e.vertex] > 0) scales[e.vertex] += e.gain / weight_[e.vertex] * of_regions[e.region.value()];
        return scales;
    }
    Eigen::VectorXd gains_of(const Eigen::VectorXd& scales) const {
        Eigen::VectorXd gains = Eigen::VectorXd::Zero(regions_);
        for (const Entry& e : entries_) gains[e.region.value()] += e.gain * scales[e.vertex];
        return gains;
    }

    std::size_t regions_;
    std::vector<Entry> entries_;
    std::vector<double> weight_;
};

// Moves the vertices from `start` by multiples of `moves` such that the regions have their volumes. False if they do
// not.
bool move_to_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const std::vector<Vec3>& start,
                     const std::vector<Vec3>& moves, const Array<RegionIndex, double>& volumes,
                     const ScaleRange& range) {
    Eigen::VectorXd scales = Eigen::VectorXd::Ones(moves.size());
    for (int step = 0; step <= balance_limits::secant_steps; ++step) {
        for (std::size_t v = 0; v < moves.size(); ++v) vertices[v] = start[v] + scales[v] * moves[v];
        const Array<RegionIndex, double> now = region_volumes(vertices, mesh, volumes.size());
        Eigen::VectorXd missing(volumes.size());
        bool is_right = true;
        for (const RegionIndex r : volumes.ids()) {
            const bool is_off = std::abs(volumes[r] - now[r]) > balance_limits::precision * volumes[r];
            missing[r.value()] = is_off ? volumes[r] - now[r] : 0;
            is_right = is_right && !is_off;
        }
        if (is_right) return scales.minCoeff() >= range.least && scales.maxCoeff() <= range.most;
        scales += RegionVolumes(vertices, mesh, moves, volumes).scales_for(missing);
    }
    return false;
}

}  // namespace

std::vector<Vec3> area_vectors(const std::vector<Vec3>& vertices, std::span<const Triangle> facets) {
    std::vector<Vec3> vectors;
    for (const Triangle& t : facets) vectors.push_back(area_vector(vertices, t));
    return vectors;
}

std::vector<Vec3> moves_to_faces(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh) {
    std::vector<Vec3> moves(vertices.size(), Vec3::Zero());
    const std::vector<FaceCorner> corners = corners_by_face(mesh);
    for (auto first = corners.begin(); first != corners.end();) {
        const std::int32_t vertex = first->vertex;
        MoveOfFaces move;
        while (first != corners.end() && first->vertex == vertex) {
            const std::int32_t patch = first->patch;
            const Vec3 plane = mesh.plane[first->facet];
            Vec3 normal = Vec3::Zero();
            double missed = 0, area = 0;
            for (; first != corners.end() && first->vertex == vertex && first->patch == patch; ++first) {
                const Vec3 of_facet = area_vector(vertices, mesh.facets[first->facet]);
                normal += of_facet;
                area += of_facet.norm();
                missed += of_facet.norm() * mesh.rise[first->facet];
            }
            if (plane != Vec3::Zero())
                move.stay_in_plane(plane);
            else if (area > 0 && normal.norm() > 0)
                move.rise(normal.normalized(), missed / area);
        }
        moves[vertex] = move.best();
    }
    return moves;
}

bool keep_turned(const std::vector<Vec3>& vertices, std::span<const Triangle> facets, const std::vector<Vec3>& normals,
                 std::vector<Vec3>& moves) {
    bool any = false;
    for (std::size_t f = 0; f < normals.size(); ++f) {
        const Vec3 now = area_vector(vertices, facets[f]);
        if (normals[f].dot(now) >= least_turn_cosine * now.norm() * normals[f].norm()) continue;
        for (const std::int32_t v : facets[f]) {
            any = any || moves[v] != Vec3::Zero();
            moves[v].setZero();
        }
    }
    return any;
}

Array<RegionIndex, double> region_volumes(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh,
                                          std::size_t regions) {
    Array<RegionIndex, double> volumes(regions);
    if (vertices.empty()) return volumes;
    const Vec3& apex = vertices.front();
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const auto& [a, b, c] = mesh.facets[f];
        const double volume = (vertices[a] - apex).dot((vertices[b] - apex).cross(vertices[c] - apex)) / 6;
        const FacetSides sides = mesh.sides_of(f);
        if (sides.back.is_valid()) volumes[sides.back] += volume;
        if (sides.front.is_valid()) volumes[sides.front] -= volume;
    }
    return volumes;
}

bool balance_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const Array<RegionIndex, double>& volumes,
                     const std::vector<char>& is_fixed, const ScaleRange& range) {
    std::vector<Vec3> moves = moves_to_faces(vertices, mesh);
    for (std::size_t v = 0; v < moves.size(); ++v)
        if (is_fixed[v]) moves[v].setZero();
    const std::vector<Vec3> start = vertices, normals = area_vectors(vertices, mesh.facets);
    for (int round = 0; round < balance_limits::most_rounds; ++round) {
        const bool is_right = move_to_volumes(vertices, mesh, start, moves, volumes, range);
        if (keep_turned(vertices, mesh.facets, normals, moves)) continue;
        if (is_right) return true;
        break;
    }
    vertices = start;
    return false;
}

}  // namespace kerf

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
#include <numeric>
#include <tuple>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "base/core/ids.h"
#include "base/core/threads.h"
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

// Calls work(i) for each i below `count`, on threads; sums are made afterwards, in their order.
template <class Work>
void for_each_item_on_threads(std::size_t count, const Work& work) {
    constexpr std::size_t grain = 1 << 14;
    for_ranges_on_threads(count, grain, [&](const IndexRange& range) {
        for (std::size_t i = range.first; i < range.last; ++i) work(i);
    });
}

// The facets around each vertex, ascending.
class FacetsOfVertices {
 public:
    FacetsOfVertices(std::span<const Triangle> facets, std::size_t vertices) : first_(vertices + 1, 0) {
        for (const Triangle& t : facets)
            for (const std::int32_t v : t) ++first_[v + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        facet_.resize(first_.back());
        for (std::int32_t f = 0; f < count_of(facets); ++f)
            for (const std::int32_t v : facets[f]) facet_[next[v]++] = f;
    }
    std::size_t vertices() const { return first_.size() - 1; }
    std::span<const std::int32_t> at(std::size_t v) const {
        return std::span(facet_).subspan(first_[v], first_[v + 1] - first_[v]);
    }

 private:
    std::vector<std::size_t> first_;
    std::vector<std::int32_t> facet_;
};

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
    RegionVolumes(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const FacetsOfVertices& around,
                  const std::vector<Vec3>& moves, const Array<RegionIndex, double>& volumes)
        : regions_(volumes.size()), weight_(moves.size()) {
        constexpr std::size_t grain = 1 << 13;
        const auto ranges = values_of_ranges(moves.size(), grain, [&](const IndexRange& range) {
            std::vector<Entry> entries;
            for (std::size_t v = range.first; v < range.last; ++v) {
                const std::size_t first = entries.size();
                for (const std::int32_t f : around.at(v)) {
                    const double gain = (area_vector(vertices, mesh.facets[f]) / 3).dot(moves[v]);
                    if (gain == 0) continue;
                    const FacetSides sides = mesh.sides_of(f);
                    if (sides.back.is_valid()) add(entries, first, {static_cast<std::int32_t>(v), sides.back, gain});
                    if (sides.front.is_valid()) add(entries, first, {static_cast<std::int32_t>(v), sides.front, -gain});
                }
                std::sort(entries.begin() + first, entries.end(),
                          [](const Entry& a, const Entry& b) { return a.region < b.region; });
            }
            std::erase_if(entries, [&](const Entry& e) { return std::abs(e.gain) < least_gain * volumes[e.region]; });
            return entries;
        });
        for (const std::vector<Entry>& entries : ranges)
            entries_.insert(entries_.end(), entries.begin(), entries.end());
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
    // Adds to the entry of the same region among those from `first` on, of one vertex, or makes one.
    static void add(std::vector<Entry>& entries, std::size_t first, const Entry& entry) {
        const auto same = std::find_if(entries.begin() + first, entries.end(),
                                       [&](const Entry& e) { return e.region == entry.region; });
        if (same == entries.end())
            entries.push_back(entry);
        else
            same->gain += entry.gain;
    }
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
bool move_to_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const FacetsOfVertices& around,
                     const std::vector<Vec3>& start, const std::vector<Vec3>& moves,
                     const Array<RegionIndex, double>& volumes, const ScaleRange& range) {
    Eigen::VectorXd scales = Eigen::VectorXd::Ones(moves.size());
    for (int step = 0; step <= balance_limits::secant_steps; ++step) {
        for_each_item_on_threads(moves.size(), [&](std::size_t v) { vertices[v] = start[v] + scales[v] * moves[v]; });
        const Array<RegionIndex, double> now = region_volumes(vertices, mesh, volumes.size());
        Eigen::VectorXd missing(volumes.size());
        bool is_right = true;
        for (const RegionIndex r : volumes.ids()) {
            const bool is_off = std::abs(volumes[r] - now[r]) > balance_limits::precision * volumes[r];
            missing[r.value()] = is_off ? volumes[r] - now[r] : 0;
            is_right = is_right && !is_off;
        }
        if (is_right) return scales.minCoeff() >= range.least && scales.maxCoeff() <= range.most;
        scales += RegionVolumes(vertices, mesh, around, moves, volumes).scales_for(missing);
    }
    return false;
}

}  // namespace

std::vector<Vec3> area_vectors(const std::vector<Vec3>& vertices, std::span<const Triangle> facets) {
    std::vector<Vec3> vectors(facets.size());
    for_each_item_on_threads(facets.size(), [&](std::size_t f) { vectors[f] = area_vector(vertices, facets[f]); });
    return vectors;
}

namespace {

Vec3 move_to_faces(std::span<const std::int32_t> facets, const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh) {
    std::vector<std::int32_t> by_face(facets.begin(), facets.end());
    std::stable_sort(by_face.begin(), by_face.end(),
                     [&](std::int32_t f, std::int32_t g) { return mesh.patch[f] < mesh.patch[g]; });
    MoveOfFaces move;
    for (std::size_t i = 0; i < by_face.size();) {
        const std::int32_t patch = mesh.patch[by_face[i]];
        const Vec3& plane = mesh.plane[by_face[i]];
        Vec3 normal = Vec3::Zero();
        double missed = 0, area = 0;
        for (; i < by_face.size() && mesh.patch[by_face[i]] == patch; ++i) {
            const Vec3 of_facet = area_vector(vertices, mesh.facets[by_face[i]]);
            normal += of_facet;
            area += of_facet.norm();
            missed += of_facet.norm() * mesh.rise[by_face[i]];
        }
        if (plane != Vec3::Zero())
            move.stay_in_plane(plane);
        else if (area > 0 && normal.norm() > 0)
            move.rise(normal.normalized(), missed / area);
    }
    return move.best();
}

std::vector<Vec3> moves_around(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh,
                               const FacetsOfVertices& around) {
    std::vector<Vec3> moves(vertices.size(), Vec3::Zero());
    for_each_item_on_threads(moves.size(), [&](std::size_t v) {
        if (!around.at(v).empty()) moves[v] = move_to_faces(around.at(v), vertices, mesh);
    });
    return moves;
}

}  // namespace

std::vector<Vec3> moves_to_faces(const std::vector<Vec3>& vertices, const FacetsOfFaces& mesh) {
    return moves_around(vertices, mesh, FacetsOfVertices(mesh.facets, vertices.size()));
}

bool keep_turned(const std::vector<Vec3>& vertices, std::span<const Triangle> facets, const std::vector<Vec3>& normals,
                 std::vector<Vec3>& moves) {
    std::vector<char> has_turned(normals.size());
    for_each_item_on_threads(normals.size(), [&](std::size_t f) {
        const Vec3 now = area_vector(vertices, facets[f]);
        has_turned[f] = normals[f].dot(now) >= least_turn_cosine * now.norm() * normals[f].norm() ? 0 : 1;
    });
    bool any = false;
    for (std::size_t f = 0; f < normals.size(); ++f) {
        if (has_turned[f] == 0) continue;
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
    std::vector<double> of_facet(mesh.facets.size());
    for_each_item_on_threads(of_facet.size(), [&](std::size_t f) {
        const auto& [a, b, c] = mesh.facets[f];
        of_facet[f] = (vertices[a] - apex).dot((vertices[b] - apex).cross(vertices[c] - apex)) / 6;
    });
    for (std::size_t f = 0; f < of_facet.size(); ++f) {
        const FacetSides sides = mesh.sides_of(f);
        if (sides.back.is_valid()) volumes[sides.back] += of_facet[f];
        if (sides.front.is_valid()) volumes[sides.front] -= of_facet[f];
    }
    return volumes;
}

bool balance_volumes(std::vector<Vec3>& vertices, const FacetsOfFaces& mesh, const Array<RegionIndex, double>& volumes,
                     const std::vector<char>& is_fixed, const ScaleRange& range) {
    const FacetsOfVertices around(mesh.facets, vertices.size());
    std::vector<Vec3> moves = moves_around(vertices, mesh, around);
    for (std::size_t v = 0; v < moves.size(); ++v)
        if (is_fixed[v]) moves[v].setZero();
    const std::vector<Vec3> start = vertices, normals = area_vectors(vertices, mesh.facets);
    for (int round = 0; round < balance_limits::most_rounds; ++round) {
        const bool is_right = move_to_volumes(vertices, mesh, around, start, moves, volumes, range);
        if (keep_turned(vertices, mesh.facets, normals, moves)) continue;
        if (is_right) return true;
        break;
    }
    vertices = start;
    return false;
}

}  // namespace kerf

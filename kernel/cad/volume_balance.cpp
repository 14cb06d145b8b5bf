#include "cad/volume_balance.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "geometry/triangle.h"

namespace kerf::cad {

namespace {

// Faces that are tangent at their common edge ask for the same move twice, and planes may forbid most of it: this keeps
// it from becoming long.
constexpr double damping = 0.1;
constexpr double least_independence = 1e-9;  // of the normal of a plane from those of others
// Of the moves that the facets ask for: what is far from 1 has other causes than chords.
constexpr double least_scale = 0.4, most_scale = 2.5;
constexpr int secant_steps = 3;
// Moves of a sagitta turn facets by a few degrees; but needles across them stand up, and become creases.
constexpr double least_turn_cosine = 0.985;
constexpr int most_rounds = 12;
constexpr double precision = 1e-7;    // of the volume
constexpr double least_gain = 1e-14;  // of the volume of a region by a vertex: less is rounding

struct Corner {
    std::int32_t vertex, patch, facet;
};

std::vector<Corner> sorted_corners(const Tessellation& mesh) {
    std::vector<Corner> corners;
    corners.reserve(3 * mesh.facets.size());
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        for (const std::int32_t v : mesh.facets[f]) corners.push_back({v, mesh.patch[f], static_cast<std::int32_t>(f)});
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
        return std::tie(a.vertex, a.patch, a.facet) < std::tie(b.vertex, b.patch, b.facet);
    });
    return corners;
}

Vec3 area_vector(const Tessellation& mesh, std::int32_t facet) {
    return kerf::area_vector(mesh.vertices, mesh.facets[facet]);
}

// What the faces around a vertex ask of it.
class Move {
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

std::vector<Vec3> find_moves(const Tessellation& mesh) {
    std::vector<Vec3> moves(mesh.vertices.size(), Vec3::Zero());
    const std::vector<Corner> corners = sorted_corners(mesh);
    for (auto first = corners.begin(); first != corners.end();) {
        const std::int32_t vertex = first->vertex;
        Move move;
        while (first != corners.end() && first->vertex == vertex) {
            const std::int32_t patch = first->patch;
            const Vec3 plane = mesh.plane[first->facet];
            Vec3 normal = Vec3::Zero();
            double missed = 0, area = 0;
            for (; first != corners.end() && first->vertex == vertex && first->patch == patch; ++first) {
                const Vec3 of_facet = area_vector(mesh, first->facet);
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

// Moves `mesh` by a multiple of `moves` from `start` such that it holds `volume`. False if it does not.
bool move_to_volume(Tessellation& mesh, const std::vector<Vec3>& start, const std::vector<Vec3>& moves, double volume) {
    const auto volume_at = [&](double scale) {
        for (std::size_t v = 0; v < moves.size(); ++v) mesh.vertices[v] = start[v] + scale * moves[v];
        return enclosed_volume(mesh);
    };
    double last = 0, last_volume = mesh.volume, scale = 1, now = volume_at(scale);
    for (int step = 0; step < secant_steps && now != last_volume; ++step) {
        const double next = scale + (volume - now) * (scale - last) / (now - last_volume);
        last = scale;
        last_volume = now;
        scale = std::clamp(next, 0.0, 2 * most_scale);
        now = volume_at(scale);
    }
    return scale >= least_scale && scale <= most_scale && std::abs(now - volume) <= precision * std::abs(volume);
}

// Takes the moves of facets that have turned. True if there are any.
bool keep_turned(const Tessellation& mesh, const std::vector<Vec3>& normals, std::vector<Vec3>& moves) {
    bool any = false;
    for (std::size_t f = 0; f < normals.size(); ++f) {
        const Vec3 now = area_vector(mesh, static_cast<std::int32_t>(f));
        if (normals[f].dot(now) >= least_turn_cosine * now.norm() * normals[f].norm()) continue;
        for (const std::int32_t v : mesh.facets[f]) {
            any = any || moves[v] != Vec3::Zero();
            moves[v].setZero();
        }
    }
    return any;
}

// Of the tetrahedra between the facets of each region and a vertex: their derivatives by the moves of vertices are
// sums over facets. A vertex has few regions, so that the matrix of derivatives is kept by its entries.
class RegionVolumes {
 public:
    RegionVolumes(const Tessellation& mesh, const std::vector<Vec3>& moves, const std::vector<double>& volumes)
        : regions_(volumes.size()), weight_(moves.size()) {
        std::vector<Entry> entries;
        for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
            const Vec3 lifted = area_vector(mesh, static_cast<std::int32_t>(f)) / 3;
            for (const std::int32_t v : mesh.facets[f]) {
                const double gain = lifted.dot(moves[v]);
                if (gain == 0) continue;
                if (mesh.sides[f].back >= 0) entries.push_back({v, mesh.sides[f].back, gain});
                if (mesh.sides[f].front >= 0) entries.push_back({v, mesh.sides[f].front, -gain});
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

    /// The smallest changes of the scales of vertices, weighted by what they change, that make up for what the regions
    /// miss: by conjugate gradients, since there are as many ways as there are walls that two regions could use.
    Eigen::VectorXd scales_for(const Eigen::VectorXd& missing) const {
        Eigen::VectorXd multipliers = Eigen::VectorXd::Zero(missing.size()), residual = missing, direction = residual;
        double square = residual.squaredNorm();
        const double enough = 1e-20 * square;
        for (std::size_t i = 0; i < 2 * regions_ + most_rounds && square > enough; ++i) {
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
        std::int32_t vertex, region;
        double gain;  // of volume by the whole move
    };
    Eigen::VectorXd scales_of(const Eigen::VectorXd& of_regions) const {
        Eigen::VectorXd scales = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(weight_.size()));
        for (const Entry& e : entries_)
            if (weight_[e.vertex] > 0) scales[e.vertex] += e.gain / weight_[e.vertex] * of_regions[e.region];
        return scales;
    }
    Eigen::VectorXd gains_of(const Eigen::VectorXd& scales) const {
        Eigen::VectorXd gains = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(regions_));
        for (const Entry& e : entries_) gains[e.region] += e.gain * scales[e.vertex];
        return gains;
    }

    std::size_t regions_;
    std::vector<Entry> entries_;
    std::vector<double> weight_;
};

// As move_to_volume(), with a scale for each vertex.
bool move_to_volumes(Tessellation& mesh, const std::vector<Vec3>& start, const std::vector<Vec3>& moves,
                     const std::vector<double>& volumes) {
    Eigen::VectorXd scales = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(moves.size()));
    for (int step = 0; step <= secant_steps; ++step) {
        for (std::size_t v = 0; v < moves.size(); ++v)
            mesh.vertices[v] = start[v] + scales[static_cast<Eigen::Index>(v)] * moves[v];
        const std::vector<double> now = region_volumes(mesh, volumes.size());
        Eigen::VectorXd missing(static_cast<Eigen::Index>(volumes.size()));
        bool is_right = true;
        for (std::size_t r = 0; r < volumes.size(); ++r) {
            const bool is_off = std::abs(volumes[r] - now[r]) > precision * volumes[r];
            missing[static_cast<Eigen::Index>(r)] = is_off ? volumes[r] - now[r] : 0;
            is_right = is_right && !is_off;
        }
        if (is_right) return scales.minCoeff() >= least_scale && scales.maxCoeff() <= most_scale;
        scales += RegionVolumes(mesh, moves, volumes).scales_for(missing);
    }
    return false;
}

}  // namespace

double volume_between(const Tessellation& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        sum += area_vector(mesh, static_cast<std::int32_t>(f)).norm() * std::abs(mesh.rise[f]);
    return sum;
}

bool balance_volume(Tessellation& mesh, double volume) {
    std::vector<Vec3> moves = find_moves(mesh), normals;
    const std::vector<Vec3> start = mesh.vertices;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        normals.push_back(area_vector(mesh, static_cast<std::int32_t>(f)));
    for (int round = 0; round < most_rounds; ++round) {
        const bool is_right = move_to_volume(mesh, start, moves, volume);
        if (keep_turned(mesh, normals, moves)) continue;
        if (!is_right) break;
        mesh.volume = enclosed_volume(mesh);
        return true;
    }
    mesh.vertices = start;
    return false;
}

std::vector<double> region_volumes(const Tessellation& mesh, std::size_t regions) {
    std::vector<double> volumes(regions);
    if (mesh.vertices.empty()) return volumes;
    const Vec3& apex = mesh.vertices.front();
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const auto& [a, b, c] = mesh.facets[f];
        const double volume =
            (mesh.vertices[a] - apex).dot((mesh.vertices[b] - apex).cross(mesh.vertices[c] - apex)) / 6;
        const FacetSides sides = mesh.sides[f];
        if (sides.back >= 0) volumes[static_cast<std::size_t>(sides.back)] += volume;
        if (sides.front >= 0) volumes[static_cast<std::size_t>(sides.front)] -= volume;
    }
    return volumes;
}

std::vector<double> volumes_between(const Tessellation& mesh, std::size_t regions) {
    std::vector<double> between(regions);
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const double volume = area_vector(mesh, static_cast<std::int32_t>(f)).norm() * std::abs(mesh.rise[f]);
        for (const std::int32_t region : {mesh.sides[f].front, mesh.sides[f].back})
            if (region >= 0) between[static_cast<std::size_t>(region)] += volume;
    }
    return between;
}

bool balance_volumes(Tessellation& mesh, const std::vector<double>& volumes, const std::vector<char>& is_fixed) {
    std::vector<Vec3> moves = find_moves(mesh), normals;
    for (std::size_t v = 0; v < moves.size(); ++v)
        if (is_fixed[v]) moves[v].setZero();
    const std::vector<Vec3> start = mesh.vertices;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
        normals.push_back(area_vector(mesh, static_cast<std::int32_t>(f)));
    for (int round = 0; round < most_rounds; ++round) {
        const bool is_right = move_to_volumes(mesh, start, moves, volumes);
        if (keep_turned(mesh, normals, moves)) continue;
        if (is_right) return true;
        break;
    }
    mesh.vertices = start;
    return false;
}

}  // namespace kerf::cad

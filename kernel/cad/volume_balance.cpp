#include "cad/volume_balance.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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
constexpr double precision = 1e-7;  // of the volume

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

}  // namespace kerf::cad

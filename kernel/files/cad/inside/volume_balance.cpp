#include "files/cad/inside/volume_balance.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/triangle.h"
#include "surface/complex/volume_balance.h"

namespace kerf::cad {

namespace {

Vec3 area_vector(const Tessellation& mesh, std::size_t facet) {
    return kerf::area_vector(mesh.vertices, mesh.facets[facet]);
}

FacetsOfFaces faces_of(const Tessellation& mesh) {
    return {mesh.facets, mesh.patch, mesh.plane, mesh.rise, mesh.sides};
}

// Moves `mesh` by a multiple of `moves` from `start` such that it holds `volume`. Returns false if it does not.
bool move_to_volume(Tessellation& mesh, const std::vector<Vec3>& start, const std::vector<Vec3>& moves, double volume) {
    const auto volume_at = [&](double scale) {
        for (std::size_t v = 0; v < moves.size(); ++v) mesh.vertices[v] = start[v] + scale * moves[v];
        return enclosed_volume(mesh);
    };
    double last = 0, last_volume = mesh.volume, scale = 1, now = volume_at(scale);
    for (int step = 0; step < balance_limits::secant_steps && now != last_volume; ++step) {
        const double next = scale + (volume - now) * (scale - last) / (now - last_volume);
        last = scale;
        last_volume = now;
        scale = std::clamp(next, 0.0, 2 * balance_limits::chords.most);
        now = volume_at(scale);
    }
    return scale >= balance_limits::chords.least && scale <= balance_limits::chords.most &&
           std::abs(now - volume) <= balance_limits::precision * std::abs(volume);
}

}  // namespace

double volume_between(const Tessellation& mesh) {
    double sum = 0;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) sum += area_vector(mesh, f).norm() * std::abs(mesh.rise[f]);
    return sum;
}

bool balance_volume(Tessellation& mesh, double volume) {
    std::vector<Vec3> moves = moves_to_faces(mesh.vertices, faces_of(mesh));
    const std::vector<Vec3> start = mesh.vertices, normals = area_vectors(start, mesh.facets);
    for (int round = 0; round < balance_limits::most_rounds; ++round) {
        const bool is_right = move_to_volume(mesh, start, moves, volume);
        if (keep_turned(mesh.vertices, mesh.facets, normals, moves)) continue;
        if (!is_right) break;
        mesh.volume = enclosed_volume(mesh);
        return true;
    }
    mesh.vertices = start;
    return false;
}

Array<RegionIndex, double> region_volumes(const Tessellation& mesh, std::size_t regions) {
    return kerf::region_volumes(mesh.vertices, faces_of(mesh), regions);
}

Array<RegionIndex, double> volumes_between(const Tessellation& mesh, std::size_t regions) {
    Array<RegionIndex, double> between(regions);
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const double volume = area_vector(mesh, f).norm() * std::abs(mesh.rise[f]);
        for (const RegionIndex region : {mesh.sides[f].front, mesh.sides[f].back})
            if (region.is_valid()) between[region] += volume;
    }
    return between;
}

bool balance_volumes(Tessellation& mesh, const Array<RegionIndex, double>& volumes, const std::vector<char>& is_fixed) {
    return kerf::balance_volumes(mesh.vertices, faces_of(mesh), volumes, is_fixed, balance_limits::chords);
}

}  // namespace kerf::cad

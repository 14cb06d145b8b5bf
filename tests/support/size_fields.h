// Size fields of every kind, and how well edges obey them.
#pragma once

#include <random>

#include "fill/mesh/tet_mesh.h"
#include "support/shapes.h"
#include "surface/size/size_options.h"

namespace kerf::test {

inline double uniform(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}
inline Vec3 random_point(std::mt19937& random, double reach) {
    return {uniform(random, -reach, reach), uniform(random, -reach, reach), uniform(random, -reach, reach)};
}

/// A box of n x n x n cubes of six tetrahedra each, with size(point) at the vertices.
template <class Size>
SizedMesh sized_grid(const Vec3& low, const Vec3& high, int n, const Size& size) {
    SizedMesh mesh;
    const auto at = [&](int i, int j, int k) { return static_cast<std::int32_t>((i * (n + 1) + j) * (n + 1) + k); };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= n; ++k) {
                mesh.vertices.push_back(low + Vec3(i, j, k).cwiseProduct(high - low) / n);
                mesh.size.push_back(size(mesh.vertices.back()));
            }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            for (int k = 0; k < n; ++k)
                for (const auto& order : {std::array{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}) {
                    std::array<int, 3> corner = {i, j, k};  // six ways along the edges from here to the far corner
                    Tetrahedron tet{at(i, j, k), 0, 0, 0};
                    for (std::size_t step = 0; step < 3; ++step) {
                        ++corner[static_cast<std::size_t>(order[step])];
                        tet[step + 1] = at(corner[0], corner[1], corner[2]);
                    }
                    mesh.tets.push_back(tet);
                }
    return mesh;
}

/// One field for each kind of source, random.
inline std::vector<SizeSources> random_sources(unsigned seed) {
    std::mt19937 random(seed);
    const double growth = uniform(random, 0.05, 1);
    std::vector<SizeSources> all(6);
    for (SizeSources& sources : all) sources.growth = growth;
    const auto size = [&] { return std::exp(uniform(random, -4, 1)); };
    for (int i = 0; i < 3; ++i) {
        const Vec3 a = random_point(random, 2), b = random_point(random, 2);
        all[0].boxes.push_back({a.cwiseMin(b), a.cwiseMax(b), size()});
        all[1].spheres.push_back({random_point(random, 2), uniform(random, 0.1, 1), size()});
        all[2].cylinders.push_back({random_point(random, 2), random_point(random, 2), uniform(random, 0.1, 1), size()});
    }
    std::vector<SizedTriangle> triangles, points;
    for (int i = 0; i < 40; ++i) {
        const Vec3 p = random_point(random, 2);
        const double h = size();
        triangles.emplace_back(p, p + random_point(random, 0.3), p + random_point(random, 0.3), std::array{h, h, h},
                               i % 3 == 0 ? 0.2 : 0.0);
        points.emplace_back(-p, -p, -p, std::array{h, h, h});
    }
    all[3].triangles = SizedTriangles(triangles);
    all[4].triangles = SizedTriangles(points);
    all[5].backgrounds.emplace_back(
        sized_grid(Vec3(-1, -1, -1), Vec3(1, 1.5, 1), 4, [&](const Vec3&) { return size(); }), growth);
    return all;
}

inline SizeSources joined(const std::vector<SizeSources>& all) {
    SizeSources sum;
    std::vector<SizedTriangle> triangles;
    for (const SizeSources& s : all) {
        sum.growth = s.growth;
        sum.boxes.insert(sum.boxes.end(), s.boxes.begin(), s.boxes.end());
        sum.spheres.insert(sum.spheres.end(), s.spheres.begin(), s.spheres.end());
        sum.cylinders.insert(sum.cylinders.end(), s.cylinders.begin(), s.cylinders.end());
        triangles.insert(triangles.end(), s.triangles.all().begin(), s.triangles.all().end());
        sum.backgrounds.insert(sum.backgrounds.end(), s.backgrounds.begin(), s.backgrounds.end());
    }
    sum.triangles = SizedTriangles(triangles);
    return sum;
}

}  // namespace kerf::test

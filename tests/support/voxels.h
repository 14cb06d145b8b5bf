// Bodies of unit cubes that may touch themselves.
#pragma once

#include <array>
#include <set>

#include "support/seeded_numbers.h"
#include "support/shapes.h"

namespace kerf::test {

/// Unit cubes by their lowest corners.
using Voxels = std::set<std::array<int, 3>>;

/// The boundary of the cubes, whose sides are divided into n x n squares: closed, each point one vertex, no manifold
/// where cubes touch at a corner or an edge alone.
inline Soup voxel_surface(const Voxels& voxels, int n = 1) {
    Soup soup;
    for (const auto& [i, j, k] : voxels) soup = join(std::move(soup), box(Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1), n));
    weld_exactly(soup);
    cancel_common_facets(soup);
    drop_unused_vertices(soup);
    soup.vertex_number.clear();
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"voxels"};
    return soup;
}

/// Each of edge^3 cubes with this chance; one at least.
inline Voxels random_voxels(int edge, double chance, SeededNumbers& random) {
    Voxels voxels;
    for (int i = 0; i < edge; ++i)
        for (int j = 0; j < edge; ++j)
            for (int k = 0; k < edge; ++k)
                if (random.with_chance(chance)) voxels.insert({i, j, k});
    if (voxels.empty()) voxels.insert({0, 0, 0});
    return voxels;
}

/// Two layers of 2 x 2 cubes, and two cubes at a diagonal between them: these touch along an edge whose ends have one
/// fan of facets each.
inline Voxels notched_voxels() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1},
            {1, 1, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}, {1, 1, 2}};
}

}  // namespace kerf::test

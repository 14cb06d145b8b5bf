#include <iostream>

#include "kerf/kerf.h"

int main() {
    const std::vector<std::array<double, 3>> vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                         {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    std::vector<std::array<std::int32_t, 3>> facets = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7},
                                                       {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5},
                                                       {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    const kerf::ClosedSurface cube = kerf::surface_from_arrays(vertices, facets);
    const kerf::MeshArrays mesh = kerf::mesh_to_arrays(cube, {.size = 0.2, .parts = 2});
    std::cout << mesh.tets.size() << " cells, volume " << cube.volume() << "\n";
    facets[7][2] = 99;
    try {
        kerf::surface_from_arrays(vertices, facets);
    } catch (const kerf::Error& error) {
        std::cout << "facet " << error.elements().front().ids.front() << ": " << error.what() << "\n";
    }
}

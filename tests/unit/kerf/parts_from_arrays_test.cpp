// A mesh in memory falls into the parts of which it was joined.
#include "kerf/inside/parts_from_arrays.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "files/part/solution_parts.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

using Corners = std::array<std::int64_t, 3>;

// Two cubes, one on the other.
ClosedSurface stacked_cubes() {
    std::vector<std::array<double, 3>> points;
    for (const double z : {0., 1., 2.})
        for (const auto& [x, y] : {std::pair(0., 0.), std::pair(1., 0.), std::pair(1., 1.), std::pair(0., 1.)})
            points.push_back({x, y, z});
    std::vector<std::array<std::int32_t, 3>> facets;
    std::vector<std::array<std::int32_t, 2>> sides;
    const auto add = [&](std::array<std::int32_t, 4> q, std::array<std::int32_t, 2> side) {
        facets.insert(facets.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
        sides.insert(sides.end(), {side, side});
    };
    add({0, 3, 2, 1}, {0, -1});
    add({4, 5, 6, 7}, {0, 1});
    add({8, 9, 10, 11}, {1, -1});
    for (std::int32_t i = 0; i < 4; ++i)
        for (const std::int32_t low : {0, 4})
            add({low + i, low + (i + 1) % 4, low + 4 + (i + 1) % 4, low + 4 + i}, {low / 4, -1});
    return surface_of_regions(points, facets, sides, {"low", "high"});
}

// The boundary triangles with all that is said of them, whatever corner comes first.
std::set<std::tuple<Corners, std::int32_t, NodeId, Corners>> boundary(const Part& part) {
    std::set<std::tuple<Corners, std::int32_t, NodeId, Corners>> all;
    for (std::size_t f = 0; f < part.facets.size(); ++f) {
        Corners c, behind;
        for (std::size_t i = 0; i < 3; ++i) c[i] = part.global_id[part.facets[f][i]];
        std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
        const Tetrahedron& tet = part.mesh.tets[part.tet_at_facet[f]];
        for (std::size_t i = 0; i < 3; ++i) behind[i] = part.global_id[tet[i]];
        all.insert({c, part.patch[f], part.neighbour[f], behind});
    }
    return all;
}

TEST(PartsFromArrays, AreThoseOfTheRun) {
    const test::TemporaryFolder folder;
    const std::string run = folder.file("run");
    mesh_to_folder(stacked_cubes(),
                   {.size = 0.4,
                    .parts = 5,
                    .workers = 1,
                    .programs = std::filesystem::path(test::worker_program()).parent_path().string()},
                   run);
    const MeshArrays arrays = arrays_of_run(run);
    const std::unique_ptr<PartSource> source = open_parts(run);
    std::size_t parts = 0;
    for_each_part_of(arrays, [&](const Part& part) {
        const Part wanted = source->load(source->outline().index_of(part.id));
        EXPECT_EQ(boundary(part), boundary(wanted));
        EXPECT_EQ(part.mesh.boundary_vertex_count, wanted.mesh.boundary_vertex_count);
        EXPECT_EQ(part.region_of(0), wanted.region_of(0));
        EXPECT_EQ(part.region_names, wanted.region_names);
        ASSERT_EQ(part.tet_count(), wanted.tet_count());
        for (std::size_t t = 0; t < part.mesh.tets.size(); ++t)
            for (std::size_t i = 0; i < 4; ++i) {
                const std::int32_t own = part.mesh.tets[t][i], other = wanted.mesh.tets[t][i];
                EXPECT_EQ(part.global_id[own], wanted.global_id[other]);
                EXPECT_EQ(part.mesh.vertices[own], wanted.mesh.vertices[other]);
            }
        ++parts;
    });
    EXPECT_EQ(parts, source->outline().parts.size());
}

}  // namespace
}  // namespace kerf

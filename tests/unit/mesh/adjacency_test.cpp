// connect_tets() against the definition.
#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "fill/mesh/adjacency.h"

namespace kerf {
namespace {

// Tetrahedra of any corners: many share a face with several others.
TetMesh random_tets(std::mt19937& random, int vertices, int count) {
    TetMesh mesh;
    mesh.vertices.assign(static_cast<std::size_t>(vertices), Vec3::Zero());
    std::vector<std::int32_t> numbers(static_cast<std::size_t>(vertices));
    for (std::size_t v = 0; v < numbers.size(); ++v) numbers[v] = static_cast<std::int32_t>(v);
    for (int t = 0; t < count; ++t) {
        std::shuffle(numbers.begin(), numbers.end(), random);
        mesh.tets.push_back({numbers[0], numbers[1], numbers[2], numbers[3]});
    }
    return mesh;
}

TetNeighbours neighbours_by_definition(const TetMesh& mesh) {
    struct Side {
        CellId tet;
        std::size_t corner;
    };
    std::map<Triangle, std::vector<Side>> sides;
    for (const CellId t : mesh.tets.ids())
        for (std::size_t i = 0; i < 4; ++i) {
            Triangle face = {};
            std::size_t corners = 0;
            for (std::size_t j = 0; j < 4; ++j)
                if (j != i) face[corners++] = mesh.tets[t][j];
            std::sort(face.begin(), face.end());
            sides[face].push_back({t, i});
        }
    constexpr CellId none = CellId::none();
    TetNeighbours neighbours(mesh.tets.size(), {none, none, none, none});
    for (const auto& [face, at] : sides) {
        if (at.size() < 2) continue;
        neighbours[at[0].tet][at[0].corner] = at[1].tet;
        neighbours[at[1].tet][at[1].corner] = at[0].tet;
    }
    return neighbours;
}

TEST(Adjacency, TheFirstTwoTetrahedraOfAFaceAreNeighbours) {
    std::mt19937 random(5);
    for (const int vertices : {4, 5, 8, 20, 100})
        for (const int count : {0, 1, 2, 30, 300}) {
            TetMesh mesh = random_tets(random, vertices, count);
            connect_tets(mesh);
            EXPECT_EQ(mesh.neighbours, neighbours_by_definition(mesh)) << vertices << " vertices, " << count;
        }
}

}  // namespace
}  // namespace kerf

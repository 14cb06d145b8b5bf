// What holds of every mesh of OpenFOAM.
#pragma once

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "export/openfoam_reader.h"

namespace kerf::test::openfoam {

inline void expect_four_faces(const PolyMesh& mesh) {
    std::vector<std::multiset<std::int32_t>> corners(mesh.cells());
    const auto add = [&](std::int32_t cell, std::size_t f) {
        corners.at(static_cast<std::size_t>(cell)).insert(mesh.faces[f].begin(), mesh.faces[f].end());
    };
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) add(mesh.owner[f], f);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) add(mesh.neighbour[f], f);
    for (const auto& cell : corners) {
        EXPECT_EQ(cell.size(), 12);
        for (const std::int32_t v : cell) EXPECT_EQ(cell.count(v), 3);
    }
}

inline void expect_upper_triangular(const PolyMesh& mesh) {
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) {
        EXPECT_LT(mesh.owner[f], mesh.neighbour[f]);
        if (f == 0) continue;
        EXPECT_LT(std::pair(mesh.owner[f - 1], mesh.neighbour[f - 1]), std::pair(mesh.owner[f], mesh.neighbour[f]));
    }
}

inline void expect_normals_out_of_owner(const PolyMesh& mesh) {
    std::vector<Vec3> centres(mesh.cells(), Vec3::Zero());
    const auto add = [&](std::int32_t cell, std::size_t f) {
        centres[static_cast<std::size_t>(cell)] += mesh.centre(f) / 4;
    };
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) add(mesh.owner[f], f);
    for (std::size_t f = 0; f < mesh.neighbour.size(); ++f) add(mesh.neighbour[f], f);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Vec3& from = centres[static_cast<std::size_t>(mesh.owner[f])];
        EXPECT_GT(mesh.area(f).dot(mesh.centre(f) - from), 0);
        if (f >= mesh.neighbour.size()) continue;
        const Vec3& to = centres[static_cast<std::size_t>(mesh.neighbour[f])];
        EXPECT_GT(mesh.area(f).dot(to - mesh.centre(f)), 0);
    }
}

inline void expect_patches_follow_each_other(const PolyMesh& mesh) {
    std::size_t start = mesh.neighbour.size();
    for (const Patch& patch : mesh.patches) {
        EXPECT_EQ(patch.start, start) << patch.name;
        start += patch.faces;
    }
    EXPECT_EQ(start, mesh.faces.size());
}

/// How many pairs of processor patches there are.
inline std::size_t expect_both_sides_agree(const std::vector<PolyMesh>& meshes) {
    std::size_t pairs = 0;
    for (const PolyMesh& mesh : meshes)
        for (const Patch& here : mesh.patches) {
            if (here.other < 0) continue;
            const PolyMesh& other = meshes.at(static_cast<std::size_t>(here.other));
            const auto there = std::find_if(other.patches.begin(), other.patches.end(),
                                            [&](const Patch& patch) { return patch.other == here.self; });
            EXPECT_NE(there, other.patches.end());
            if (there == other.patches.end()) continue;
            EXPECT_EQ(here.faces, there->faces);
            if (here.faces != there->faces) continue;
            for (std::size_t f = 0; f < here.faces; ++f)
                for (std::size_t i = 0; i < 3; ++i)
                    EXPECT_EQ(mesh.corner(here.start + f, i), other.corner(there->start + f, (3 - i) % 3));
            ++pairs;
        }
    return pairs / 2;
}

}  // namespace kerf::test::openfoam

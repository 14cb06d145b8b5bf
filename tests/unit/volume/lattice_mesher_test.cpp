// The laws of the mesher that stamps a core, for surfaces by chance.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "base/core/error.h"
#include "fill/mesh/verification.h"
#include "fill/volume/mesher.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr unsigned surfaces_by_chance = 200;

using Chance = std::mt19937;

double between(Chance& chance, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(chance);
}
int one_of(Chance& chance, int low, int high) { return std::uniform_int_distribution<int>(low, high)(chance); }

// Normals are as before for small amounts.
Soup perturbed(Soup soup, double amount, Chance& chance) {
    for (Vec3& p : soup.vertices)
        for (double& x : p) x += between(chance, -amount, amount);
    return soup;
}

struct ChanceSurface {
    Soup soup;
    bool has_room;  // for a core, at bounds as below
};

ChanceSurface any_shape(Chance& chance) {
    using namespace test;
    switch (one_of(chance, 0, 9)) {
        case 0:
            return {box(Vec3::Zero(), Vec3(1, between(chance, 0.5, 2), 1), one_of(chance, 4, 8)), true};
        case 1:
            return {box(Vec3::Zero(), Vec3(1, 1, between(chance, 0.002, 0.02)), {10, 10, 1}), false};
        case 2:
            return {prism(one_of(chance, 5, 20), between(chance, 0.003, 0.02), 1), false};
        case 3:
            return {perturbed(icosphere(2), between(chance, 0, 0.06), chance), true};
        case 4:
            return {perturbed(icosphere(3), between(chance, 0, 0.03), chance), true};
        case 5:
            return {nested_boxes(one_of(chance, 2, 3), 6), false};
        case 6: {
            const double gap = std::pow(10, between(chance, -6, -1));  // they almost touch
            return {join(icosphere(2), translated(icosphere(2), Vec3(2 + gap, 0, 0))), true};
        }
        case 7:
            return {torus(2, between(chance, 0.3, 1), 30, 14), true};
        case 8:
            return {linked_rings(2, 24, 10), true};
        default:
            return {uv_sphere(one_of(chance, 8, 16), one_of(chance, 8, 24)), true};
    }
}

ChanceSurface surface_by_chance(Chance& chance) {
    ChanceSurface surface = any_shape(chance);
    const Vec3 axis(between(chance, -1, 1), between(chance, -1, 1), between(chance, 0.1, 1));
    const Eigen::AngleAxisd rotation(one_of(chance, 0, 3) == 0 ? 0 : between(chance, 0, 3), axis.normalized());
    const double scale = std::pow(10, one_of(chance, -6, 6)), far = one_of(chance, 0, 4) == 0 ? 1e4 : 0;
    for (Vec3& p : surface.soup.vertices) p = scale * (rotation * p + far * axis);
    return surface;
}

double volume_of(const SurfaceArrays& surface) {
    const Vec3& origin = surface.vertices[0];
    double volume = 0;
    for (const auto& [a, b, c] : surface.facets)
        volume +=
            (surface.vertices[a] - origin).dot((surface.vertices[b] - origin).cross(surface.vertices[c] - origin)) / 6;
    return volume;
}

enum Ending { core_and_shell, by_tetgen, refused, laws_broken, endings };

Ending ending_of(const SurfaceArrays& surface, const MesherOptions& options) {
    try {
        const Filling filling = mesh_volume(surface, options);
        if (!verify_mesh(filling.mesh, surface).hold()) return laws_broken;
        if ((filling.core_tets > 0) != (filling.strategy == "core and shell")) return laws_broken;
        return filling.core_tets > 0 ? core_and_shell : by_tetgen;
    } catch (const Error& error) {
        return error.code() == ErrorCode::subdomain ? refused : laws_broken;
    }
}

// In a process of its own, because TetGen may abort; `endings` then.
int ending_in_child(const SurfaceArrays& surface, const MesherOptions& options) {
    const pid_t child = fork();
    if (child == 0) _exit(ending_of(surface, options));
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) < endings ? WEXITSTATUS(status) : endings;
}

TEST(LatticeMesher, ObeysTheLawsForSurfacesByChance) {
    std::array<int, endings + 1> with_room = {}, without_room = {};
    for (unsigned seed = 0; seed < surfaces_by_chance; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Chance chance(seed);
        const auto [soup, has_room] = surface_by_chance(chance);
        const SurfaceArrays surface = test::to_arrays(soup);
        MesherOptions options;
        options.name = "lattice";
        options.size = SizeField(volume_of(surface) / between(chance, 2000, 6000));
        const int ending = ending_in_child(surface, options);
        EXPECT_NE(ending, laws_broken);
        if (ending > by_tetgen) std::cout << "seed " << seed << ": " << (ending == refused ? "refused\n" : "aborted\n");
        ++(has_room ? with_room : without_room)[ending];
    }
    const int count = std::accumulate(with_room.begin(), with_room.end(), 0);
    std::cout << with_room[core_and_shell] << " of " << count << " with room have a core, " << with_room[by_tetgen]
              << " are TetGen's; of those without room " << without_room[by_tetgen] << "\n";
    EXPECT_GT(count, 100);
    EXPECT_GT(with_room[core_and_shell], 0.7 * count);
    EXPECT_LE(with_room[endings] + without_room[endings], surfaces_by_chance / 50);
    EXPECT_LE(with_room[refused] + without_room[refused], surfaces_by_chance / 50);
}

}  // namespace
}  // namespace kerf

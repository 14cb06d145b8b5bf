#include "support/random_cubes.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "support/shapes.h"

namespace kerf::test {

namespace {

using Cube = std::array<int, 3>;

class CubeSet {
 public:
    explicit CubeSet(int edge) : edge_(edge) {}

    void insert(const Cube& cube) { cubes_.insert(cube); }

    // Inserts cubes until the surface is a manifold at every corner.
    void mend() {
        for (bool is_changed = true; is_changed;) {
            is_changed = false;
            for (int i = 0; i <= edge_; ++i)
                for (int j = 0; j <= edge_; ++j)
                    for (int k = 0; k <= edge_; ++k)
                        if (!hang_together({i, j, k}, true) || !hang_together({i, j, k}, false))
                            is_changed |= fill_around({i, j, k});
        }
    }

    Soup surface() const {
        Soup soup;
        for (const auto& [i, j, k] : cubes_) {
            const Soup cube = box(Vec3(i, j, k), Vec3(i + 1, j + 1, k + 1));
            soup = soup.facets.empty() ? cube : join(std::move(soup), cube);
        }
        weld_exactly(soup);
        cancel_common_facets(soup);
        drop_unused_vertices(soup);
        soup.vertex_number.clear();
        return soup;
    }

 private:
    // One of the eight at a corner.
    static Cube cube_at(const Cube& corner, int which) {
        return {corner[0] - (which & 1), corner[1] - (which >> 1 & 1), corner[2] - (which >> 2)};
    }

    // Whether the cubes around the corner that are there, or those that are not, are connected by their sides.
    bool hang_together(const Cube& corner, bool there) const {
        std::array<int, 8> group = {};  // 0: none of them
        for (int which = 0; which < 8; ++which)
            if ((cubes_.count(cube_at(corner, which)) > 0) == there) group[which] = which + 1;
        for (int round = 0; round < 8; ++round)
            for (int which = 0; which < 8; ++which)
                for (const int bit : {1, 2, 4})
                    if (group[which] > 0 && group[which ^ bit] > 0)
                        group[which] = std::min(group[which], group[which ^ bit]);
        std::set<int> groups(group.begin(), group.end());
        groups.erase(0);
        return groups.size() <= 1;
    }

    bool fill_around(const Cube& corner) {
        bool is_changed = false;
        for (int which = 0; which < 8; ++which) {
            const Cube cube = cube_at(corner, which);
            const auto [least, most] = std::minmax_element(cube.begin(), cube.end());
            if (*least >= 0 && *most < edge_) is_changed |= cubes_.insert(cube).second;
        }
        return is_changed;
    }

    int edge_;
    std::set<Cube> cubes_;
};

}  // namespace

Soup random_cubes(int edge, double share, SeededNumbers& random) {
    CubeSet cubes(edge);
    for (int i = 0; i < edge; ++i)
        for (int j = 0; j < edge; ++j)
            for (int k = 0; k < edge; ++k)
                if (random.with_chance(share)) cubes.insert({i, j, k});
    cubes.insert({0, 0, 0});
    cubes.mend();
    return cubes.surface();
}

}  // namespace kerf::test

#include "support/voxel_regions.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <numeric>
#include <random>

#include <fmt/format.h>

namespace kerf::test {

namespace {

using Cube = std::array<std::int32_t, 3>;

bool is_inside(const Cube& cube, std::int32_t low, std::int32_t high) {
    return std::all_of(cube.begin(), cube.end(), [&](std::int32_t c) { return c >= low && c < high; });
}

class VoxelBodyMaker {
 public:
    VoxelBodyMaker(Cube cubes, const RegionOfCube& region) : cubes_(cubes) {
        for_each_cube([&](const Cube& cube) { numbers_.try_emplace(region(cube)); });
        numbers_.erase(-1);
        for (auto& [region_of_caller, number] : numbers_) {
            number = RegionIndex(body_.names.size());
            body_.names.push_back(fmt::format("region_{}", number.value()));
        }
        body_.volumes.assign(body_.names.size(), 0);
        for_each_cube([&](const Cube& cube) {
            const std::int32_t wanted = region(cube);
            regions_.push_back(wanted < 0 ? RegionIndex::none() : numbers_.at(wanted));
            if (wanted >= 0) ++body_.volumes[regions_.back()];
        });
    }

    VoxelBody make() {
        for (std::int32_t axis = 0; axis < 3; ++axis) add_squares(axis);
        SurfaceArrays& facets = body_.facets;
        facets.vertex_key.resize(facets.vertices.size());
        facets.facet_key.resize(facets.facets.size());
        std::iota(facets.vertex_key.begin(), facets.vertex_key.end(), make_key(input_node, 0));
        std::iota(facets.facet_key.begin(), facets.facet_key.end(), make_key(input_node, 0));
        return std::move(body_);
    }

 private:
    template <class Visit>
    void for_each_cube(Visit visit) const {
        for (std::int32_t x = 0; x < cubes_[0]; ++x)
            for (std::int32_t y = 0; y < cubes_[1]; ++y)
                for (std::int32_t z = 0; z < cubes_[2]; ++z) visit(Cube{x, y, z});
    }
    RegionIndex region_at(const Cube& cube) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (cube[i] < 0 || cube[i] >= cubes_[i]) return RegionIndex::none();
        return regions_[static_cast<std::size_t>((cube[0] * cubes_[1] + cube[1]) * cubes_[2] + cube[2])];
    }
    std::int32_t vertex(const Cube& place) {
        const auto [found, is_new] = vertices_.emplace(place, static_cast<std::int32_t>(body_.facets.vertices.size()));
        if (is_new) body_.facets.vertices.emplace_back(place[0], place[1], place[2]);
        return found->second;
    }
    // Across this axis.
    void add_squares(std::int32_t axis) {
        for (std::int32_t x = 0; x <= cubes_[0]; ++x)
            for (std::int32_t y = 0; y <= cubes_[1]; ++y)
                for (std::int32_t z = 0; z <= cubes_[2]; ++z) {
                    const Cube above = {x, y, z};
                    Cube below = above;
                    --below[static_cast<std::size_t>(axis)];
                    if (region_at(below) != region_at(above))
                        add_square(above, axis, region_at(below), region_at(above));
                }
    }
    void add_square(const Cube& corner, std::int32_t axis, RegionIndex below, RegionIndex above) {
        const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
        Cube b = corner, c = corner, d = corner;
        ++b[u];
        ++c[u];
        ++c[v];
        ++d[v];
        const std::array<std::int32_t, 4> square = {vertex(corner), vertex(b), vertex(c), vertex(d)};
        add_triangle({square[0], square[1], square[2]}, below, above);
        add_triangle({square[0], square[2], square[3]}, below, above);
    }
    // The normal points along the axis; the smaller number of two regions lies behind.
    void add_triangle(Triangle t, RegionIndex below, RegionIndex above) {
        const FacetSides sides = {above, below};
        const bool is_turned = !below.is_valid() || (above.is_valid() && above < below);
        if (is_turned) std::swap(t[1], t[2]);
        body_.facets.facets.push_back(t);
        body_.facets.patch.push_back(sides.is_wall() ? 1 : 0);
        body_.sides.push_back(is_turned ? sides.turned() : sides);
    }

    Cube cubes_;
    VoxelBody body_;
    std::map<std::int32_t, RegionIndex> numbers_;
    std::vector<RegionIndex> regions_;
    std::map<Cube, std::int32_t> vertices_;
};

}  // namespace

VoxelBody voxel_body(std::array<std::int32_t, 3> cubes, const RegionOfCube& region) {
    return VoxelBodyMaker(cubes, region).make();
}

void write_tets(const std::string& path, std::array<std::int32_t, 3> cubes, const RegionOfCube& region) {
    const auto vertex = [&](const Cube& place) {
        return 1 + (place[0] * (cubes[1] + 1) + place[1]) * (cubes[2] + 1) + place[2];
    };
    std::string vertices, tets;
    std::int32_t tet_count = 0;
    for (std::int32_t x = 0; x <= cubes[0]; ++x)
        for (std::int32_t y = 0; y <= cubes[1]; ++y)
            for (std::int32_t z = 0; z <= cubes[2]; ++z) {
                vertices += fmt::format("{} {} {} 0\n", x, y, z);
                const bool is_cube = x < cubes[0] && y < cubes[1] && z < cubes[2];
                const std::int32_t wanted = is_cube ? region({x, y, z}) : -1;
                if (wanted < 0) continue;
                // From the lowest corner to the highest one along three edges, in each order.
                std::array<std::size_t, 3> axes = {0, 1, 2};
                do {
                    Cube place = {x, y, z};
                    tets += fmt::format("{}", vertex(place));
                    for (const std::size_t axis : axes) {
                        ++place[axis];
                        tets += fmt::format(" {}", vertex(place));
                    }
                    tets += fmt::format(" {}\n", wanted + 1);
                    ++tet_count;
                } while (std::next_permutation(axes.begin(), axes.end()));
            }
    std::ofstream(path) << fmt::format("MeshVersionFormatted 2\nDimension 3\nVertices {}\n{}Tetrahedra {}\n{}End\n",
                                       (cubes[0] + 1) * (cubes[1] + 1) * (cubes[2] + 1), vertices, tet_count, tets);
}

RegionOfCube refined(RegionOfCube region, std::int32_t n) {
    return [region = std::move(region), n](Cube cube) {
        for (std::int32_t& c : cube) c /= n;
        return region(cube);
    };
}

RegionOfCube grains(std::array<std::int32_t, 3> cubes, std::int32_t count, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<Cube> places;
    for (std::int32_t i = 0; i < count; ++i) {
        Cube& place = places.emplace_back();
        for (std::size_t k = 0; k < 3; ++k)
            place[k] = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(cubes[k]));
    }
    return [places](Cube cube) {
        const auto distance = [&](const Cube& place) {
            std::int32_t sum = 0;
            for (std::size_t k = 0; k < 3; ++k) sum += (place[k] - cube[k]) * (place[k] - cube[k]);
            return sum;
        };
        const auto nearest = std::min_element(places.begin(), places.end(),
                                              [&](const Cube& a, const Cube& b) { return distance(a) < distance(b); });
        return static_cast<std::int32_t>(nearest - places.begin());
    };
}

std::vector<TouchingBodies> touching_bodies() {
    return {
        {"two_at_a_wall", {2, 1, 1}, [](Cube c) { return c[0]; }},
        {"three_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] + 2 * c[1] - 1; }},
        {"eight_at_a_point", {2, 2, 2}, [](Cube c) { return c[0] + 2 * c[1] + 4 * c[2]; }},
        {"twenty_layers", {2, 2, 20}, [](Cube c) { return c[2]; }},
        {"one_in_another", {3, 3, 3}, [](Cube c) { return is_inside(c, 1, 2) ? 1 : 0; }},
        {"void_in_one_in_another",
         {5, 5, 5},
         [](Cube c) { return is_inside(c, 2, 3)   ? -1
                             : is_inside(c, 1, 4) ? 1
                                                  : 0; }},
        {"two_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] != c[1] ? -1 : c[0]; }},
        {"two_at_a_vertex", {2, 2, 2}, [](Cube c) { return c[0] != c[1] || c[1] != c[2] ? -1 : c[0]; }},
        {"one_twice_at_an_edge", {2, 2, 1}, [](Cube c) { return c[0] == c[1] ? 0 : 1; }},
        {"grains", {6, 6, 6}, grains({6, 6, 6}, 12, 1)},
    };
}

}  // namespace kerf::test

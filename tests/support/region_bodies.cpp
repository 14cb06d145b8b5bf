#include "support/region_bodies.h"
#include "support/facet_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "support/shapes.h"

namespace kerf::test {

namespace {

// Closed surfaces that do not touch: region 0 is between the first one and the others, each of which has one inside.
Soup nested(const Soup& outer, const std::vector<Soup>& inner, std::vector<std::string> names) {
    Soup all = outer;
    all.sides.assign(all.facets.size(), facet_sides(-1, 0));
    for (std::size_t i = 0; i < inner.size(); ++i) {
        all = join(std::move(all), inner[i]);
        all.sides.resize(all.facets.size(), facet_sides(0, static_cast<std::int32_t>(i) + 1));
    }
    all.region_names = std::move(names);
    return all;
}

// A block of 2 x 2 towers with a fibre each, whose axis is that of the tower.
class FibresInBlock {
 public:
    explicit FibresInBlock(int fineness) : steps_(4 * fineness), layers_(6 * fineness) {
        soup_.patch_names = {"outside", "wall"};
        soup_.region_names = {"block", "fibre_1", "fibre_2", "fibre_3", "fibre_4"};
    }

    Soup make() {
        for (int tower = 0; tower < 4; ++tower) add_tower(tower);
        weld_exactly(soup_);
        soup_.vertex_number.clear();
        return std::move(soup_);
    }

 private:
    using Square = std::array<Vec3, 4>;
    static constexpr double radius = 0.7;

    // Place i of the 4 * steps_ around the axis, from the circle of the fibre (0) to the sides of the tower (1).
    Vec3 place(int tower, int i, double outwards, int layer) const {
        const int side = i / steps_ % 4;
        const double along = (2.0 * (i % steps_) - steps_) / steps_;  // from -1, and as exact as its opposite
        const Vec2 on_side = side == 0   ? Vec2(1, along)
                             : side == 1 ? Vec2(-along, 1)
                             : side == 2 ? Vec2(-1, -along)
                                         : Vec2(along, -1);
        const double angle = std::numbers::pi / 4 * (2 * side + along);
        const Vec2 on_circle = radius * Vec2(std::cos(angle), std::sin(angle));
        const Vec2 p = axis(tower) + (outwards == 1 ? on_side : on_circle + outwards * (on_side - on_circle));
        return {p.x(), p.y(), height(layer)};
    }
    static Vec2 axis(int tower) { return {2.0 * (tower % 2) + 1, 2.0 * (tower / 2) + 1}; }
    double height(int layer) const { return 3.0 * layer / layers_; }

    // The normal of the corners points to the front. The last two corners may be the same.
    void add(const Square& corners, FacetSides sides) {
        const auto first = static_cast<std::int32_t>(soup_.vertices.size());
        soup_.vertices.insert(soup_.vertices.end(), corners.begin(), corners.end());
        for (const Triangle& t : {Triangle{first, first + 1, first + 2}, Triangle{first, first + 2, first + 3}}) {
            if (corners[2] == corners[3] && t[2] == first + 3) continue;
            soup_.facets.push_back(t);
            soup_.patch.push_back(sides.is_wall() ? 1 : 0);
            soup_.sides.push_back(sides);
        }
    }

    // Across the axis: normals upwards.
    void add_disc(int tower, int layer, FacetSides sides) {
        const Vec2 centre = axis(tower);
        const Vec3 middle(centre.x(), centre.y(), height(layer));
        const auto inside = [&](int i, int ring) {
            return ring == 0 ? middle : Vec3(middle + (place(tower, i, 0, layer) - middle) * (2.0 * ring / steps_));
        };
        for (int i = 0; i < 4 * steps_; ++i) {
            for (int ring = 1; ring < steps_ / 2; ++ring) {
                const bool is_last = ring + 1 == steps_ / 2;
                const auto outer = [&](int j) { return is_last ? place(tower, j, 0, layer) : inside(j, ring + 1); };
                add({inside(i, ring), outer(i), outer(i + 1), inside(i + 1, ring)}, sides);
            }
            add({middle, inside(i, 1), inside(i + 1, 1), inside(i + 1, 1)}, sides);
        }
    }
    void add_surroundings(int tower, int layer, FacetSides sides) {
        const int rings = steps_ / 4;
        const auto at = [&](int i, int ring) { return place(tower, i, static_cast<double>(ring) / rings, layer); };
        for (int i = 0; i < 4 * steps_; ++i)
            for (int ring = 0; ring < rings; ++ring)
                add({at(i, ring), at(i, ring + 1), at(i + 1, ring + 1), at(i + 1, ring)}, sides);
    }
    // Along the axis: normals away from it.
    void add_tube(int tower, double outwards, int lowest, int first, int count, FacetSides sides) {
        for (int i = first; i < first + count; ++i)
            for (int layer = lowest; layer < layers_; ++layer)
                add({place(tower, i, outwards, layer), place(tower, i + 1, outwards, layer),
                     place(tower, i + 1, outwards, layer + 1), place(tower, i, outwards, layer + 1)},
                    sides);
    }

    void add_tower(int tower) {
        const std::int32_t fibre = tower + 1;
        const int floor = tower % 2 == 0 ? 0 : layers_ / 3;
        add_disc(tower, layers_, facet_sides(-1, fibre));
        add_surroundings(tower, layers_, facet_sides(-1, 0));
        add_tube(tower, 0, floor, 0, 4 * steps_, facet_sides(0, fibre));
        if (floor > 0) add_disc(tower, floor, facet_sides(fibre, 0));
        add_disc(tower, 0, facet_sides(floor > 0 ? 0 : fibre, -1));
        add_surroundings(tower, 0, facet_sides(0, -1));
        const int side_x = tower % 2 == 0 ? 2 : 0, side_y = tower / 2 == 0 ? 3 : 1;
        for (const int side : {side_x, side_y}) add_tube(tower, 1, 0, side * steps_, steps_, facet_sides(-1, 0));
    }

    int steps_, layers_;  // of a side, and of the height
    Soup soup_;
};

}  // namespace

Soup ball_in_cube(int fineness) {
    return nested(box(Vec3(-1.5, -1.5, -1.5), Vec3(1.5, 1.5, 1.5), 4 * fineness),
                  {uv_sphere(5 * fineness, 8 * fineness)}, {"cube", "ball"});
}

Soup linked_rings_in_box(int fineness) {
    const Soup ring = torus(1, 0.35, 12 * fineness, 5 * fineness);
    Soup other = ring;  // turned about x, so that it goes through the hole of the first one
    for (Vec3& p : other.vertices) p = Vec3(p.x() + 1, -p.z(), p.y());
    return nested(box(Vec3(-1.75, -1.75, -1.75), Vec3(2.75, 1.75, 1.75), 4 * fineness), {ring, other},
                  {"box", "ring_1", "ring_2"});
}

Soup fibres_in_block(int fineness) { return FibresInBlock(fineness).make(); }

}  // namespace kerf::test

// Pairs of convex bodies that overlap, touch or lie within each other, with equal facets and others, become their
// union. The oracle clips each facet by the planes of the other body: what is left inside bounds what both have in
// common.
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "run/prepare/input.h"
#include "support/seeded_numbers.h"
#include "support/shapes.h"

namespace kerf {
namespace {

constexpr int pairs = 200, shares = 8;
constexpr double in_plane = 1e-9;

struct PlaneOf {
    Vec3 point, normal;
};

struct VolumeAndArea {
    double volume = 0, area = 0;
};

std::vector<PlaneOf> planes_of(const Soup& body) {
    std::vector<PlaneOf> planes;
    for (const Triangle& t : body.facets)
        planes.push_back({body.vertices[t[0]], area_vector(body.vertices, t).normalized()});
    return planes;
}

// What lies behind the plane, or on it.
std::vector<Vec3> clip(const std::vector<Vec3>& polygon, const PlaneOf& plane) {
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double above_a = plane.normal.dot(a - plane.point), above_b = plane.normal.dot(b - plane.point);
        if (above_a <= in_plane) kept.push_back(a);
        if ((above_a > in_plane && above_b < -in_plane) || (above_a < -in_plane && above_b > in_plane))
            kept.push_back(a + above_a / (above_a - above_b) * (b - a));
    }
    return kept;
}

// Of the facets of a body what lies in another, its surface included. `same`: what lies on facets of the other that
// face the same way.
struct Inside {
    VolumeAndArea all, same;
};
Inside inside_of(const Soup& body, const Soup& other) {
    Inside inside;
    const std::vector<PlaneOf> planes = planes_of(other);
    for (const Triangle& t : body.facets) {
        const Vec3 normal = area_vector(body.vertices, t).normalized();
        std::vector<Vec3> polygon = {body.vertices[t[0]], body.vertices[t[1]], body.vertices[t[2]]};
        for (const PlaneOf& plane : planes) polygon = clip(polygon, plane);
        Vec3 area = Vec3::Zero();
        for (std::size_t i = 2; i < polygon.size(); ++i)
            area += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]) / 2;
        const bool is_same = std::any_of(planes.begin(), planes.end(), [&](const PlaneOf& plane) {
            return plane.normal.dot(normal) > 1 - in_plane &&
                   std::abs(plane.normal.dot(body.vertices[t[0]] - plane.point)) < in_plane;
        });
        const VolumeAndArea own = {polygon.empty() ? 0 : area.dot(polygon[0]) / 3, area.norm()};
        for (VolumeAndArea* sum : {&inside.all, is_same ? &inside.same : nullptr}) {
            if (sum == nullptr) continue;
            sum->volume += own.volume;
            sum->area += own.area;
        }
    }
    return inside;
}

// Of what bounds it: facets with outside on one side.
VolumeAndArea measure(const Soup& soup) {
    VolumeAndArea sum;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        if (!soup.sides.empty() && soup.sides[f].is_wall()) continue;
        const Vec3 area = area_vector(soup.vertices, soup.facets[f]);
        sum.volume += area.dot(soup.vertices[soup.facets[f][0]]) / 3;
        sum.area += area.norm();
    }
    return sum;
}

VolumeAndArea union_of(const Soup& a, const Soup& b) {
    const Inside of_a = inside_of(a, b), of_b = inside_of(b, a);
    const VolumeAndArea whole_a = measure(a), whole_b = measure(b);
    return {whole_a.volume + whole_b.volume - (of_a.all.volume + of_b.all.volume - of_b.same.volume),
            whole_a.area + whole_b.area - (of_a.all.area + of_b.all.area - of_b.same.area)};
}

Soup named(Soup body, const char* name) {
    body.patch.assign(body.facets.size(), 0);
    body.patch_names = {name};
    return body;
}

// Of size 1 around the origin, but for a ball, whose vertices are doubles that no sum of others meets.
Soup body_of(int kind, int fineness) {
    if (kind == 0) return test::box(Vec3::Constant(-0.5), Vec3::Constant(0.5), fineness);
    if (kind == 1) return test::translated(test::prism(3 + fineness, 0.5, 1), Vec3(0, 0, -0.5));
    return test::icosphere(fineness / 2, 0.5);
}

struct Pair {
    Soup a, b;
    std::string text;
    bool is_one = false;  // both are the same
};

Pair random_pair(int number) {
    test::SeededNumbers random(static_cast<std::uint64_t>(number));
    static const char* const places[] = {"shifted by facets", "touching", "within", "shifted", "the same"};
    const int place = number % 5;
    const int kind = random.integer(0, 2), fineness = random.integer(1, 4);
    const bool is_like = place == 4 || random.with_chance(0.6);
    const int other_kind = is_like ? kind : random.integer(0, 2);
    const int other_fineness = place == 4 || random.with_chance(0.5) ? fineness : random.integer(1, 4);
    Pair pair = {body_of(kind, fineness), body_of(other_kind, other_fineness), "", place == 4};
    Vec3 shift = Vec3::Zero();
    const int axis = kind == 1 ? 2 : random.integer(0, 2);
    if (place == 0) shift[axis] = static_cast<double>(random.integer(1, fineness)) / fineness;
    if (place == 0 && kind == 0 && random.with_chance(0.5)) shift[(axis + 1) % 3] = 1.0 / fineness;
    if (place == 1) shift[axis] = 1;
    if (place == 1 && random.with_chance(0.4)) shift[(axis + 1) % 3] = random.between(-0.5, 0.5);
    const double size = place != 2 ? 1 : random.with_chance(0.5) ? 0.5 : 0.5625;
    for (Vec3& p : pair.b.vertices) p *= size;
    if (place == 2 && random.with_chance(0.4)) shift[axis] = 0.25;  // onto a side, from within
    if (place == 3) shift = Vec3(random.between(-0.7, 0.7), random.between(-0.7, 0.7), random.between(-0.7, 0.7));
    pair.b = test::translated(pair.b, shift);
    pair.text = fmt::format("pair {}, {}: {}_{} and {}_{} by ({})", number, places[place], kind, fineness, other_kind,
                            other_fineness, fmt::join(shift, ", "));
    return pair;
}

void expect_union(const Pair& pair, bool is_named, const std::string& level) {
    SCOPED_TRACE(pair.text + (is_named ? ", named, --repair " : ", --repair ") + level);
    Soup both = test::join(named(pair.a, "a"), named(pair.b, "b"));
    if (!is_named) both = named(std::move(both), "all");
    InputOptions options;
    options.repairs.plan = level;
    CheckedSoup checked = check_soup(both, options, 0);
    if (!checked.diagnosis.clean()) {
        if (level != "exact")
            ADD_FAILURE() << checked.diagnosis.summary(checked.soup) << "\n" << to_text(checked.ladder);
        return;
    }
    apply_repairs(checked);
    const VolumeAndArea wanted = union_of(pair.a, pair.b), got = measure(checked.soup);
    if (level == "full,bodies=regions" && !pair.is_one) {
        EXPECT_EQ(checked.soup.region_names, (std::vector<std::string>{"a", "b"})) << to_text(checked.ladder);
    }
    EXPECT_NEAR(got.volume, wanted.volume, 1e-4 * wanted.volume) << to_text(checked.ladder);
    EXPECT_NEAR(got.area, wanted.area, 1e-3 * wanted.area) << to_text(checked.ladder);
}

class PairsOfBodies : public testing::TestWithParam<int> {};

TEST_P(PairsOfBodies, BecomeTheirUnion) {
    for (int number = GetParam(); number < pairs; number += shares) {
        const Pair pair = random_pair(number);
        const bool is_named = number % 2 == 0;
        expect_union(pair, is_named, "full");
        expect_union(pair, is_named, "exact");
        expect_union(pair, true, "full,bodies=regions");
    }
}
INSTANTIATE_TEST_SUITE_P(TwentyFive, PairsOfBodies, testing::Range(0, shares));

}  // namespace
}  // namespace kerf

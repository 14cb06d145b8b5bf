// Every kind of defect, made in many surfaces at places that seeds choose, is listed with its kind, its severity and
// the numbers of its facets and vertices, and nothing else is. What repairs undo is the surface that it was.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "files/io/surface_reader.h"
#include "run/prepare/input.h"
#include "support/assets.h"
#include "support/damage.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"

namespace kerf {
namespace {

using test::Damage;
using test::Damaged;
using test::ExpectedDefect;
using test::lines;
using Lines = std::vector<std::string>;

constexpr double needle_angle_deg = 0.1;  // no surface of this test has such facets, before they are made

struct NamedSoup {
    std::string name;
    Soup soup;
};

std::vector<NamedSoup> shapes() {
    std::vector<NamedSoup> shapes = {{"box", test::box(Vec3(0, 0, 0), Vec3(1, 2, 3), 3)},
                                     {"icosphere", test::icosphere(2)},
                                     {"uv_sphere", test::uv_sphere(7, 9)},
                                     {"torus", test::torus(3, 1, 9, 6)},
                                     {"prism", test::prism(7, 1, 2)},
                                     {"plate_with_hole", test::plate_with_hole(12)},
                                     {"nested_boxes", test::nested_boxes(3, 2)},
                                     {"linked_rings", test::linked_rings(2, 12, 8)}};
    for (NamedSoup& shape : shapes) shape.soup = test::on_a_grid(std::move(shape.soup));
    return shapes;
}

std::vector<NamedSoup> assets() {
    std::vector<NamedSoup> assets;
    for (const char* name : {"cube", "cylinder", "hollow_box"}) {
        assets.push_back({name, read_surface(test::asset_path(name))});
        assets.back().soup.vertex_number.clear();  // the numbers of the soup are meant
    }
    return assets;
}

CheckedSoup check(const Soup& soup, const InputOptions& options = {}) {
    return check_soup(soup, options, needle_angle_deg);
}

Lines lines(const CheckedSoup& checked) { return test::lines(checked.soup, checked.diagnosis); }

bool any_error(const std::vector<ExpectedDefect>& expected) {
    return std::any_of(expected.begin(), expected.end(), [](auto& d) { return d.severity == Severity::error; });
}

void expect_listed(const NamedSoup& base, const Damage& damage, unsigned seed) {
    SCOPED_TRACE(base.name + ", " + damage.name + ", seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const Damaged damaged = damage.apply(base.soup, random);
    ASSERT_FALSE(damaged.expected.empty());
    const CheckedSoup checked = check(damaged.soup);
    EXPECT_EQ(lines(checked), lines(damaged.expected));
    EXPECT_EQ(checked.diagnosis.clean(), !any_error(damaged.expected));
    for (const Defect& defect : checked.diagnosis.defects)
        EXPECT_EQ(std::string(advice(defect)).starts_with("nothing needs to be done"),
                  defect.severity == Severity::repaired)
            << advice(defect);
}

// Facets from their lowest vertex on, sorted.
std::vector<Triangle> facet_set(std::vector<Triangle> facets) {
    for (Triangle& t : facets) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    std::sort(facets.begin(), facets.end());
    return facets;
}

TEST(Defects, CleanSurfacesHaveNone) {
    for (const auto& bases : {shapes(), assets()})
        for (const NamedSoup& base : bases) EXPECT_EQ(lines(check(base.soup)), Lines()) << base.name;
}

TEST(Defects, EachIsListedWithItsNumbersInEveryShape) {
    for (const NamedSoup& shape : shapes())
        for (const Damage& damage : test::all_damages())
            for (unsigned seed = 1; seed <= 5; ++seed) expect_listed(shape, damage, seed);
}

TEST(Defects, EachIsListedWithItsNumbersInTheAssets) {
    unsigned seed = 100;
    for (const NamedSoup& asset : assets())
        for (const Damage& damage : test::all_damages()) expect_listed(asset, damage, ++seed);
}

// Shells are only located where the surface is closed otherwise; polygons get lost where soups are joined.
TEST(Defects, TwoAtOnceAreBothListed) {
    const Lines not_combined = {"inverted shell", "second body inside", "unfit polygon"};
    const auto is_combined = [&](const Damage& d) {
        return std::find(not_combined.begin(), not_combined.end(), d.name) == not_combined.end();
    };
    const Soup sphere = test::on_a_grid(test::icosphere(1));
    const Soup torus = test::on_a_grid(test::translated(test::torus(3, 1, 9, 6), Vec3(1000, 0, 0)));
    unsigned seed = 1000;
    for (const Damage& one : test::all_damages())
        for (const Damage& other : test::all_damages()) {
            if (!is_combined(one) || !is_combined(other) || &one == &other) continue;
            std::mt19937 random(++seed);
            SCOPED_TRACE(std::string(one.name) + ", " + other.name + ", seed " + std::to_string(seed));
            const Damaged a = one.apply(sphere, random);
            Damaged b = other.apply(torus, random);
            std::vector<ExpectedDefect> expected = a.expected;
            for (ExpectedDefect& d : b.expected) {
                for (std::int32_t& f : d.facets) f += static_cast<std::int32_t>(a.soup.facets.size());
                for (std::int32_t& v : d.vertices) v += static_cast<std::int32_t>(a.soup.vertices.size());
                const auto turned = std::find_if(expected.begin(), expected.end(), [&](const ExpectedDefect& e) {
                    return e.kind == DefectKind::inconsistent_orientation && e.kind == d.kind;
                });
                if (turned == expected.end())
                    expected.push_back(d);
                else  // one defect lists all
                    turned->facets.insert(turned->facets.end(), d.facets.begin(), d.facets.end());
            }
            EXPECT_EQ(lines(check(test::join(a.soup, b.soup))), lines(expected));
        }
}

TEST(Defects, RepairsGiveTheUndamagedSurfaceBack) {
    for (const auto& bases : {shapes(), assets()})
        for (const NamedSoup& base : bases)
            for (unsigned seed = 1; seed <= 3; ++seed) {
                SCOPED_TRACE(base.name + ", seed " + std::to_string(seed));
                std::mt19937 random(seed);
                Soup soup = base.soup;
                for (const Damage& damage : test::mendable_damages()) soup = damage.apply(soup, random).soup;
                if (seed == 2) soup = test::inside_out(std::move(soup));
                CheckedSoup checked = check(soup);
                ASSERT_TRUE(checked.diagnosis.clean()) << checked.diagnosis.summary(checked.soup);
                apply_repairs(checked);
                EXPECT_EQ(checked.tidied.dropped_facets, 4) << "a repeated vertex, a copy and a pocket";
                EXPECT_EQ(checked.soup.vertices, base.soup.vertices);
                EXPECT_EQ(facet_set(checked.soup.facets), facet_set(base.soup.facets));
                EXPECT_EQ(checked.soup.patch.size(), checked.soup.facets.size());
                EXPECT_EQ(lines(check(checked.soup)), Lines());
                EXPECT_GT(enclosed_volume(test::to_surface(checked.soup)), 0);
            }
}

TEST(Defects, SecondBodyInsideIsMadeAVoidByParityOrByAHolePoint) {
    const auto it = std::find_if(test::all_damages().begin(), test::all_damages().end(),
                                 [](const Damage& d) { return std::string(d.name) == "second body inside"; });
    for (const auto& bases : {shapes(), assets()})
        for (const NamedSoup& base : bases) {
            SCOPED_TRACE(base.name);
            std::mt19937 random(7);
            Damaged damaged = it->apply(base.soup, random);
            InputOptions parity;
            parity.voids = Voids::parity;
            CheckedSoup checked = check(damaged.soup, parity);
            damaged.expected[0].severity = Severity::repaired;
            EXPECT_EQ(lines(checked), lines(damaged.expected));

            Vec3 centre = Vec3::Zero();
            for (std::size_t v = base.soup.vertices.size(); v < damaged.soup.vertices.size(); ++v)
                centre += damaged.soup.vertices[v];
            damaged.soup.holes = {centre /
                                  static_cast<double>(damaged.soup.vertices.size() - base.soup.vertices.size())};
            CheckedSoup with_hole = check(damaged.soup);
            EXPECT_EQ(lines(with_hole), Lines());

            apply_repairs(checked);
            apply_repairs(with_hole);
            EXPECT_EQ(checked.soup.facets, with_hole.soup.facets);
            EXPECT_LT(enclosed_volume(checked.soup.vertices, checked.soup.facets),
                      enclosed_volume(base.soup.vertices, base.soup.facets));
        }
}

TEST(Defects, NumbersAreThoseOfTheFileWhereEveryFacetHasVerticesOfItsOwn) {
    for (const NamedSoup& shape : shapes())
        for (const Damage& damage : test::all_damages()) {
            SCOPED_TRACE(shape.name + ", " + damage.name);
            std::mt19937 random(3);
            const Soup whole = damage.apply(shape.soup, random).soup;
            Soup separate = whole;
            separate.vertices.clear();
            for (Triangle& t : separate.facets)
                for (std::int32_t& v : t) {
                    separate.vertices.push_back(whole.vertices[v]);
                    v = static_cast<std::int32_t>(separate.vertices.size()) - 1;
                }
            const CheckedSoup checked = check(separate);
            for (const Defect& defect : checked.diagnosis.defects) {
                const std::vector<std::int32_t> vertices = checked.soup.file_vertices(defect.vertices);
                ASSERT_EQ(vertices.size(), defect.vertices.size());
                for (std::size_t i = 0; i < vertices.size(); ++i) {
                    const Vec3 &own = checked.soup.vertices[defect.vertices[i]], &read = separate.vertices[vertices[i]];
                    EXPECT_TRUE(own == read || own.hasNaN());
                }
            }
        }
}

}  // namespace
}  // namespace kerf

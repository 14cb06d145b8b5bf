// Sheets become walls whose volume is that of the area times the thickness.
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "base/geometry/triangle.h"
#include "run/prepare/input.h"
#include "support/shapes.h"
#include "surface/complex/mass_properties.h"
#include "surface/repair/repair.h"

namespace kerf {
namespace {

// (n + 1) (m + 1) vertices at place(u, v), u and v from 0 to 1.
Soup sheet(int n, int m, const std::function<Vec3(double, double)>& place) {
    Soup soup;
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i)
            soup.vertices.push_back(place(static_cast<double>(i) / n, static_cast<double>(j) / m));
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + n + 1;
            soup.facets.push_back({a, a + 1, b + 1});
            soup.facets.push_back({a, b + 1, b});
        }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"sheet"};
    return soup;
}

Soup moebius_strip() {
    const auto place = [](double u, double v) {
        const double angle = 2 * std::numbers::pi * u, across = v - 0.5;
        const double radius = 2 + across * std::cos(angle / 2);
        return Vec3(radius * std::cos(angle), radius * std::sin(angle), across * std::sin(angle / 2));
    };
    Soup soup = sheet(60, 6, place);
    weld_within(soup, 1e-9);
    return soup;
}

// Three half planes that end at one line, or a fin in the middle of a plane that is longer than it.
Soup fins(double longer) {
    const Soup one = sheet(4, 6, [](double u, double v) { return Vec3(u, v, 0); });
    const Soup two = sheet(4, 6, [](double u, double v) { return Vec3(-0.6 * u, v, -0.8 * u); });
    const Soup three = sheet(4, 6, [](double u, double v) { return Vec3(-0.6 * u, v, 0.8 * u); });
    Soup soup = test::join(test::join(one, two), three);
    if (longer > 0) {
        soup = test::join(sheet(8, 6, [](double u, double v) { return Vec3(2 * u - 1, v, 0); }),
                          sheet(4, 4, [](double u, double v) { return Vec3(0, (1 + 4 * v) / 6, u); }));
    }
    weld_exactly(soup);
    return soup;
}

double area(const Soup& soup) {
    double sum = 0;
    for (const Triangle& t : soup.facets) sum += triangle_area(soup.vertices, t);
    return sum;
}

RepairReport thickened(Soup& soup, double thickness) {
    return repair(soup, parse_repair_plan("repair", "thicken=" + std::to_string(thickness)));
}

TEST(RepairThicken, VolumeIsAreaTimesThickness) {
    const auto wave = [](double u, double v) { return Vec3(u, v, 0.2 * std::sin(4 * u) * std::cos(3 * v)); };
    const std::vector<Soup> sheets = {
        sheet(6, 5, [](double u, double v) { return Vec3(u, v, 0); }),
        sheet(20, 20, wave),
        moebius_strip(),
        fins(0),
        fins(1),
        test::join(sheet(8, 8, wave), test::translated(sheet(5, 5, wave), Vec3(3, 0, 0)))};
    for (std::size_t s = 0; s < sheets.size(); ++s)
        for (const double thickness : {0.01, 0.04})
            for (const bool is_mixed : {false, true}) {
                SCOPED_TRACE(std::to_string(s) + ", " + std::to_string(thickness));
                Soup soup = sheets[s];
                std::mt19937 random(7);
                for (Triangle& t : soup.facets)
                    if (is_mixed && random() % 2) std::swap(t[1], t[2]);
                const std::vector<Vec3> before = soup.vertices;
                const RepairReport report = thickened(soup, thickness);
                EXPECT_TRUE(report.changed());
                EXPECT_TRUE(check_soup(soup, {}).diagnosis.clean());
                const double tapers = s == 4 ? 0.01 : 0;  // a fin, where it ends within a plane
                EXPECT_NEAR(enclosed_volume(soup.vertices, soup.facets) / (area(sheets[s]) * thickness), 1,
                            thickness / 2 + tapers);
                for (std::size_t v = 0; v < before.size(); ++v)
                    EXPECT_LE((soup.vertices[v] - before[v]).norm(), report.largest_move() * (1 + 1e-12));
                EXPECT_LE(report.largest_move(), 2 * thickness);
                EXPECT_GE(report.largest_move(), thickness / 2 * (1 - 1e-12));
            }
}

TEST(RepairThicken, BacksAndRimsHavePatchesAndEdgesStaySharp) {
    Soup fold = sheet(8, 8, [](double u, double v) { return u <= 0.5 ? Vec3(u, v, 0) : Vec3(0.5, v, u - 0.5); });
    const std::size_t before = fold.facets.size();
    thickened(fold, 0.1);
    EXPECT_EQ(fold.patch_names, (std::vector<std::string>{"sheet", "sheet_back", "rim"}));
    for (std::size_t f = 0; f < fold.facets.size(); ++f)
        EXPECT_EQ(fold.patch[f], f < before ? 0 : f < 2 * before ? 1 : 2);
    EXPECT_NEAR(enclosed_volume(fold.vertices, fold.facets), 0.1, 1e-12);  // 0.55 by 0.55 without 0.45 by 0.45
    EXPECT_NEAR(box_around(fold.vertices).max().x(), 0.55, 1e-12);
    EXPECT_NEAR(box_around(fold.vertices).min().z(), -0.05, 1e-12);
}

TEST(RepairThicken, ClosedBodiesBesideSheetsStay) {
    const Soup body = test::box(Vec3(5, 5, 5), Vec3(6, 6, 6), 2);
    const Soup plane = sheet(4, 4, [](double u, double v) { return Vec3(u, v, 0); });
    Soup soup = test::join(body, plane);
    thickened(soup, 0.1);
    for (std::size_t f = 0; f < body.facets.size(); ++f) EXPECT_EQ(soup.facets[f], body.facets[f]);
    for (std::size_t v = 0; v < body.vertices.size(); ++v) EXPECT_EQ(soup.vertices[v], body.vertices[v]);
}

// The inner side of a roll that is tighter than half of the thickness turns over: that is told.
TEST(RepairThicken, TooSharpABendIsTold) {
    Soup soup =
        sheet(40, 4, [](double u, double v) { return Vec3(0.04 * std::cos(3 * u), 0.04 * std::sin(3 * u), v); });
    EXPECT_NE(to_text(thickened(soup, 0.1)).find("turned over"), std::string::npos);
    Soup gentle = sheet(40, 4, [](double u, double v) { return Vec3(std::cos(3 * u), std::sin(3 * u), v); });
    EXPECT_EQ(to_text(thickened(gentle, 0.1)).find("turned over"), std::string::npos);
}

}  // namespace
}  // namespace kerf

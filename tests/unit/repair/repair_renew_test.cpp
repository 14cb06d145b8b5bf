// What is small and open beside a body goes before facets are divided; what a surface is made of stays.
#include <utility>

#include <gtest/gtest.h>

#include "support/seeded_numbers.h"
#include "support/shapes.h"
#include "surface/repair/inside/remaining_defects.h"
#include "surface/repair/repair.h"

namespace kerf {
namespace {

// Triangles that hang on nothing, near a unit sphere and across it.
Soup scanned_sphere(int loose, test::SeededNumbers& random) {
    Soup soup = test::icosphere(3);
    for (int i = 0; i < loose; ++i) {
        const auto place = [&] { return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)); };
        const Vec3 centre = 1.02 * place().normalized();
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        for (int corner = 0; corner < 3; ++corner) soup.vertices.push_back(centre + 0.06 * place());
        soup.facets.push_back({first, first + 1, first + 2});
        soup.patch.push_back(soup.patch.front());
    }
    return soup;
}

TEST(Renewal, LooseTrianglesAcrossASphereGoAndLeaveItAsItWas) {
    const Soup sphere = test::icosphere(3);
    test::SeededNumbers random(7);
    for (const int loose : {1, 10}) {
        Soup soup = scanned_sphere(loose, random);
        repair(soup, plan_of(RepairLevel::full));
        EXPECT_TRUE(find_remaining_defects(soup, 500).empty()) << loose;
        EXPECT_EQ(soup.facets, sphere.facets) << loose;
        EXPECT_EQ(soup.vertices, sphere.vertices) << loose;
    }
}

TEST(Renewal, OpenPiecesThatAreTheSurfaceStay) {
    Soup soup;
    for (int i = 0; i < 300; ++i) {
        const auto first = static_cast<std::int32_t>(soup.vertices.size());
        for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
            soup.vertices.emplace_back(x, y, 3.0 * i);
        soup.facets.push_back({first, first + 1, first + 2});
        soup.facets.push_back({first, first + 2, first + 3});
    }
    soup.patch.assign(soup.facets.size(), 0);
    soup.patch_names = {"squares"};
    const Soup before = soup;
    repair(soup, plan_of(RepairLevel::full));
    EXPECT_EQ(soup.facets, before.facets);
    EXPECT_EQ(soup.vertices, before.vertices);
}

}  // namespace
}  // namespace kerf

#include "surface/complex/solid_properties.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace kerf {
namespace {

SolidProperties solid_of(const Soup& soup) { return solid_properties(Complex(test::to_surface(soup))); }

TEST(SolidProperties, OfABoxAreThoseOfTextbooks) {
    for (const double far : {0.0, 1e5}) {
        const Vec3 low(1 + far, 2, 3), size(6, 2, 3);
        const SolidProperties box = solid_of(test::box(low, low + size, {6, 2, 3}));
        EXPECT_NEAR(box.volume, 36, 1e-9);
        EXPECT_LE((box.centroid - low - size / 2).norm(), 1e-9);
        EXPECT_LE((box.principal.moments - Vec3(39, 120, 135)).norm(), 1e-7);  // 36 / 12 (4 + 9), ...
        EXPECT_EQ(box.principal.axes, (Eigen::Matrix3d() << 1, 0, 0, 0, 0, 1, 0, 1, 0).finished());
    }
}

TEST(SolidProperties, DoNotDependOnTheTriangulationButOnVoids) {
    const SolidProperties coarse = solid_of(test::box()), fine = solid_of(test::box(Vec3::Zero(), Vec3::Ones(), 5));
    EXPECT_LE((coarse.inertia - fine.inertia).norm(), 1e-12);
    const SolidProperties hollow = solid_of(test::nested_boxes(2, 2));  // of side 3, without one of side 1
    EXPECT_NEAR(hollow.inertia(0, 0), (243. - 1) / 6, 1e-9);
}

}  // namespace
}  // namespace kerf

// Solids that touch are found by coarse facets, and those that are near each other are not.
#include "files/cad/inside/contact.h"

#include <optional>

#include <gtest/gtest.h>

#include "cad/cad_files.h"
#include "files/cad/cad_import.h"
#include "files/io/file_bytes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

std::optional<cad::Contact> contact_of(const std::vector<test::CadShape>& shapes) {
    silence_occt();
    const test::TemporaryFolder folder;
    test::write_cad(folder.file("all.brep"), test::together(shapes));
    const cad::Model model = cad::read_model(read_file(folder.file("all.brep")), "all.brep");
    EXPECT_EQ(model.bodies.size(), shapes.size());
    return cad::find_contact(model.bodies);
}

test::CadShape plate_with_hole(double radius) {
    return test::cut(test::box({-3, -3, 0}, {6, 6, 1}), test::cylinder(radius, 1));
}

TEST(Contact, IsFoundWhereSolidsTouchOrOverlap) {
    const test::CadShape bar = test::box({0, 0, 0}, {10, 1, 1});
    EXPECT_TRUE(contact_of({bar, test::box({4, 0, 1}, {1, 1, 1})})) << "face on face";
    EXPECT_TRUE(contact_of({bar, test::box({4, -4, 1}, {1, 9, 1})})) << "crossed bars, no corner of one on the other";
    EXPECT_TRUE(contact_of({bar, test::box({4, -4, 0.5}, {1, 9, 1})})) << "crossed bars, one through the other";
    EXPECT_TRUE(contact_of({test::sphere(2), test::cut(test::sphere(3), test::sphere(2))})) << "a ball in its shell";
    EXPECT_TRUE(contact_of({plate_with_hole(1), test::cylinder(1, 1)})) << "a pin that fills its hole";
    const std::optional<cad::Contact> third =
        contact_of({test::moved(bar, {0, 0, 9}), bar, test::box({4, 0, 1}, {1, 1, 1})});
    ASSERT_TRUE(third);
    EXPECT_EQ(third->bodies, (std::array<std::size_t, 2>{1, 2}));
    EXPECT_NEAR(third->where.z(), 1, 1e-9);
}

TEST(Contact, IsNotFoundWhereSolidsAreNear) {
    const test::CadShape box = test::box({0, 0, 0}, {1, 1, 1});
    EXPECT_FALSE(contact_of({box}));
    EXPECT_FALSE(contact_of({box, test::box({1 + 1e-5, 0, 0}, {1, 1, 1})}));
    EXPECT_FALSE(contact_of({test::sphere(2), test::cut(test::sphere(3), test::sphere(2.001))}));
    EXPECT_FALSE(contact_of({plate_with_hole(1.001), test::cylinder(1, 1)})) << "flush, with coarse facets that meet";
    EXPECT_FALSE(contact_of({test::hollow_cube(4, 2), test::moved(box, {1.5, 1.5, 1.5})}));
}

}  // namespace
}  // namespace kerf

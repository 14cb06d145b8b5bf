#include "run/prepare/inside/repair_measures.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "run/prepare/remedy.h"
#include "support/damage.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"
#include "support/write_off.h"

namespace kerf {
namespace {

// Proven bounds lie within a fourth of what there is.
void expect_bound(double bound, double distance) {
    EXPECT_GE(bound, distance * (1 - 1e-9));
    EXPECT_LE(bound, 1.25 * distance * (1 + 1e-9));
}

TEST(RepairMeasures, WhatIsTheSameIsNeitherChangedNorFar) {
    for (const Soup& soup : {test::box(), test::icosphere(3), test::torus(5, 1, 9, 6)}) {
        Soup turned = soup;
        for (Triangle& t : turned.facets) std::swap(t[0], t[1]);
        for (const Soup& after : {soup, turned}) {
            const RepairMeasures measures = measure_repair(soup, after);
            EXPECT_EQ(measures.changed_facets + measures.added_facets + measures.lost_facets, 0);
            EXPECT_EQ(measures.distance_of_changed, 0);
            EXPECT_EQ(measures.before.area, measures.after.area);
            EXPECT_NEAR(std::abs(*measures.after.volume), std::abs(*measures.before.volume), 1e-12);
        }
    }
}

TEST(RepairMeasures, AMovedVertexIsAsFarAsItWasMovedOutwardsAtAnyScale) {
    for (const double scale : {1e-6, 1.0, 1e7}) {
        Soup before = test::box(), after = before;
        for (Vec3& p : after.vertices)
            if (p == Vec3(1, 1, 1)) p += Vec3::Constant(0.01);
        kerf::scale(before, scale);
        kerf::scale(after, scale);
        const RepairMeasures measures = measure_repair(before, after);
        expect_bound(measures.distance_of_changed, 0.01 * std::sqrt(3) * scale);
        EXPECT_GE(measures.changed_facets, 3);
        EXPECT_EQ(measures.changed_facets, measures.lost_facets);
        EXPECT_EQ(measures.added_facets, 0);
    }
}

TEST(RepairMeasures, AFillingIsToldApartWithItsDistance) {
    const Soup whole = test::box();
    Soup open = whole;
    test::remove_facet(open, 0);
    open.vertex_number.clear();
    Soup filled = open;
    test::insert_facet(filled, static_cast<std::int32_t>(filled.facets.size()), whole.facets[0]);
    const RepairMeasures measures = measure_repair(open, filled);
    EXPECT_FALSE(measures.before.volume);
    EXPECT_NEAR(*measures.after.volume, 1, 1e-12);
    EXPECT_EQ(measures.added_facets, 1);
    EXPECT_EQ(measures.changed_facets + measures.lost_facets, 0);
    expect_bound(measures.distance_of_added, 1 - std::sqrt(0.5));  // the inscribed circle of half of a side
    EXPECT_EQ(measures.distance_of_changed, 0);
}

TEST(RepairMeasures, FacetsThatCollapsedOpenNothing) {
    Soup soup = test::box();
    test::insert_facet(soup, static_cast<std::int32_t>(soup.facets.size()), {0, 0, 1});
    EXPECT_NEAR(*measure_soup(soup).volume, 1, 1e-12);
}

TEST(RepairMeasures, WhatIsNotFiniteDoesNotCount) {
    Soup before = test::box();
    before.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
    const RepairMeasures measures = measure_repair(before, test::box());
    EXPECT_FALSE(measures.before.volume);
    EXPECT_TRUE(std::isfinite(measures.before.area));
    EXPECT_GT(measures.changed_facets, 0);
    EXPECT_EQ(measure_repair({}, test::box()).after.facets, 12);
}

// A cylinder without its ends, or the ends alone.
Soup part_of_cylinder(bool ends) {
    Soup soup = test::twisted_cylinder(16, 5, 1, 4, 0);
    std::erase_if(soup.facets, [&](const Triangle& t) {
        const auto z = [&](int i) { return soup.vertices[t[i]].z(); };
        return (z(0) == z(1) && z(1) == z(2)) != ends;
    });
    soup.patch.assign(soup.facets.size(), 0);
    return soup;
}
Soup tube() { return part_of_cylinder(false); }

class Remedies : public testing::Test {
 protected:
    std::optional<Remedy> find(const Soup& soup, const InputOptions& options = {}) const {
        const std::string path = folder_.file("bad.off");
        test::write_off(path, soup.vertices, soup.facets);
        const CheckedSoup checked = check_input(path, options);
        EXPECT_FALSE(checked.diagnosis.clean());
        return find_remedy(path, options, checked);
    }
    Remedy remedy(const Soup& soup, const InputOptions& options = {}) const { return find(soup, options).value(); }

    test::TemporaryFolder folder_;
};

TEST_F(Remedies, ALevelIsTriedBeforeItIsTold) {
    const Remedy found = remedy(test::cracked(test::box(), 1e-8, 1));
    EXPECT_EQ(found.options.repairs.plan, "near");
    EXPECT_TRUE(found.was_tried);
    EXPECT_LE(found.largest_move, 1e-3 * std::sqrt(3.0));
}

TEST_F(Remedies, WhatWasAskedForAlreadyIsNotTold) {
    InputOptions options;
    options.repairs.plan = "full,no-weld,no-stitch,no-holes,no-intersections,no-manifold";
    EXPECT_FALSE(remedy(test::cracked(test::box(), 1e-8, 1), options).options.wrap);
    options.repairs.plan = "full,weld=1e-12,stitch=1e-12,holes=3";
    EXPECT_TRUE(remedy(test::cracked(test::box(), 1e-4, 1), options).options.wrap);
}

// To unite it with what is around it deletes it: that it is a void comes first, and what would go is told.
TEST_F(Remedies, AShellWithinAnotherIsAVoidBeforeItIsDeleted) {
    const Soup nested = test::join(test::box(Vec3::Zero(), Vec3::Constant(3), 1), test::box(Vec3::Ones(), {2, 2, 2}));
    const Remedy found = remedy(nested);
    EXPECT_EQ(found.options.voids, Voids::parity);
    EXPECT_EQ(found.options.repairs.plan, "exact");
    EXPECT_TRUE(found.losses.empty());

    // What crosses the outer one as well is united; then the other goes, which parity alone would keep.
    InputOptions options;
    options.repairs.plan = "exact";
    const Soup crossed = test::join(nested, test::box(Vec3(2.5, 0.5, 0.5), Vec3(3.5, 0.9, 0.9)));
    options.voids = Voids::parity;
    EXPECT_TRUE(remedy(crossed, options).losses.empty());
}

TEST_F(Remedies, BodiesOfSeveralFilesStayRegions) {
    const std::string one = folder_.file("one.off"), other = folder_.file("other.off");
    test::write_off(one, test::box().vertices, test::box().facets);
    for (const double gap : {-1e-4, -0.5}) {
        const Soup second = test::box(Vec3(1 + gap, 0, 0), Vec3(2, 1, 1));
        test::write_off(other, second.vertices, second.facets);
        InputOptions options;
        options.more_files = {other};
        const Remedy found = find_remedy(one, options, check_input(one, options)).value();
        EXPECT_EQ(found.options.more_files, options.more_files);
        EXPECT_EQ(check_input(one, found.options).soup.region_names, (std::vector<std::string>{"one", "other"})) << gap;
    }
}

TEST_F(Remedies, FilesOfOneBodyAreNoRegions) {
    const std::string wall = folder_.file("wall.off"), lids = folder_.file("lids.off");
    Soup ends = part_of_cylinder(true);
    for (Vec3& p : ends.vertices) p.z() *= 1 + 1e-9;
    test::write_off(wall, tube().vertices, tube().facets);
    test::write_off(lids, ends.vertices, ends.facets);
    InputOptions options;
    options.more_files = {lids};
    EXPECT_EQ(find_remedy(wall, options, check_input(wall, options)).value().options.repairs.plan, "near");
}

TEST_F(Remedies, EndsGetPatchesOfTheirOwnAndHolesAreFilled) {
    const Remedy ends = remedy(tube());
    EXPECT_EQ(ends.caps, 2);
    EXPECT_EQ(check_soup(tube(), ends.options).soup.patch_names,
              (std::vector<std::string>{"cylinder", "cap_1", "cap_2"}));
    Soup holed = tube();
    holed.facets.erase(holed.facets.begin() + static_cast<std::ptrdiff_t>(holed.facets.size() / 2));
    holed.patch.pop_back();
    EXPECT_EQ(remedy(holed).caps, 2) << "the hole is filled";
    holed = test::twisted_cylinder(16, 5, 1, 4, 0);
    holed.facets.pop_back();
    holed.patch.pop_back();
    EXPECT_EQ(remedy(holed).caps, 0) << "of three edges";
    EXPECT_FALSE(remedy(holed).options.repairs.cap);
}

// Nothing but the caps is tried of so many facets.
TEST_F(Remedies, CapsOfLargeSurfacesAreOffered) {
    const Soup large = test::join(tube(), test::box(Vec3(10, 0, 0), Vec3(11, 1, 1), 130));
    ASSERT_GT(large.facets.size(), most_tried);
    const Remedy found = remedy(large);
    EXPECT_FALSE(found.was_tried);
    EXPECT_EQ(found.options.repairs.plan, "near");
    EXPECT_EQ(found.caps, 2);
}

TEST_F(Remedies, NothingIsToldOfNumbersThatAreTooLarge) {
    Soup soup = test::box();
    soup.vertices.front() *= 1e300;
    soup.vertices.back() *= 1e300;
    EXPECT_FALSE(find(soup));
}

}  // namespace
}  // namespace kerf

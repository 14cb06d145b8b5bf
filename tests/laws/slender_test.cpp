// Bodies that are thin for their length hold what their file holds, by default, once they are remeshed.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/geometry/box.h"
#include "run/prepare/remeshing.h"
#include "support/shapes.h"

namespace kerf {
namespace {

Input input_of(const Soup& soup) {
    Input input;
    input.complex = Complex(test::to_surface(soup));
    measure_input(input);
    input.diagonal = box_around(input.complex.arrays().vertices).diagonal().norm();
    input.patch_names = soup.patch_names;
    return input;
}

// Integrals of x^2, y^2 and z^2 over the body, about the middle of its box.
Vec3 second_moments(const Input& input) {
    const SurfaceArrays surface = input.complex.arrays();
    const Vec3 middle = box_around(surface.vertices).center();
    Vec3 moments = Vec3::Zero();
    for (const Triangle& t : surface.facets) {
        const Vec3 a = surface.vertices[t[0]] - middle, b = surface.vertices[t[1]] - middle,
                   c = surface.vertices[t[2]] - middle;
        const Vec3 squares = a.cwiseAbs2() + b.cwiseAbs2() + c.cwiseAbs2() + (a + b + c).cwiseAbs2();
        moments += a.dot(b.cross(c)) / 120 * squares;
    }
    return moments;
}

struct SlenderBody {
    std::string name;
    Soup soup;
};

std::vector<SlenderBody> slender_bodies() {
    std::vector<SlenderBody> bodies;
    for (const double ratio : {3., 10., 30., 100.}) {
        for (const int sides : {5, 12, 48})
            bodies.push_back({"rod of " + std::to_string(sides) + " sides, length to width " + std::to_string(ratio),
                              test::prism(sides, 0.5, ratio)});
        bodies.push_back(
            {"bar, length to width " + std::to_string(ratio), test::box(Vec3::Zero(), Vec3(1, 0.5, ratio), 1)});
        bodies.push_back(
            {"plate, width to thickness " + std::to_string(ratio), test::box(Vec3::Zero(), Vec3(ratio, ratio, 1), 1)});
        bodies.push_back({"disc, diameter to thickness " + std::to_string(ratio), test::prism(48, ratio / 2, 1)});
    }
    return bodies;
}

TEST(SlenderBodies, HoldTheVolumeAndTheSecondMomentsOfTheirFile) {
    RunRequest options;
    options.remeshing = Remeshing::always;
    for (const SlenderBody& body : slender_bodies()) {
        const Input before = input_of(body.soup), after = remesh_where_asked(before, options);
        ASSERT_TRUE(after.remeshed) << body.name;
        EXPECT_EQ(after.remeshed->volumes_before, std::vector{before.volume});
        EXPECT_NEAR(after.volume / before.volume, 1, 1e-4) << body.name;
        const Vec3 ratios = second_moments(after).cwiseQuotient(second_moments(before));
        EXPECT_LE((ratios - Vec3::Ones()).cwiseAbs().maxCoeff(), 0.01) << body.name << ": " << ratios.transpose();
        EXPECT_EQ(count_changed_volumes(after), 0);
    }
}

TEST(SlenderBodies, MayChangeWhereADeviationIsAskedFor) {
    RunRequest options;
    options.remeshing = Remeshing::always;
    options.deviation = 0.4;
    Input after = remesh_where_asked(input_of(test::prism(48, 0.5, 30)), options);
    ASSERT_TRUE(after.remeshed);
    EXPECT_TRUE(after.remeshed->may_change_volume);
    after.volume *= 0.9;
    EXPECT_EQ(count_changed_volumes(after), 0);
    after.remeshed->may_change_volume = false;
    EXPECT_EQ(count_changed_volumes(after), 1);
}

}  // namespace
}  // namespace kerf

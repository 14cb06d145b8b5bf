// From what a user writes to the field over a surface.
#include "surface/size/size_options.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/size_fields.h"
#include "surface/size/inside/surface_sizes.h"
#include "surface/size/volume_samples.h"

namespace kerf {
namespace {

using namespace test;

SizeField field_of(const SizeOptions& options, const Soup& soup) {
    options.check();
    return make_size_field(options, to_arrays(soup), soup.patch_names);
}

std::string complaint(const SizeOptions& options) {
    try {
        options.check();
        return "";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        return error.what();
    }
}

TEST(SizeOptions, BadTextsAreRefusedWithTheRightForm) {
    for (const char* text :
         {"box:1,2=3", "box:1,2,3,4,5,6", "box:1,2,3,4,5,6=0", "box:1,2,3,4,5,6=-1", "box:1,2,3,4,5,x=1", "", "=",
          "sphere:0,0,0,0=1", "sphere:0,0,0,-1=1", "sphere:0,0,0,1=nan", "sphere:0,0,0,inf=1", "sphere:0,0,0,1=1e-200",
          "cylinder:0,0,0,0,0,0,1=1", "cone:0,0,0,1=1", "sphere:0,0,0,1,=1", "sphere0,0,0,1=1"}) {
        SizeOptions options;
        options.inside = {"sphere:0,0,0,1=0.1", text};
        const std::string words = complaint(options);
        EXPECT_NE(words.find("--size-in"), std::string::npos) << text;
        EXPECT_NE(words.find("sphere:x,y,z,r=H"), std::string::npos) << words;
    }
    for (const char* text : {"inlet", "inlet=", "=1", "inlet=0", "inlet=1x", ""}) {
        SizeOptions on, near;
        on.on = near.near = {text};
        EXPECT_NE(complaint(on).find("NAME=H"), std::string::npos) << text;
        EXPECT_NE(complaint(near).find("NAME=H:D"), std::string::npos) << text;
    }
    for (const char* text : {"inlet=1", "inlet=1:", "inlet=1:-2", "inlet=:2", "inlet=1:2:x"}) {
        SizeOptions near;
        near.near = {text};
        EXPECT_NE(complaint(near).find("NAME=H:D"), std::string::npos) << text;
    }
    for (const double bad : {-1.0, std::nan(""), 1e9}) {
        SizeOptions growth, across, turn;
        growth.growth = across.cells_across = turn.segments_per_turn = bad;
        EXPECT_NE(complaint(growth).find("--growth"), std::string::npos);
        EXPECT_NE(complaint(across).find("--cells-across"), std::string::npos);
        EXPECT_NE(complaint(turn).find("--segments-per-turn"), std::string::npos);
    }
}

TEST(SizeOptions, SolidsAreWhereTheyAreSaidToBe) {
    SizeOptions options;
    options.size = 1;
    options.inside = {"box:1,1,1,0,0,0=0.5", "sphere:10,0,0,2=0.25", "cylinder:20,0,0,20,0,5,1=0.125"};
    const SizeField field = field_of(options, box());
    EXPECT_EQ(field.at(Vec3(0.5, 0.5, 0.5)), 0.5);
    EXPECT_EQ(field.at(Vec3(11, 1, 0)), 0.25);
    EXPECT_EQ(field.at(Vec3(20, 0.5, 3)), 0.125);
    EXPECT_NEAR(field.at(Vec3(20, 0, 6)), 0.125 + 0.3, 1e-12);
    EXPECT_NEAR(field.at(Vec3(100, 100, 100)), 1, 1e-12);
    EXPECT_EQ(field.smallest(), 0.125);
}

// A box whose facets at x = 0 are a patch of their own.
Soup box_with_inlet(const Vec3& size, int n) {
    Soup soup = box(Vec3::Zero(), size, n);
    soup.patch_names = {"walls", "in=let"};
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const Triangle& t = soup.facets[f];
        soup.patch[f] = soup.vertices[t[0]].x() + soup.vertices[t[1]].x() + soup.vertices[t[2]].x() == 0;
    }
    return soup;
}

TEST(SizeOptions, PatchesAreFoundByName) {
    const Soup soup = box_with_inlet(Vec3(10, 2, 2), 2);
    SizeOptions on, near, unknown;
    on.on = {"in=let=0.1"};
    near.near = {"in=let=0.1:3"};
    const SizeField field = field_of(on, soup), far = field_of(near, soup);
    for (const double x : {0.0, 1.0, 3.0, 7.0}) {
        EXPECT_NEAR(field.at(Vec3(x, 1, 1)), 0.1 + 0.3 * x, 1e-12);
        EXPECT_NEAR(far.at(Vec3(x, 1, 1)), 0.1 + 0.3 * std::max(0.0, x - 3), 1e-12);
    }
    unknown.on = {"outlet=0.1"};
    try {
        field_of(unknown, soup);
        ADD_FAILURE() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::usage);
        for (const char* word : {"--size-on", "outlet", "walls", "in=let"})
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

TEST(SizeOptions, GrowthBeginsAtTheEdgesOfTheSurface) {
    SizeOptions options;
    options.growth = 0.5;
    const SizeField field = field_of(options, box(Vec3::Zero(), Vec3(8, 8, 8), 8));
    const double edge = (2 + std::sqrt(2.0)) / 3;
    EXPECT_NEAR(field.at(Vec3(3.3, 4.4, 0)), edge, 1e-12);
    EXPECT_NEAR(field.at(Vec3(4, 4, 4)), edge + 2, 1e-12);
}

TEST(SizeOptions, CurvatureOfSpheresAndCylinders) {
    for (const double radius : {0.01, 1.0, 50.0}) {
        SizeOptions chord, turn;
        chord.chord_error = 0.001 * radius;
        turn.segments_per_turn = 36;
        const double by_chord = std::sqrt(8 * 0.001) * radius, by_turn = 2 * std::numbers::pi * radius / 36;
        const Soup sphere = icosphere(3, radius), tube = twisted_cylinder(48, 20, radius, 10 * radius, 0);
        const Vec3 on_sphere = Vec3(1, 2, 3).normalized() * radius, on_tube(0, radius, 0);
        for (const auto& [soup, p] : {std::pair(&sphere, on_sphere), {&tube, on_tube}}) {
            EXPECT_NEAR(field_of(chord, *soup).at(p) / by_chord, 1, 0.1);
            EXPECT_NEAR(field_of(turn, *soup).at(p) / by_turn, 1, 0.1);
        }
    }
    SizeOptions turn;
    turn.segments_per_turn = 36;
    EXPECT_TRUE(field_of(turn, box()).is_empty()) << "flat facets and sharp edges are no curvature";
}

TEST(SizeOptions, ThinWallsGetTheirCells) {
    SizeOptions options;
    options.cells_across = 4;
    const SizeField plate = field_of(options, box(Vec3::Zero(), Vec3(20, 20, 2), 6));
    EXPECT_NEAR(plate.at(Vec3(10, 10, 0)), 0.5, 1e-9);
    EXPECT_NEAR(plate.at(Vec3(10, 10, 1)), 0.5 + 0.3, 1e-9);
    const SizeField shell = field_of(options, nested_boxes(2, 5));  // of edges 3 and 1
    EXPECT_NEAR(shell.at(Vec3(-1.5, 0.1, 0.1)), 0.25, 1e-9);
}

// Against the integral over a fine grid.
TEST(VolumeSamples, AddUpToTheIntegral) {
    SizeOptions far, tiny, patch;
    far.size = tiny.size = patch.size = 1;
    far.inside = {"sphere:3,3,3,1.5=0.2"};
    tiny.inside = {"sphere:1.1,2.2,3.3,0.05=0.01"};
    patch.on = {"in=let=0.1"};
    const Soup soup = box_with_inlet(Vec3(10, 6, 6), 4);
    for (const SizeOptions& options : {far, tiny, patch}) {
        const SizeField field = field_of(options, soup);
        constexpr int n = 120;
        const Vec3 step = Vec3(10, 6, 6) / n;
        double integral = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
                for (int k = 0; k < n; ++k)
                    integral += step.prod() * field.reference_volume() /
                                field.max_volume_at(Vec3(i + 0.5, j + 0.5, k + 0.5).cwiseProduct(step));
        const SurfaceArrays arrays = to_arrays(soup);
        EXPECT_NEAR(sized_volume(field, arrays.vertices, arrays.facets, 360) / integral, 1, 0.05);
    }
    const SurfaceArrays arrays = to_arrays(soup);
    EXPECT_EQ(sized_volume(SizeField(0.1), arrays.vertices, arrays.facets, 360), 360);
}

TEST(VolumeSamples, KnowTheInsideOfVoidsAndThinBodies) {
    SizeOptions nearly_constant;
    nearly_constant.size = 1;
    nearly_constant.inside = {"sphere:0,0,0,100=0.999"};
    for (const auto& [soup, volume, tolerance] : {std::tuple(nested_boxes(2, 5), 26.0, 0.03),
                                                  {torus(3, 1, 60, 30), 59.0, 0.03},
                                                  {box(Vec3::Zero(), Vec3(10, 10, 1e-3), 5), 0.1, 1e-6},
                                                  {icosphere(3, 1e-3), 4.1e-9, 0.03}}) {
        const SurfaceArrays arrays = to_arrays(soup);
        const SizeField field = field_of(nearly_constant, soup);
        EXPECT_NEAR(sized_volume(field, arrays.vertices, arrays.facets, 0) / volume, 1, tolerance) << volume;
        for (const VolumeSample& sample : sample_volume(field, arrays.vertices, arrays.facets))
            ASSERT_GT(sample.sized_volume, 0);
    }
    const auto samples_of = [&](const Soup& soup) {
        const SurfaceArrays arrays = to_arrays(soup);
        return sample_volume(field_of(nearly_constant, soup), arrays.vertices, arrays.facets);
    };
    for (const VolumeSample& sample : samples_of(nested_boxes(2, 5)))
        ASSERT_GE(sample.point.cwiseAbs().maxCoeff(), 0.5) << "in the void";
    for (const VolumeSample& sample : samples_of(torus(3, 1, 60, 30)))
        ASSERT_LE(std::hypot(std::hypot(sample.point.x(), sample.point.y()) - 3, sample.point.z()), 1);
}

}  // namespace
}  // namespace kerf

// The air in a box around bodies. The oracle: boxes of whole numbers, whose volumes in the box are known, and which
// meet its faces in every way, coplanar ones included.
#include "surface/enclosure/enclosure.h"

#include <algorithm>
#include <random>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "support/shapes.h"
#include "surface/complex/complex.h"
#include "surface/complex/mass_properties.h"
#include "surface/diagnosis/diagnosis.h"

namespace kerf {
namespace {

double volume_of(const Soup& soup) { return enclosed_volume(soup.vertices, soup.facets); }

std::set<std::string> names_of(const Soup& soup) {
    std::set<std::string> names;
    for (const std::int32_t patch : soup.patch) names.insert(soup.patch_names[patch]);
    return names;
}

EnclosureOptions asked(const std::string& box, const std::string& ground = "", Wind wind = Wind::plus_x) {
    EnclosureOptions options;
    options.box = box;
    options.ground = ground;
    options.wind = wind;
    return options;
}

// The box of a text around a body, and the air in it.
struct Air {
    Soup soup;
    Enclosure enclosure;
};

Air air_around(Soup body, const EnclosureOptions& options, bool keeps_bodies = false) {
    Air air{std::move(body), {}};
    air.enclosure = enclosure_around(box_around(air.soup.vertices), options);
    enclose(air.soup, air.enclosure, keeps_bodies);
    return air;
}

std::string text_of(const Box& box) {
    return fmt::format("{},{}", fmt::join(box.min(), ","), fmt::join(box.max(), ","));
}

// Every facet of a face lies in it, exactly.
void expect_flat_faces(const Air& air) {
    for (std::size_t f = 0; f < air.soup.facets.size(); ++f)
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t end = 0; end < 2; ++end) {
                if (air.soup.patch_names[air.soup.patch[f]] != air.enclosure.face_names[axis][end]) continue;
                const double at = end == 0 ? air.enclosure.box.min()[axis] : air.enclosure.box.max()[axis];
                for (const std::int32_t v : air.soup.facets[f]) ASSERT_EQ(air.soup.vertices[v][axis], at);
            }
}

TEST(Enclosure, BoxesThatTheBoxCutsLeaveTheRestOfIt) {
    for (unsigned seed = 0; seed < 24; ++seed) {
        std::mt19937 random(seed);
        const auto whole = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
        const Box box(Vec3(-3 - whole(0, 1) * 0.5, -3, -3), Vec3(3, 3, 3 + whole(0, 1) * 0.5));
        Soup bodies;
        double in_box = 0;
        for (int i = 0; i < 3; ++i) {  // in columns of their own, so that they never touch
            const double left = -4 + 3 * i;
            const Vec3 low(left + whole(0, 1) * 0.5, whole(-5, 1), whole(-5, 1));
            const Box own(low, Vec3(left + 1 + whole(0, 2) * 0.5, low.y() + whole(1, 4), low.z() + whole(1, 4)));
            bodies = i == 0 ? test::box(own.min(), own.max(), 1 + whole(0, 2))
                            : test::join(bodies, test::box(own.min(), own.max(), 1 + whole(0, 2)));
            const Box inner = own.intersection(box);
            if (!inner.isEmpty()) in_box += inner.volume();
        }
        SCOPED_TRACE(fmt::format("seed {}", seed));
        if (in_box == 0) continue;
        EnclosureOptions options = asked(text_of(box));
        options.edge = 0.5 + whole(0, 3);
        const Air air = air_around(bodies, options);
        EXPECT_NEAR(volume_of(air.soup), box.volume() - in_box, 1e-9);
        EXPECT_NEAR(air.enclosure.body_volume, in_box, 1e-9);
        const Diagnosis diagnosis = diagnose(air.soup);
        EXPECT_TRUE(diagnosis.clean()) << diagnosis.summary(air.soup);
        EXPECT_TRUE(air.soup.sides.empty());
        expect_flat_faces(air);
    }
}

TEST(Enclosure, FacesAreNamedByTheWindAndTheGround) {
    const Soup ball = test::icosphere(2);
    const std::set<std::string> sides = {"side_y_min", "side_y_max", "side_z_min", "side_z_max"};
    const Air across = air_around(ball, {.box = "2,1,4"});
    std::set<std::string> expected = sides;
    expected.insert({"inlet", "outlet", ball.patch_names[0]});
    EXPECT_EQ(names_of(across.soup), expected);
    EXPECT_EQ(across.enclosure.box.min(), Vec3(across.enclosure.bodies.min() - Vec3(4, 2, 2)));
    EXPECT_EQ(across.enclosure.face_names[0][0], "inlet");
    EXPECT_NEAR(volume_of(across.soup), across.enclosure.box.volume() - volume_of(ball), 1e-9);

    const Air back = air_around(ball, asked("2,1,4", "-0.5", Wind::minus_y));
    EXPECT_EQ(back.enclosure.face_names[1][0], "outlet");
    EXPECT_EQ(back.enclosure.face_names[1][1], "inlet");
    EXPECT_EQ(back.enclosure.face_names[2][0], "ground");
    EXPECT_EQ(back.enclosure.box.min().z(), -0.5);
    EXPECT_TRUE(diagnose(back.soup).clean());
    ASSERT_FALSE(back.soup.notes.empty());
    EXPECT_NE(back.soup.notes.back().find("cut off"), std::string::npos);

    Soup inlet = ball;
    inlet.patch_names = {"inlet"};
    EXPECT_TRUE(names_of(air_around(inlet, {.box = "1,1,1"}).soup).contains("body_inlet"));
    inlet.patch_names = {"surface"};
    EXPECT_TRUE(names_of(air_around(inlet, {.box = "1,1,1"}).soup).contains("body"));
}

TEST(Enclosure, AirThatIsClosedOffIsLeftOutAndSaid) {
    const Soup hollow = test::join(test::icosphere(2, 2), test::inside_out(test::icosphere(2, 1)));
    const Air air = air_around(hollow, {.box = "1,1,1"});
    EXPECT_NEAR(air.enclosure.body_volume, volume_of(test::icosphere(2, 2)), 1e-9);
    ASSERT_FALSE(air.soup.notes.empty());
    EXPECT_NE(air.soup.notes.back().find("closed off"), std::string::npos) << air.soup.notes.back();
}

TEST(Enclosure, BodiesMayStayAsRegions) {
    Air air = air_around(test::icosphere(2), asked("1,1,1", "0"), true);
    ASSERT_EQ(air.soup.region_names, (std::vector<std::string>{"air", "body"}));
    EXPECT_TRUE(diagnose(air.soup).clean());
    const Complex complex(test::to_arrays(air.soup), air.soup.sides, air.soup.region_names);
    double all = 0;
    for (const RegionIndex r : ids<RegionIndex>(complex.region_count())) {
        const SurfaceArrays own = complex.arrays_of(r);
        all += enclosed_volume(own.vertices, own.facets);
    }
    EXPECT_NEAR(all, air.enclosure.box.volume(), 1e-9);
}

TEST(Enclosure, TheWakeLiesBehindTheBody) {
    EnclosureOptions options = asked("1,1,1", "", Wind::minus_x);
    options.wake = Length::percent(1);
    const Enclosure placed = enclosure_around(Box(Vec3(0, 0, 0), Vec3(4, 2, 1)), options);
    ASSERT_TRUE(placed.wake);
    EXPECT_EQ(placed.wake->max().x(), 2);
    EXPECT_EQ(placed.wake->min().x(), -4) << "the end of the box";
    EXPECT_EQ(placed.wake->max().y(), 2.5);
    EXPECT_DOUBLE_EQ(placed.wake_edge, std::sqrt(21.0) / 100);
}

TEST(Enclosure, SaysWhatIsWrong) {
    const auto refusal = [](const EnclosureOptions& options) -> std::string {
        try {
            options.check();
            air_around(test::icosphere(2), options);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            return error.what();
        }
        return "accepted";
    };
    const auto expect = [&](const EnclosureOptions& options, const std::string& words) {
        const std::string said = refusal(options);
        EXPECT_NE(said.find(words), std::string::npos) << "'" << words << "' in: " << said;
    };
    expect({.box = "1,2"}, "--box is '1,2', but it must be");
    expect({.box = "1,-2,3"}, "--box");
    expect({.box = "1,x,3"}, "--box");
    expect({.box = "5,5,5,6,6,6"}, "There is no body in the box");
    expect({.box = "-0.1,-0.1,-0.1,0.1,0.1,0.1"}, "There is no air in the box");
    expect({.box = "0,0,0,0,1,1"}, "no volume");
    expect(asked("1,1,1", "9"), "no volume");
    expect(asked("1,1,1", "low"), "--ground is 'low', but it must be");
    expect(asked("1,1,1", "x=0"), "the wind blows along that axis");
    EnclosureOptions fine = asked("1,1,1");
    fine.edge = 1e-6;
    expect(fine, "larger --box-size");
    expect(asked("", "0"), "--ground is for a box of air");
    EnclosureOptions wake;
    wake.wake = 1;
    expect(wake, "--wake is for a box of air");
    expect(asked("", "", Wind::plus_z), "--wind is for a box of air");
    expect({.box = "9,9,0,8,8,1,7"}, "--box");
}

}  // namespace
}  // namespace kerf

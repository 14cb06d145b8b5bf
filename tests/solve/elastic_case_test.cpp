// Case files: what is understood, and that everything else is refused with its line.
#include "solve/case/elastic_case.h"

#include <fstream>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/multigrid/node_frames.h"
#include "solve/space/surface_selection.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class CaseFile : public testing::Test {
 protected:
    ElasticCase read(const std::string& text) {
        std::ofstream(folder_.file("case.toml")) << text;
        return read_case(folder_.file("case.toml"));
    }
    // The message, which names the file.
    std::string refusal(const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::usage);
            EXPECT_NE(std::string(error.what()).find("case.toml"), std::string::npos) << error.what();
            return error.what();
        }
        return "none";
    }
    void expect_refused(const std::string& text, const std::vector<std::string>& words) {
        const std::string message = refusal(text);
        for (const std::string& word : words)
            EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' in: " << message;
    }
    test::TemporaryFolder folder_;
    const std::string steel_ = "[material.steel]\nyoung = 210e3\npoisson = 0.3\n";
};

TEST_F(CaseFile, SaysAll) {
    const ElasticCase found = read(steel_ + R"(density = 7.8e-9
[material.rubber]
young = 1
poisson = 0.49
parts = [2, 5]
[[support]]
patch = ["foot", "leg*"]
fixed = true
[[support]]
name = "symmetry"
plane = [1, 0, 0, 0.5]
x = 0
[[load]]
box = [0, 0, 0, 1, 1, 2]
pressure = 130
case = "first"
[[load]]
point = [1, 2, 3]
force = [0, 0, -5.5]
case = "second"
[[load]]
patch = "top"
traction = [1, 2, 3]
[gravity]
acceleration = [0, 0, -9810]
[solver]
order = 2
preconditioner = "icc"
rtol = 1e-10
max_iterations = 77
)");
    ASSERT_EQ(found.materials.size(), 2U);
    EXPECT_EQ(found.materials[0].material.name, "rubber");  // in the order of names
    EXPECT_EQ(found.materials[0].parts, (std::vector<NodeId>{NodeId(2), NodeId(5)}));
    EXPECT_EQ(found.materials[1].material.density, 7.8e-9);
    ASSERT_EQ(found.supports.size(), 2U);
    EXPECT_EQ(found.supports[0].name, "foot");
    EXPECT_EQ(found.supports[0].where.patches, (std::vector<std::string>{"foot", "leg*"}));
    EXPECT_EQ(found.supports[0].displacement[2], 0.0);
    EXPECT_EQ(found.supports[1].name, "symmetry");
    EXPECT_FALSE(found.supports[1].displacement[1]);
    ASSERT_EQ(found.loads.size(), 3U);
    EXPECT_EQ(found.loads[0].pressure, 130.0);
    EXPECT_EQ((*found.loads[0].where.box)[1], Vec3(1, 1, 2));
    EXPECT_EQ(*found.loads[1].force, Vec3(0, 0, -5.5));
    EXPECT_EQ(found.names(), (std::vector<std::string>{"first", "second"}));
    ASSERT_EQ(found.gravity.size(), 1U);
    EXPECT_EQ(found.gravity[0].acceleration, Vec3(0, 0, -9810));
    EXPECT_EQ(found.solver.order, 2);
    EXPECT_EQ(found.solver.preconditioner, "icc");
    EXPECT_EQ(found.solver.rtol, 1e-10);
    EXPECT_EQ(found.solver.max_iterations, 77);
}

// After a material.
constexpr const char* supports_and_body_loads = R"(expansion = 12e-6
yield = 235
[[support]]
patch = "ramp"
normal = 0
[[support]]
patch = "wall"
direction = [0, 3, 4]
along = -0.5
[[support]]
patch = "hole"
axis = {point = [1, 2, 3], direction = [0, 0, 2]}
radial = 0
tangential = 0.1
[[spring]]
patch = "foot"
normal = 5
[[spring]]
name = "ground"
box = [0, 0, 0, 1, 1, 1]
stiffness = [1, 0, 2]
[[gravity]]
acceleration = [0, 0, -9810]
case = "still"
[rotation]
axis = {point = [0, 0, 0], direction = [0, 1, 0]}
omega = 100
case = "fast"
[[temperature]]
difference = 80
[[temperature]]
difference = -20
material = "steel"
region = ["a", "b"]
case = "cold"
[[load]]
patch = "top"
pressure = 1
case = "still"
[[combination]]
name = "all"
cases = {still = 1.35, fast = -2}
[solver]
inertia_relief = true
)";

TEST_F(CaseFile, SaysWhatWholeBodiesFeelAndHowTheyStand) {
    const ElasticCase found = read("units = \"mm\"\n" + steel_ + supports_and_body_loads);
    EXPECT_EQ(found.units, CaseUnits::mm);
    EXPECT_EQ(found.materials[0].material.expansion, 12e-6);
    EXPECT_EQ(found.materials[0].material.yield, 235);
    ASSERT_EQ(found.supports.size(), 3U);
    EXPECT_EQ(found.supports[0].frame, Support::Frame::normal);
    EXPECT_EQ(found.supports[1].frame, Support::Frame::direction);
    EXPECT_EQ(found.supports[1].direction, Vec3(0, 0.6, 0.8));
    EXPECT_EQ(found.supports[1].displacement[0], -0.5);
    EXPECT_EQ(found.supports[2].frame, Support::Frame::cylinder);
    EXPECT_EQ(found.supports[2].axis.point, Vec3(1, 2, 3));
    EXPECT_EQ(found.supports[2].axis.direction, Vec3(0, 0, 1));
    EXPECT_FALSE(found.supports[2].displacement[1]);
    EXPECT_EQ(found.supports[2].displacement[2], 0.1);
    ASSERT_EQ(found.springs.size(), 2U);
    EXPECT_EQ(found.springs[0].normal, 5);
    EXPECT_EQ(found.springs[1].stiffness, Vec3(1, 0, 2));
    EXPECT_EQ(found.rotations[0].omega, 100);
    EXPECT_EQ(found.rotations[0].load_case, "fast");
    EXPECT_EQ(found.temperatures[1].regions, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(found.names(), (std::vector<std::string>{"still", "fast", "cold"}));
    EXPECT_EQ(found.combinations[0].name, "all");
    EXPECT_EQ(found.combinations[0].factors,
              (std::vector<std::pair<std::string, double>>{{"fast", -2}, {"still", 1.35}}));
    EXPECT_TRUE(found.solver.inertia_relief);
}

TEST_F(CaseFile, TakesMaterialsFromTheTableInItsUnits) {
    const ElasticCase in_mm =
        read("units = \"mm\"\n[material.steel]\n[material.frame]\nlike = \"aluminium\"\nyield = 100\nregion = \"a\"\n");
    const Material &frame = in_mm.materials[0].material, &steel = in_mm.materials[1].material;
    EXPECT_EQ(frame.name, "frame");
    EXPECT_NEAR(frame.young, 70e3, 1e-9);
    EXPECT_EQ(frame.yield, 100);
    EXPECT_NE(in_mm.materials[0].source.find("EN 1999"), std::string::npos);
    EXPECT_NEAR(steel.young, 210e3, 1e-9);
    EXPECT_NEAR(steel.density, 7.85e-9, 1e-20);
    EXPECT_NEAR(steel.yield, 235, 1e-12);
    const ElasticCase in_m = read("units = \"m\"\n[material.steel]\n");
    EXPECT_EQ(in_m.materials[0].material.young, 210e9);
    EXPECT_EQ(in_m.materials[0].material.density, 7850);
    expect_refused("[material.steel]\n", {"line 1", "units"});
    expect_refused("units = \"cm\"\n[material.steel]\n", {"line 1", "\"mm\"", "\"m\""});
    expect_refused("units = \"mm\"\n[material.a]\nlike = \"cheese\"\n", {"line 3", "cheese", "steel, stainless steel"});
    expect_refused("units = \"mm\"\n[material.cheese]\n", {"line 2", "young and poisson", "cortical bone"});
}

TEST(MaterialTable, HasNumbersAndASourceForEachName) {
    std::set<std::string> names;
    for (const TableMaterial& row : table_materials()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(find_table_material(row.name), &row);
        EXPECT_TRUE(row.young > 1e8 && row.young < 1e12) << row.name;
        EXPECT_TRUE(row.poisson > 0 && row.poisson < 0.5) << row.name;
        EXPECT_TRUE(row.density == 0 || (row.density > 100 && row.density < 2e4)) << row.name;
        EXPECT_TRUE(row.expansion >= 0 && row.expansion < 2e-4) << row.name;
        EXPECT_TRUE(row.yield >= 0 && row.yield < row.young / 20) << row.name;
        EXPECT_GT(std::string(row.source).size(), 5U) << row.name;
    }
}

TEST_F(CaseFile, OfNewerKindsIsRefusedWithLineAndWayOut) {
    expect_refused(steel_ + "expansion = -1", {"line 4", "expansion", "negative"});
    expect_refused(steel_ + "yield = 0", {"line 4", "yield", "above 0"});
    const std::string at = "patch = \"a\"\n", support = steel_ + "[[support]]\n" + at, spring = steel_ + "[[spring]]\n";
    expect_refused(support + "normal = 0\nx = 0", {"line 4", "one kind"});
    expect_refused(support + "along = 0", {"direction", "along"});
    expect_refused(support + "direction = [1, 0, 0]\nx = 0", {"direction", "along"});
    expect_refused(support + "direction = [0, 0, 0]\nalong = 0", {"line 6", "no length"});
    expect_refused(support + "radial = 0", {"axis", "radial"});
    expect_refused(support + "radial = 0\naxis = [0, 0, 1]", {"line 7", "{point = [x, y, z], direction = [x, y, z]}"});
    expect_refused(support + "radial = 0\naxis = {middle = [0, 0, 1]}", {"line 7", "'middle'", "point, direction"});
    expect_refused(steel_ + "[[support]]\npoint = [0, 0, 0]\nnormal = 0", {"no normal", "along"});
    expect_refused(spring + at, {"exactly one of normal and stiffness"});
    expect_refused(spring + at + "normal = 0", {"line 6", "above 0"});
    expect_refused(spring + at + "stiffness = [1, -1, 0]", {"line 6", "negative"});
    expect_refused(spring + "point = [0, 0, 0]\nnormal = 1", {"area"});
    expect_refused(steel_ + "[spring]\nnormal = 1", {"[[spring]]"});
    expect_refused(steel_ + "[rotation]\nomega = 1", {"axis", "omega"});
    expect_refused(steel_ + "[[temperature]]\nmaterial = \"steel\"", {"line 4", "difference"});
    expect_refused(steel_ + "[[temperature]]\ndifference = 1\ncase = \"a/b\"", {"line 6", "'/'"});
    expect_refused(steel_ + "[[combination]]\nname = \"a\"\ncases = {b = 1}", {"line 6", "no case 'b'"});
    const std::string named = steel_ + "[gravity]\nacceleration = [0, 0, 1]\ncase = \"b\"\n[[combination]]\n";
    expect_refused(named + "name = \"b\"\ncases = {b = 1}", {"'b' is a case already"});
    expect_refused(named + "name = \"a\"", {"name and cases"});
    expect_refused(steel_ + "[solver]\ninertia_relief = 1", {"line 5", "only be true"});
}

// A load that nothing answers to would be a result of zeros.
TEST_F(CaseFile, WithoutEffectIsRefused) {
    const auto why = [&](const std::string& more) -> std::string {
        try {
            require_effect(read(more), "case.toml");
            return "";
        } catch (const Error& error) {
            return error.what();
        }
    };
    const std::string light = "[material.a]\nyoung = 1\npoisson = 0\n", heavy = light + "density = 1\n";
    const std::string weight = "[gravity]\nacceleration = [0, 0, 1]\n", warmth = "[temperature]\ndifference = 1\n";
    EXPECT_NE(why(light).find("loads nothing"), std::string::npos) << why(light);
    EXPECT_NE(why(light + weight).find("'a' has no density"), std::string::npos) << why(light + weight);
    EXPECT_NE(why(light + warmth).find("no material has an expansion"), std::string::npos) << why(light + warmth);
    EXPECT_EQ(why(heavy + weight), "");
    EXPECT_EQ(why(light + "expansion = 1\n" + warmth), "");
    EXPECT_EQ(why(light + "[[support]]\npatch = \"a\"\nx = 1\n"), "");
}

TEST_F(CaseFile, WithoutNamesIsOneCase) { EXPECT_EQ(read(steel_).names(), std::vector<std::string>{""}); }

TEST_F(CaseFile, IsRefusedWithLineAndWayOut) {
    expect_refused("", {"no material", "[material.steel]"});
    expect_refused("young = 1", {"line 1", "'young'", "material", "support", "load"});
    expect_refused("[material.steel]\nyoung = 1\n", {"line 1", "young and poisson"});
    expect_refused("[material.steel]\nyoung = 0\npoisson = 0.3", {"line 2", "young", "above 0"});
    for (const char* poisson : {"0.5", "-1", "0.7", "-1.5"})
        expect_refused(std::string("[material.a]\nyoung = 1\npoisson = ") + poisson, {"line 3", "between -1 and 0.5"});
    expect_refused("[material.a]\nyoung = nan\npoisson = 0", {"line 2", "young", "no number"});
    expect_refused("[material.a]\nyoung = inf\npoisson = 0", {"line 2", "no number"});
    expect_refused("[material.a]\nyoung = \"210e3\"\npoisson = 0", {"line 2", "no number"});
    expect_refused("[material.a]\nyoung = 1\npoisson = 0\ncolour = 3", {"line 4", "'colour'", "density"});
    expect_refused("[material.a]\nyoung = 1\npoisson = 0\nparts = [0]", {"line 4", "parts"});
    expect_refused("[material.a]\nyoung = 1\npoisson = 0\nparts = [2]\npatch = \"b\"", {"parts and patch"});
    expect_refused("material = 3", {"line 1", "[material.steel]"});
    expect_refused(steel_ + "[support]\npatch = \"a\"\nfixed = true", {"[[support]]"});
    expect_refused(steel_ + "[[support]]\npatch = \"a\"", {"x, y or z", "fixed"});
    expect_refused(steel_ + "[[support]]\nx = 0", {"exactly one of patch, box, plane and point"});
    expect_refused(steel_ + "[[support]]\npatch = \"a\"\npoint = [0, 0, 0]\nx = 0", {"exactly one"});
    expect_refused(steel_ + "[[support]]\npatch = \"a\"\nx = true", {"x", "no number"});
    expect_refused(steel_ + "[[support]]\npatch = \"a\"\nfixed = false", {"fixed can only be true"});
    expect_refused(steel_ + "[[support]]\nbox = [0, 0, 0, 1, 1]\nx = 0", {"6 numbers"});
    expect_refused(steel_ + "[[support]]\nbox = [0, 0, 0, 1, 1, -1]\nx = 0", {"xmin"});
    expect_refused(steel_ + "[[support]]\nplane = [0, 0, 0, 1]\nx = 0", {"all 0"});
    expect_refused(steel_ + "[[support]]\npatch = []\nx = 0", {"empty list"});
    expect_refused(steel_ + "[[support]]\npatch = 3\nx = 0", {"no text"});
    expect_refused(steel_ + "[[load]]\npatch = \"a\"", {"exactly one of pressure, traction and force"});
    expect_refused(steel_ + "[[load]]\npatch = \"a\"\npressure = 1\nforce = [0, 0, 1]", {"exactly one of"});
    expect_refused(steel_ + "[[load]]\npoint = [0, 0, 1]\npressure = 1", {"only be a force"});
    expect_refused(steel_ + "[[load]]\npatch = \"a\"\nforce = [0, 0]", {"3 numbers"});
    expect_refused(steel_ + "[gravity]\n", {"acceleration"});
    expect_refused(steel_ + "[solver]\norder = 3", {"order is 1 or 2"});
    expect_refused(steel_ + "[solver]\npreconditioner = \"lu\"", {"multigrid", "icc"});
    expect_refused(steel_ + "[solver]\nrtol = 0", {"rtol"});
    expect_refused(steel_ + "[solver]\nmax_iterations = 0", {"max_iterations"});
    expect_refused("[material.a\n", {"line 1"});
}

// The multigrid had another name in older versions: cases with it are read, and the user is told.
TEST_F(CaseFile, HasBothSpellingsOfTheMultigrid) {
    EXPECT_EQ(read(steel_).solver.preconditioner, "multigrid");
    const ElasticCase now = read(steel_ + "[solver]\npreconditioner = \"multigrid\"");
    EXPECT_EQ(now.solver.preconditioner, "multigrid");
    EXPECT_TRUE(now.notes.empty());
    const ElasticCase old = read(steel_ + "[solver]\npreconditioner = \"gamg\"");
    EXPECT_EQ(old.solver.preconditioner, "multigrid");
    ASSERT_EQ(old.notes.size(), 1U);
    EXPECT_EQ(old.notes[0], folder_.file("case.toml") + ", line 5: preconditioner \"gamg\" is \"multigrid\" now.");
}

TEST_F(CaseFile, ThatIsMissingIsNamed) {
    try {
        read_case(folder_.file("none.toml"));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::io);
        EXPECT_NE(std::string(error.what()).find("none.toml"), std::string::npos);
    }
}

// Whatever three directions a node is held along, it moves as far along each of them as they say, and a force is shared
// among them.
TEST(NodeHolds, KeepAllThatIsSaid) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1, 1);
    const auto vector = [&]() -> Vec3 { return {number(random), number(random), number(random)}; };
    for (int i = 0; i < 100; ++i) {
        NodeHolds holds;
        NodeFrames frames(1);
        std::array<Vec3, 3> directions;
        std::array<double, 3> values{};
        for (std::size_t d = 0; d < 3; ++d) {
            directions[d] = vector().normalized();
            values[d] = number(random);
            holds.hold(directions[d], values[d], static_cast<std::int32_t>(d));
            holds.hold(directions[d], 77, 9);  // the first one counts
        }
        if (holds.count() < 3) continue;
        frames.set(0, holds);
        const NodeFrames::Frame& frame = *frames.at(0);
        EXPECT_LT((frame.axes * frame.axes.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
        const Vec3 moved = frame.axes.transpose() * Vec3(holds.value(0), holds.value(1), holds.value(2));
        for (std::size_t d = 0; d < 3; ++d) {
            EXPECT_NEAR(directions[d].dot(moved), values[d], 1e-9);
            EXPECT_EQ(holds.holder(static_cast<int>(d)), static_cast<std::int32_t>(d));
        }
        const Vec3 force = vector();
        EXPECT_LT((frame.directions * (frame.shares * force) - force).norm(), 1e-9);
    }
    NodeHolds noisy;
    noisy.hold(Vec3::UnitZ(), 0, 0);
    noisy.hold(Vec3(0, 1e-7, 1).normalized(), 0, 1);
    EXPECT_EQ(noisy.count(), 1);
    EXPECT_TRUE(noisy.is_global());
}

}  // namespace
}  // namespace kerf

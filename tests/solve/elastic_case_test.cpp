// Case files: what is understood, and that everything else is refused with its line.
#include "solve/elastic_case.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/error.h"
#include "solve/surface_selection.h"
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
    EXPECT_EQ(found.materials[0].parts, (std::vector<NodeId>{2, 5}));
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
    EXPECT_EQ(*found.gravity, Vec3(0, 0, -9810));
    EXPECT_EQ(found.solver.order, 2);
    EXPECT_EQ(found.solver.preconditioner, "icc");
    EXPECT_EQ(found.solver.rtol, 1e-10);
    EXPECT_EQ(found.solver.max_iterations, 77);
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
    expect_refused(steel_ + "[solver]\npreconditioner = \"lu\"", {"gamg", "icc"});
    expect_refused(steel_ + "[solver]\nrtol = 0", {"rtol"});
    expect_refused(steel_ + "[solver]\nmax_iterations = 0", {"max_iterations"});
    expect_refused("[material.a\n", {"line 1"});
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

TEST(Patterns, StarsStandForAnything) {
    EXPECT_TRUE(matches_pattern("face_1", "face_1"));
    EXPECT_FALSE(matches_pattern("face_1", "face_12"));
    EXPECT_FALSE(matches_pattern("ace_1", "face_1"));
    EXPECT_TRUE(matches_pattern("*", ""));
    EXPECT_TRUE(matches_pattern("*", "anything"));
    EXPECT_TRUE(matches_pattern("a*b*c", "aXbbYc"));
    EXPECT_FALSE(matches_pattern("a*b*c", "aXYc"));
    EXPECT_TRUE(matches_pattern("body/face *", "body/face 12"));
    EXPECT_FALSE(matches_pattern("", "a"));
    EXPECT_TRUE(matches_pattern("**", "a"));
}

}  // namespace
}  // namespace kerf

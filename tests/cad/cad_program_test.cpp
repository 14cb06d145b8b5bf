// CAD files on the command line.
#include <fstream>

#include <gtest/gtest.h>

#include "cad/cad_files.h"
#include "files/io/cad_body.h"
#include "files/io/file_bytes.h"
#include "support/file_contents.h"
#ifdef KERF_MPIRUN
#include "support/mpirun.h"
#endif
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

class CadProgram : public testing::Test {
 protected:
    CadProgram() {
        test::write_cad(part(), test::together({test::box({0, 0, 0}, {2, 1, 1}), test::cylinder(0.5, 3)}), "INCH");
    }
    std::string part() const { return folder_.file("part.step"); }

    test::TemporaryFolder folder_;
};

TEST_F(CadProgram, CheckSaysWhatWasRead) {
    const ChildResult refused = test::run_kerf({"check", part()});
    EXPECT_EQ(refused.exit_code, 3) << "they overlap";
    EXPECT_NE(test::output_of(refused).find("--unite"), std::string::npos) << test::output_of(refused);
    EXPECT_NE(test::output_of(refused).find("touching solids: "), std::string::npos) << test::output_of(refused);
    const ChildResult as_json = test::run_kerf({"check", part(), "--json"});
    EXPECT_EQ(as_json.exit_code, 3);
    EXPECT_NE(test::output_of(as_json).find("\"kind\": \"touching solids\""), std::string::npos);
    const std::string open = folder_.file("open.step");
    test::write_cad(open, test::open_shell(test::box({0, 0, 0}, {2, 1, 1})));
    EXPECT_NE(test::output_of(test::run_kerf({"check", open})).find("open solid: "), std::string::npos);
    EXPECT_NE(test::output_of(refused).find("kerf wrap " + part()), std::string::npos) << test::output_of(refused);
    const ChildResult united = test::run_kerf({"check", part(), "--unite"});
    EXPECT_EQ(united.exit_code, 0) << test::output_of(united);
    EXPECT_NE(test::output_of(united).find("STEP: unit inch -> mm, 1 solid"), std::string::npos)
        << test::output_of(united);
    EXPECT_EQ(test::run_kerf({"check", part(), "--solid", "2", "--unit", "inch"}).exit_code, 0);
    EXPECT_EQ(test::run_kerf({"check", part(), "--solid", "9"}).exit_code, 2);
    EXPECT_EQ(test::run_kerf({"check", part(), "--cad-deflection", "2"}).exit_code, 2);
}

TEST_F(CadProgram, MeshIsMadeOfTheFileAndVerified) {
    const std::string out = folder_.file("out");
    const ChildResult meshed = test::run_kerf(
        {"mesh", part(), "-o", out, "-n", "2", "--workers", "1", "--solid", "2", "--cad-deflection", "1e-2"});
    EXPECT_EQ(meshed.exit_code, 0) << meshed.log;
    EXPECT_NE(meshed.log.find("1 solid, 3 faces"), std::string::npos) << meshed.log;
    EXPECT_EQ(test::run_kerf({"verify", out}).exit_code, 0);
    const ChildResult checked = test::run_kerf({"check", part(), "--solid", "2", "--json"});
    EXPECT_NE(test::output_of(checked).find("\"solid 2/face 1\""), std::string::npos) << test::output_of(checked);
}

// What is refused has a wrap: solids that overlap, and a box without a side.
TEST_F(CadProgram, WrapTakesWhatIsRefused) {
    const std::string open = folder_.file("open.step"), around = folder_.file("around.off");
    test::write_cad(open, test::open_shell(test::box({0, 0, 0}, {2, 1, 1})));
    for (const std::string& file : {part(), open}) {
        const ChildResult wrapped = test::run_kerf({"wrap", file, "-o", around, "--gap", "45%"});
        EXPECT_EQ(wrapped.exit_code, 0) << wrapped.log;
        EXPECT_NE(wrapped.log.find("as they are"), std::string::npos) << wrapped.log;
        EXPECT_EQ(test::run_kerf({"check", around}).exit_code, 0);
    }
}

TEST_F(CadProgram, ListsTheSurfacesOfFaces) {
    const std::string text =
        test::output_of(test::run_kerf({"check", part(), "--solid", "2", "--list-patches", "--scale", "10"}));
    EXPECT_NE(text.find("  cylinder r = 5  solid 2/face "), std::string::npos) << text;
    EXPECT_NE(text.find("  plane  "), text.rfind("  plane  ")) << "two: " << text;
}

TEST_F(CadProgram, SurfaceIsRemeshedUnlessItIsAskedFor) {
    const std::string out = folder_.file("out");
    const auto log_of = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"decompose", part(), "-o", out, "-n", "1", "--solid", "2"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ChildResult run = test::run_kerf(arguments);
        EXPECT_EQ(run.exit_code, 0) << run.log;
        return run.log;
    };
    const std::string by_default = log_of({}), split = log_of({"--surface", "split"});
    EXPECT_NE(by_default.find("A CAD file has no triangles of its own"), std::string::npos) << by_default;
    EXPECT_NE(by_default.find("\nremeshed "), std::string::npos) << by_default;
    EXPECT_EQ(split.find("remeshed "), std::string::npos) << split;
    EXPECT_NE(log_of({"--surface", "remesh"}).find("\nremeshed "), std::string::npos);
}

#ifdef KERF_MPIRUN
TEST_F(CadProgram, EveryRankRemeshesTheSame) {
    const auto files_of = [&](int ranks) {
        const std::string out = folder_.file("out");
        const ChildResult run = test::run_ranks(ranks, {test::kerf_program(), "mesh", part(), "-o", out, "-n", "2",
                                                        "--workers", "1", "--solid", "2", "--cad-deflection", "1e-2"});
        EXPECT_EQ(run.exit_code, 0) << run.log;
        return test::result_of_run(out);
    };
    const auto files = files_of(1);
    EXPECT_FALSE(files.empty());
    EXPECT_TRUE(files == files_of(2));
}
#endif

TEST_F(CadProgram, AnswersOnStandardOutputAndInAFileAreTheSame) {
    const std::string out = folder_.file("answer");
    const ChildResult answered = test::run_program(test::cad_program(), {part(), "--solid", "1"});
    ASSERT_EQ(answered.exit_code, 0) << answered.log;
    const CadAnswer answer = from_cad_bytes(answered.output);
    EXPECT_EQ(answer.body.file_hash, digest_of(read_file(part())));
    EXPECT_EQ(answer.body.soup.facets.size(), 12u);
    EXPECT_EQ(test::run_program(test::cad_program(), {part(), "--solid", "1", "--output", out}).exit_code, 0);
    EXPECT_EQ(read_file(out), test::output_of(answered));
}

TEST_F(CadProgram, RefusalsHaveTheirExitCode) {
    EXPECT_EQ(test::run_program(test::cad_program(), {}).exit_code, 2);
    EXPECT_EQ(test::run_program(test::cad_program(), {part(), "--sloid", "1"}).exit_code, 2);
    EXPECT_EQ(test::run_program(test::cad_program(), {folder_.file("nowhere.step")}).exit_code, 7);
    const ChildResult overlapping = test::run_program(test::cad_program(), {part()});
    EXPECT_EQ(overlapping.exit_code, 3);
    EXPECT_EQ(from_cad_bytes(overlapping.output).error_code, 3);
    EXPECT_NE(overlapping.log.find("kerf-cad: "), std::string::npos);
}

TEST_F(CadProgram, ArchivesAreReadAsTheirContent) {
    ASSERT_EQ(test::run_program("/bin/gzip", {"-k", part()}).exit_code, 0);
    const ChildResult plain = test::run_kerf({"check", part(), "--solid", "1"});
    const ChildResult packed = test::run_kerf({"check", part() + ".gz", "--solid", "1"});
    EXPECT_EQ(packed.exit_code, 0) << test::output_of(packed);
    EXPECT_EQ(packed.output.size(), plain.output.size() + 3) << "but for the name";
}

}  // namespace
}  // namespace kerf

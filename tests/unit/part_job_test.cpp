#include "run/part_job.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/bytes.h"
#include "core/error.h"
#include "io/file_bytes.h"
#include "run/failed_part.h"
#include "run/journal.h"
#include "run/report.h"
#include "support/file_contents.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

PartJob job_of(const Soup& soup) {
    PartJob job;
    job.surface = test::to_arrays(soup);
    job.boundary_id.assign(job.surface.vertices.size(), 0);
    job.neighbour.assign(job.surface.facets.size(), -1);
    job.length_scale = 1;
    return job;
}

TEST(PartJob, CountsAndHasAQualityWhenDone) {
    const test::TemporaryFolder folder;
    const PartResult result = run_part_job(job_of(test::box()), {}, folder.file("part"));
    EXPECT_EQ(result.code, 0) << result.message;
    EXPECT_GT(result.tets, 0);
    EXPECT_EQ(result.quality.all.measures.size(), quality_measures.size());
}

// The remedy that fills two halves: what others see of the part is the same, and the vertices of the cut are inside.
TEST(PartJob, IsTheSameFromOutsideWhenCutInTwo) {
    const test::TemporaryFolder folder;
    MesherCall whole, in_two;
    whole.options.size = in_two.options.size = SizeField(1e-2);
    in_two.cut_first = true;
    for (const Soup& soup : {test::icosphere(3), test::torus(3, 1, 30, 20), test::nested_boxes(2, 5)}) {
        SCOPED_TRACE(soup.patch_names.front());
        const PartJob job = job_of(soup);
        const PartResult a = run_part_job(job, whole, folder.file("whole"));
        const PartResult b = run_part_job(job, in_two, folder.file("halves"));
        ASSERT_EQ(b.code, 0) << b.message;
        EXPECT_TRUE(b.laws.hold());
        EXPECT_EQ(b.vertices - b.interior_vertices, a.vertices - a.interior_vertices);
        EXPECT_NEAR(b.laws.volume, a.laws.volume, 1e-12 * a.laws.volume);
        EXPECT_NE(b.hash, a.hash);
        EXPECT_EQ(digest_of(read_file(folder.file("halves"))), b.file_hash);
    }
}

// What a limit of time has shaped is not taken over by who has another one; everything else is by everybody.
TEST(Journal, FindsAPartThatNoOtherTimeLimitHasShaped) {
    const test::TemporaryFolder folder;
    const std::string part = folder.file("part"), journal = folder.file("1");
    PartOutcome outcome;
    outcome.result = run_part_job(job_of(test::box()), {}, part);
    const FileHash job = {3, 4}, other = {3, 5};
    EXPECT_FALSE(find_finished_part(journal, part, job, 0));
    for (const double shaped_by : {0.0, 5.0})
        for (const double limit : {0.0, 4.0, 5.0, 600.0}) {
            SCOPED_TRACE(testing::Message() << shaped_by << ", " << limit);
            outcome.timed_out = shaped_by > 0;
            write_journal_entry(journal, {job, shaped_by, outcome});
            const auto found = find_finished_part(journal, part, job, limit);
            EXPECT_EQ(found.has_value(), shaped_by == 0 || limit == shaped_by);
            EXPECT_TRUE(!found || found->timed_out == outcome.timed_out);
            EXPECT_FALSE(find_finished_part(journal, part, other, limit));
        }
}

// Boxes that touch in a point: TetGen returns tetrahedra, but not with these facets. A mesh that is thrown away must
// not be counted.
TEST(PartJob, HasNoTetrahedraWhenTheLawsAreBroken) {
    const test::TemporaryFolder folder;
    const Soup touching = test::join(test::box(), test::translated(test::box(), Vec3::Ones()));
    const PartResult result = run_part_job(job_of(touching), {}, folder.file("part"));
    EXPECT_EQ(result.code, static_cast<int>(ErrorCode::subdomain));
    EXPECT_FALSE(result.laws.hold());
    EXPECT_EQ(result.tets, 0);
    EXPECT_EQ(result.vertices, 0);
    EXPECT_EQ(result.interior_vertices, 0);
}

// A part that has not been meshed goes to the mesher that was asked for.
TEST(ReportOfParts, SaysWhichMesherFilledEachAndWhichWayItWent) {
    const test::TemporaryFolder folder;
    Input input;
    input.path = "box.stl";
    RunReport report;
    report.input = &input;
    report.parts.resize(3);
    report.parts[1].result = run_part_job(job_of(test::box()), {}, folder.file("part"));
    report.parts[2].result.mesher = "another";
    report.parts[2].result.way = "by a detour";
    const nlohmann::json parts = nlohmann::json::parse(to_json(report)).at("parts");
    for (const int i : {0, 1}) {
        EXPECT_EQ(parts[i].at("mesher"), report.options.mesher.name);
        EXPECT_FALSE(parts[i].contains("way"));
    }
    EXPECT_EQ(parts[2].at("mesher"), "another");
    EXPECT_EQ(parts[2].at("way"), "by a detour");
    EXPECT_EQ(from_bytes<PartReport>(to_bytes(report.parts[2])).result.way, "by a detour");
}

// The command of tetgen has a bound of the volume where one says it all, else the file says what it lacks.
TEST(FailedPart, IsKeptWithTheCommandThatRepeatsIt) {
    const test::TemporaryFolder folder;
    const SurfaceArrays surface = test::to_arrays(test::box());
    const auto told = [&](const SizeField& size) {
        MesherOptions mesher;
        mesher.size = size;
        write_failed_part(folder.file("failed"), 3, surface, mesher, "It hangs.");
        return test::bytes_of_file(folder.file("failed/part_0003.txt"));
    };
    const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    SizeSources sphere;
    sphere.spheres.push_back({Vec3::Zero(), 0.1, 0.01});
    const std::string plain = told(SizeField()), constant = told(SizeField(0.5)),
                      varying = told(SizeField(0.5, sphere));
    EXPECT_TRUE(has(plain, "It hangs.") && has(plain, "part_0003.smesh") && !has(plain, "a0.5"));
    EXPECT_TRUE(has(constant, "a0.5 part_0003.smesh") && !has(constant, "leaves them out"));
    EXPECT_TRUE(!has(varying, "a0.5") && has(varying, "leaves them out"));
}

}  // namespace
}  // namespace kerf

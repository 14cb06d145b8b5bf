#include "run/part_job.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace kerf {
namespace {

PartJob job_of(const Soup& soup, const std::string& part_file) {
    PartJob job;
    job.surface = test::to_arrays(soup);
    job.arrays.boundary_id.assign(job.surface.vertices.size(), 0);
    job.arrays.neighbour.assign(job.surface.facets.size(), -1);
    job.part_file = part_file;
    job.length_scale = 1;
    return job;
}

TEST(PartJob, CountsAndHasAQualityWhenDone) {
    const test::TemporaryFolder folder;
    const PartResult result = run_part_job(job_of(test::box(), folder.file("part.vtu")));
    EXPECT_EQ(result.code, 0) << result.message;
    EXPECT_GT(result.tets, 0);
    EXPECT_EQ(result.quality.all.measures.size(), quality_measures.size());
}

// Boxes that touch in a point: TetGen returns tetrahedra, but not with these facets. A mesh that is thrown away must
// not be counted.
TEST(PartJob, HasNoTetrahedraWhenTheLawsAreBroken) {
    const test::TemporaryFolder folder;
    const Soup touching = test::join(test::box(), test::translated(test::box(), Vec3::Ones()));
    const PartResult result = run_part_job(job_of(touching, folder.file("part.vtu")));
    EXPECT_EQ(result.code, static_cast<int>(ErrorCode::subdomain));
    EXPECT_FALSE(result.laws.hold());
    EXPECT_EQ(result.tets, 0);
    EXPECT_EQ(result.vertices, 0);
    EXPECT_EQ(result.interior_vertices, 0);
}

}  // namespace
}  // namespace kerf

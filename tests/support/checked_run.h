// A run with every law checked: in the report, and again from the files.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run/prepare/remeshing.h"
#include "support/run_in_process.h"
#include "support/run_laws.h"
#include "support/temporary_folder.h"

namespace kerf::test {

/// The laws of the report, and that all parts were reached.
inline void expect_verified(const RunReport& report, std::int32_t parts) {
    EXPECT_EQ(report.exit_code, 0);
    EXPECT_TRUE(report.verification.passed);
    EXPECT_LE(report.verification.volume_rel_error, 1e-10);
    EXPECT_EQ(report.verification.input_faces_missing, 0);
    EXPECT_EQ(report.verification.extra_boundary_faces, 0);
    EXPECT_EQ(report.verification.unmatched_interface_faces, 0);
    EXPECT_EQ(report.verification.inverted_tets, 0);
    EXPECT_EQ(report.verification.tets_zero_parts, 0);
    EXPECT_EQ(report.parts.size(), static_cast<std::size_t>(parts));
}

struct FinishedRun {
    RunReport report;
    std::vector<Part> parts;
};

/// Runs, checks the report, reads the files back and checks them against the input as it is read, and remeshed where it
/// has to be, anew.
inline FinishedRun run_and_check(const std::string& input, std::int32_t parts, RunListener* listener = nullptr,
                                 bool improve = true) {
    const TemporaryFolder folder;
    FinishedRun run;
    RunRequest options;
    options.mesher.improve = improve;
    run.report = run_parts(input, folder.file("out"), parts, options, listener);
    expect_verified(run.report, parts);
    run.parts = read_parts(folder.file("out"));
    EXPECT_EQ(run.parts.size(), run.report.parts.size());
    EXPECT_EQ(broken_laws(run.parts, remesh_where_asked(read_input(input), options).complex.arrays()), "");
    std::int64_t tets = 0, last_id = -1;
    for (const Part& part : run.parts) {
        tets += static_cast<std::int64_t>(part.mesh.tets.size());
        last_id = std::max(last_id, *std::max_element(part.global_id.begin(), part.global_id.end()));
    }
    EXPECT_EQ(tets, run.report.mesh.tets);
    EXPECT_EQ(last_id + 1, run.report.mesh.vertices);
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
    return run;
}

}  // namespace kerf::test

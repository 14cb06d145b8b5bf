// Programs as a user starts them: arguments in; exit code, standard output and standard error out.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fill/volume/child_process.h"
#include "support/places.h"
#include "support/surroundings.h"

namespace kerf::test {

/// Runs a program to its end, at most 120 s. `log` of the result is the end of its standard error.
inline ChildResult run_program(const std::string& program, const std::vector<std::string>& arguments) {
    constexpr double timeout_seconds = 120;
    ChildPool pool;
    pool.start(0, program, arguments, {}, timeout_seconds);
    return pool.wait_any()->result;
}

/// Runs kerf; nothing but the outputs that the arguments name may change.
inline ChildResult run_kerf(const std::vector<std::string>& arguments) {
    const Surroundings around(arguments);
    ChildResult result = run_program(test::kerf_program(), arguments);
    EXPECT_EQ(around.changes(), "");
    return result;
}

inline std::string output_of(const ChildResult& result) { return {result.output.begin(), result.output.end()}; }

}  // namespace kerf::test

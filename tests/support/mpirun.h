// Commands under mpirun.
#pragma once

#include <string>
#include <vector>

#include "support/program.h"

namespace kerf::test {

/// Of env. mpirun refuses the root user, as whom containers test, unless it is told twice.
inline std::vector<std::string> mpirun_arguments(int ranks) {
    return {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1", KERF_MPIRUN, "--oversubscribe", "-n",
            std::to_string(ranks)};
}

/// Runs a command, perhaps behind further options of mpirun, on so many ranks.
inline ChildResult run_ranks(int ranks, const std::vector<std::string>& command) {
    std::vector<std::string> arguments = mpirun_arguments(ranks);
    arguments.insert(arguments.end(), command.begin(), command.end());
    return run_program("/usr/bin/env", arguments);
}

/// How often the word is in the text.
inline std::int64_t count(const std::string& text, const std::string& word) {
    std::int64_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

}  // namespace kerf::test

// Texts that answer a command line in place of a run, and commands for which one process of a job is enough.
#pragma once

#include <functional>

#include "help/program_help.h"

namespace kerf {

/// Prints the answer on one rank of a job: to standard output, or to standard error if it is an error. Returns its exit
/// code.
int tell_answer(const Answer& answer);

/// Runs the command on the first rank of a job; the others have nothing to do. Returns its exit code, or 0 on the
/// others.
int run_on_first_rank(const std::function<int()>& command);

}  // namespace kerf

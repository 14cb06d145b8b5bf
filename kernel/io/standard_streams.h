// Standard output and standard error of the programs: what is data, and what is only said.
#pragma once

#include <string_view>

namespace kerf {

/// Makes the start of a program safe. Standard streams that are closed lead nowhere from now on, so that no file that
/// is opened takes their number; pipes that nobody reads and files that may not grow are errors of writing instead of
/// signals that end the process.
void prepare_standard_streams();

/// Says something to people on standard error. What cannot be written is lost: progress never fails a run.
void tell(std::string_view text);

/// Writes data that was asked for to standard output. A reader that leaves has seen enough; everything else that goes
/// wrong throws Error(io).
void print_data(std::string_view text);

}  // namespace kerf

// Standard output and standard error of the programs: the one is for data, the other for messages.
#pragma once

#include <string_view>

namespace kerf {

/// Makes standard streams safe at the start of a program. Closed standard streams lead nowhere from now on, so that no
/// file that is opened takes their number; pipes that nobody reads and files that may not grow are errors of writing
/// instead of signals that end the process.
void prepare_standard_streams();

/// Writes a message for people to standard error. A message that cannot be written is lost: progress never fails a run.
void tell(std::string_view text);

/// Writes data that was asked for to standard output. A reader that leaves has seen enough; every other failure throws
/// Error(io).
void print_data(std::string_view text);

}  // namespace kerf

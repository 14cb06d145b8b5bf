// The one exception type of the kernel. Its code is the exit code of the program.
#pragma once

#include <stdexcept>
#include <string>

namespace kerf {

/// Closed set of outcomes; the value is the exit code of every program of Kerf (see docs/output.md).
enum class ErrorCode : int {
    internal = 1,      ///< a bug of Kerf
    usage = 2,         ///< wrong command line or options
    input = 3,         ///< the surface cannot be meshed as it is
    subdomain = 4,     ///< a subdomain could not be meshed; the others are written
    memory = 5,        ///< out of memory or over the budget
    quality = 6,       ///< the quality gate was missed
    io = 7,            ///< reading or writing failed
    verification = 8,  ///< a law of the result does not hold
    convergence = 9,   ///< the solver did not reach its tolerance
    cancelled = 130,   ///< stopped by the user
};

/// What went wrong, where (element numbers of the input file, coordinates, part) and what to do, in one sentence each.
class Error : public std::runtime_error {
 public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
    ErrorCode code() const { return code_; }

 private:
    ErrorCode code_;
};

}  // namespace kerf

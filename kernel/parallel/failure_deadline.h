// How long a rank that has failed waits for the others.
#pragma once

#include <string_view>

namespace kerf {

/// Ends the process; `code` is that of the error, whose message may be cut short. It is called from a signal handler:
/// of the system it may use what is safe there, and no memory.
using EndProcess = void (*)(int code, std::string_view message);

/// A rank that has failed and waits longer than that for the others, who may be in the middle of a long computation or
/// wait for what never comes, is ended by `end`; then the launcher ends the others. For programs of several ranks: a
/// library does not end its caller, so that without this call nothing has a limit. SIGALRM is used for it.
void limit_wait_after_failure(unsigned seconds, EndProcess end);

/// From now on this rank waits, after the error of this code, until end_failure_deadline(). Needs no memory. Without
/// effect for the code 0, for a run that was cancelled, of whose end somebody else takes care, where it waits already,
/// and without a limit: then false.
bool begin_failure_deadline(int code, std::string_view message) noexcept;
/// The others have come.
void end_failure_deadline() noexcept;

/// The deadline of a wait that is a block of code.
class FailureDeadline {
 public:
    FailureDeadline(int code, std::string_view message) noexcept : begun_(begin_failure_deadline(code, message)) {}
    FailureDeadline(const FailureDeadline&) = delete;
    FailureDeadline& operator=(const FailureDeadline&) = delete;
    ~FailureDeadline() {
        if (begun_) end_failure_deadline();
    }

 private:
    bool begun_;
};

}  // namespace kerf

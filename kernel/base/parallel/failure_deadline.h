// The limit of the time for which a rank that has failed waits for the others.
#pragma once

#include <string_view>

namespace kerf {

/// Ends the process; `code` is that of the error, whose message may be cut short. It is called by a signal handler: it
/// may make only calls of the system that are safe there, and take no memory.
using EndProcess = void (*)(int code, std::string_view message);

/// Sets the limit: a rank that has failed and waits longer than `seconds` for the others, who may be in the middle of a
/// long computation or wait for a message that never comes, is ended by `end`; then the launcher ends the others. For
/// programs of several ranks: a library does not end its caller, so that without this call there is no limit. SIGALRM
/// is used for it.
void limit_wait_after_failure(unsigned seconds, EndProcess end);

/// Begins the wait of this rank after an error of this code; it lasts until end_failure_deadline(). Needs no memory.
/// Returns false, without effect, for the code 0, for a run that was cancelled, of whose end somebody else takes care,
/// where the rank waits already, where another alarm is set, and without a limit.
bool begin_failure_deadline(int code, std::string_view message) noexcept;
/// Ends the wait: the others have come.
void end_failure_deadline() noexcept;

/// The deadline of a wait that lasts for a block of code.
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

// An alarm needs neither a thread nor memory, and rings also where a library waits in a loop of its own.
#include "base/parallel/failure_deadline.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>

#include "base/core/error.h"

namespace kerf {

namespace {

struct DeadlineState {
    unsigned seconds = 0;  // 0: no limit
    EndProcess end = nullptr;
    void (*earlier_handler)(int) = SIG_DFL;
    bool is_running = false;
    int code = 0;
    std::array<char, 1000> message{};
    std::size_t length = 0;
};
DeadlineState deadline_state;

void end_failed_rank(int) {
    deadline_state.end(deadline_state.code, {deadline_state.message.data(), deadline_state.length});
}

}  // namespace

void limit_wait_after_failure(unsigned seconds, EndProcess end) {
    deadline_state.seconds = seconds;
    deadline_state.end = end;
}

bool begin_failure_deadline(int code, std::string_view message) noexcept {
    DeadlineState& state = deadline_state;
    if (code == 0 || code == static_cast<int>(ErrorCode::cancelled) || state.seconds == 0 || state.is_running)
        return false;
    state.code = code;
    state.length = std::min(message.size(), state.message.size());
    std::copy_n(message.begin(), state.length, state.message.begin());
    if (const unsigned left = ::alarm(0); left > 0) {  // the alarm of a run that is being cancelled
        ::alarm(left);
        return false;
    }
    state.earlier_handler = std::signal(SIGALRM, end_failed_rank);
    state.is_running = true;
    ::alarm(state.seconds);
    return true;
}

void end_failure_deadline() noexcept {
    if (!deadline_state.is_running) return;
    ::alarm(0);
    std::signal(SIGALRM, deadline_state.earlier_handler);
    deadline_state.is_running = false;
}

}  // namespace kerf

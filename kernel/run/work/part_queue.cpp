// A queue has workers, which are slots, and starts a child process for each attempt at a part: kerf-worker gets a
// PartAttempt on its standard input and answers with a PartResult, while job and mesh are files. take_result() sorts
// the ways in which a child can end. An answer is taken as it is. A first end by a signal counts as sent from outside,
// and the same call is made again without counting as an attempt. A broken law, a limit of time and a second crash are
// failures of the mesher, for which the next call of the table follows (fill/volume/retries.h); any other end, such as
// lack of memory, is final.
//
// A part that is tried again goes to the front of the queue and gets the worker that has just become free, which is why
// idle workers are a stack.
#include "run/work/part_queue.h"

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <thread>

#include <fmt/format.h>

#include "base/core/bytes.h"
#include "base/core/check.h"
#include "base/core/error.h"

namespace kerf {

namespace {

bool died_by_itself(const ChildResult& child) {
    const bool fatal_signal = child.signal == SIGABRT || child.signal == SIGSEGV || child.signal == SIGBUS ||
                              child.signal == SIGFPE || child.signal == SIGILL;
    return child.end == ChildResult::End::signalled && fatal_signal;
}

std::string last_line(const std::string& text) {
    const std::size_t end = text.find_last_not_of("\r\n");
    if (end == std::string::npos) return "";
    const std::size_t begin = text.find_last_of('\n', end);
    return text.substr(begin == std::string::npos ? 0 : begin + 1,
                       end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

// Returns the result of a worker that gave no answer.
PartResult result_of_silence(const ChildResult& child) {
    PartResult result;
    result.code = static_cast<int>(ErrorCode::subdomain);
    result.message = "The worker " + child.describe() + ".";
    if (const std::string line = last_line(child.log); !line.empty()) result.message += " Its last words: " + line;
    return result;
}

// Returns one message for all attempts: first the reason of the call as it was wanted, then the last one of fallbacks.
std::string message_of_all(const PartOutcome& outcome) {
    const std::string& last = outcome.result.message;
    if (outcome.failures.empty() || outcome.failures.front() == last) return last;
    return fmt::format("{} {} more attempt{} failed, too, the last one so: {}", outcome.failures.front(),
                       outcome.failures.size(), outcome.failures.size() == 1 ? "" : "s", last);
}

}  // namespace

PartQueue::PartQueue(std::vector<QueuedPart> parts, QueueOptions options)
    : parts_(std::move(parts)), options_(std::move(options)), progress_(parts_.size()) {
    KERF_CHECK(options_.workers >= 1 && options_.attempts >= 1);
    for (std::int32_t worker = options_.workers; worker-- > 0;) idle_.push_back(worker);
}

std::vector<MesherCall> PartQueue::calls_of(std::size_t part) const {
    MesherOptions mesher = options_.mesher;
    mesher.size = parts_[part].size;
    return mesher_calls(mesher);
}

std::optional<PartQueue::Finished> PartQueue::step(double wait_seconds) {
    for (; !waiting_.empty() && !idle_.empty(); waiting_.pop_front()) {
        const std::size_t part = waiting_.front();
        PartOutcome& outcome = progress_[part].outcome;
        outcome.worker = idle_.back();
        idle_.pop_back();
        MesherCall call = calls_of(part)[progress_[part].call];
        call.options.size = call.options.size.within(parts_[part].box);
        outcome.fallback = call.fallback;
        ++outcome.attempts;
        pool_.start(part, options_.worker_program,
                    {"--memory", std::to_string(options_.memory_mb), "--parent", std::to_string(::getpid())},
                    to_bytes(PartAttempt{parts_[part].job_file, parts_[part].part_file, call, options_.durable}),
                    options_.timeout_seconds);
    }
    KERF_CHECK(wait_seconds >= 0);
    if (pool_.running() == 0) {
        std::this_thread::sleep_for(std::chrono::duration<double>(wait_seconds));
        return {};
    }
    const auto ended = pool_.wait_any(wait_seconds);
    if (!ended) return {};
    return take_result(ended->tag, ended->result);
}

std::optional<PartQueue::Finished> PartQueue::take_result(std::size_t part, const ChildResult& child) {
    PartOutcome& outcome = progress_[part].outcome;
    outcome.seconds += child.seconds;
    const bool answered = child.end == ChildResult::End::exited && child.exit_code == 0 && !child.output.empty();
    outcome.result = answered ? from_bytes<PartResult>(child.output) : result_of_silence(child);
    const bool timed_out = child.end == ChildResult::End::timed_out;
    outcome.timed_out |= timed_out;
    idle_.push_back(outcome.worker);
    if (child.end == ChildResult::End::signalled && outcome.interruption.empty()) {
        outcome.interruption = outcome.result.message;
        --outcome.attempts;
        waiting_.push_front(part);  // for the same worker
        return {};
    }
    const bool mesher_failed = outcome.result.code == static_cast<int>(ErrorCode::subdomain) &&
                               (answered || timed_out || died_by_itself(child));
    if (mesher_failed && outcome.attempts < options_.attempts) {
        const auto next = next_call(calls_of(part), progress_[part].call,
                                    timed_out ? MesherFailure::timed_out : MesherFailure::failed);
        if (next) {
            outcome.failures.push_back(outcome.result.message);
            progress_[part].call = *next;
            waiting_.push_front(part);
            return {};
        }
    }
    if (outcome.result.code) {
        outcome.result.message = message_of_all(outcome);
        std::error_code ignored;
        std::filesystem::remove(parts_[part].part_file, ignored);  // the worker may have ended while it wrote
    }
    return Finished{part, std::exchange(outcome, {})};
}

}  // namespace kerf

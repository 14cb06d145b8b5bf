#include "run/part_queue.h"

#include <algorithm>
#include <csignal>

#include "core/bytes.h"
#include "core/error.h"
#include "volume/child_process.h"
#include "volume/retries.h"

namespace kerf {

namespace {

constexpr double cancel_interval_seconds = 0.2;

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

// What a worker that gave no answer left behind.
PartResult result_of_silence(const ChildResult& child) {
    PartResult result;
    result.code = static_cast<int>(ErrorCode::subdomain);
    result.message = "The worker " + child.describe() + ".";
    if (const std::string line = last_line(child.log); !line.empty()) result.message += " Its last words: " + line;
    return result;
}

class Queue {
 public:
    Queue(std::vector<PartJob> jobs, const QueueOptions& options,
          const std::function<void(std::size_t, const PartOutcome&)>& finished)
        : jobs_(std::move(jobs)),
          options_(options),
          finished_(finished),
          outcomes_(jobs_.size()),
          call_(jobs_.size(), 0) {
        for (const PartJob& job : jobs_) calls_.push_back(mesher_calls(job.mesher));
        for (std::int32_t i = options_.workers; i-- > 0;) idle_.push_back(i);
    }

    std::vector<PartOutcome> run() {
        while (next_ < jobs_.size() || pool_.running() > 0) {
            while (next_ < jobs_.size() && !idle_.empty()) {
                outcomes_[next_].worker = idle_.back();
                idle_.pop_back();
                start(next_++);
            }
            if (options_.cancelled()) throw Error(ErrorCode::cancelled, "The run was cancelled.");
            if (const auto ended = pool_.wait_any(cancel_interval_seconds))
                take(static_cast<std::size_t>(ended->tag), ended->result);
        }
        return std::move(outcomes_);
    }

 private:
    void start(std::size_t index) {
        PartJob& job = jobs_[index];
        const MesherCall& call = calls_[index][call_[index]];
        job.mesher = call.options;
        job.vertex_order_seed = call.vertex_order_seed;
        outcomes_[index].remedy = call.remedy;
        ++outcomes_[index].attempts;
        pool_.start(static_cast<int>(index), options_.worker_program, {"--memory", std::to_string(options_.memory_mb)},
                    to_bytes(job), options_.timeout_seconds);
    }

    void take(std::size_t index, const ChildResult& child) {
        PartOutcome& outcome = outcomes_[index];
        outcome.seconds += child.seconds;
        const bool answered = child.end == ChildResult::End::exited && child.exit_code == 0 && !child.output.empty();
        outcome.result = answered ? from_bytes<PartResult>(child.output) : result_of_silence(child);
        const bool timed_out = child.end == ChildResult::End::timed_out;
        const bool mesher_failed = outcome.result.code == static_cast<int>(ErrorCode::subdomain) &&
                                   (answered || timed_out || died_by_itself(child));
        if (mesher_failed && outcome.attempts < options_.attempts) {
            const auto next =
                next_call(calls_[index], call_[index], timed_out ? MesherFailure::timed_out : MesherFailure::failed);
            if (next) {
                outcome.failures.push_back(outcome.result.message);
                call_[index] = *next;
                start(index);
                return;
            }
        }
        idle_.push_back(outcome.worker);
        jobs_[index] = PartJob();
        finished_(index, outcome);
    }

    std::vector<PartJob> jobs_;
    const QueueOptions& options_;
    const std::function<void(std::size_t, const PartOutcome&)>& finished_;
    std::vector<PartOutcome> outcomes_;
    std::vector<std::vector<MesherCall>> calls_;
    std::vector<std::size_t> call_;  // that runs or ran last, of each job
    std::vector<std::int32_t> idle_;
    std::size_t next_ = 0;
    ChildPool pool_;
};

}  // namespace

std::vector<PartOutcome> run_part_jobs(std::vector<PartJob> jobs, const QueueOptions& options,
                                       const std::function<void(std::size_t index, const PartOutcome&)>& finished) {
    return Queue(std::move(jobs), options, finished).run();
}

}  // namespace kerf

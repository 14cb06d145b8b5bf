// Progress on a terminal or in a log.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "core/stopwatch.h"
#include "report/event_log.h"
#include "solve/solve_listener.h"

namespace kerf {

/// One line with a bar that is rewritten on a terminal; a line per 10 % otherwise. Writes to standard error. While it
/// lives, SIGINT, SIGTERM and SIGUSR1 cancel the run.
class ProgressLine : public SolveListener {
 public:
    /// `events`, unless null, is told of everything, too. `shows_plan`: what is ahead is said before it begins.
    ProgressLine(bool quiet, EventLog* events, bool shows_plan = true);
    ~ProgressLine() override;
    /// From now on each stage is told, and each second that it goes on, whether somebody calls or not: by a second
    /// thread. Without a terminal these are lines of their own.
    void tell_each_second();
    void on_progress(const char* stage, std::size_t done, std::size_t total) override;
    void on_parts(const std::vector<PartReport>& parts, const std::string& plan) override;
    void on_part(const PartEvent& event) override;
    void on_iteration(int iteration, double residual, double wanted) override;
    void on_equations(std::int64_t unknowns) override;
    bool cancelled() const override;
    /// Says what stays, in the place of the line.
    void say(const std::string& text);

 private:
    void begin_stage(const char* stage);
    void print(const std::string& text);
    void clear();
    void tell_that_it_goes_on();
    bool is_time_for_a_line() const;
    std::string state_text() const;

    bool quiet_, terminal_, shows_plan_, line_open_ = false;
    EventLog* events_;
    std::string stage_;
    double last_seconds_ = 0;  // of the stage, that were printed
    int last_tenth_ = 0;
    std::string text_;                  // what is told again as long as nothing new is
    std::string unknowns_;              // for the stages of a solution
    std::size_t done_ = 0, total_ = 0;  // of the stage
    bool each_second_ = false;
    std::int64_t tets_at_start_ = 0;  // made by an interrupted run
    Stopwatch of_stage_;
    std::mutex mutex_;  // of all above, where there is the second thread, which comes last: it ends first
    std::condition_variable_any end_;
    std::jthread each_second_thread_;
};

}  // namespace kerf

// Progress on a terminal or in a log.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "base/core/stopwatch.h"
#include "run/report/event_log.h"
#include "solve/run/solve_listener.h"

namespace kerf {

/// A line with a bar that is rewritten on a terminal; elsewhere a line for each tenth of the work. Writes to standard
/// error. While it lives, SIGINT, SIGTERM and SIGUSR1 cancel the run.
class ProgressLine : public SolveListener {
 public:
    /// `events`, unless null, is told of everything, too. `shows_plan`: the plan of the parts is told before they are
    /// meshed.
    ProgressLine(bool quiet, EventLog* events, bool shows_plan = true);
    ~ProgressLine() override;
    /// Tells each stage from now on, and each second that it goes on, by a second thread, so that it does not depend on
    /// calls. Without a terminal these are lines of their own.
    void tell_each_second();
    void on_progress(const char* stage, std::size_t done, std::size_t total) override;
    void on_parts(const std::vector<PartReport>& parts, const std::string& plan) override;
    void on_part(const PartEvent& event) override;
    void on_iteration(int iteration, double residual, double wanted) override;
    void on_equations(std::int64_t unknowns) override;
    bool cancelled() const override;
    /// Tells a text that stays, in the place of the line.
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
    double last_seconds_ = 0;  // seconds of the stage that were printed last
    int last_tenth_ = 0;
    std::string text_;                  // the text that is told again as long as there is nothing new
    std::string unknowns_;              // text of the number of unknowns, for the stages of a solution
    std::size_t done_ = 0, total_ = 0;  // progress of the stage
    bool each_second_ = false;
    std::int64_t tets_at_start_ = 0;  // tetrahedra made by an interrupted run
    Stopwatch of_stage_;
    std::mutex mutex_;  // guards all above from the second thread, which is the last member, so that it ends first
    std::condition_variable_any end_;
    std::jthread each_second_thread_;
};

}  // namespace kerf

// Progress on a terminal or in a log.
#pragma once

#include <string>

#include "core/stopwatch.h"
#include "report/event_log.h"

namespace kerf {

/// One line with a bar that is rewritten on a terminal; a line per 10 % otherwise. Writes to standard error. While it
/// lives, SIGINT, SIGTERM and SIGUSR1 cancel the run.
class ProgressLine : public RunListener {
 public:
    /// `events`, unless null, is told of everything, too. `shows_plan`: what is ahead is said before it begins.
    ProgressLine(bool quiet, EventLog* events, bool shows_plan = true);
    ~ProgressLine() override;
    void on_progress(const char* stage, std::size_t done, std::size_t total) override;
    void on_parts(const std::vector<PartReport>& parts, const std::string& plan) override;
    void on_part(const PartEvent& event) override;
    void on_iteration(int iteration, double residual, double wanted) override;
    bool cancelled() const override;
    /// Says what stays, in the place of the line.
    void say(const std::string& text);

 private:
    void print(const std::string& text);
    void clear();

    bool quiet_, terminal_, shows_plan_, line_open_ = false;
    EventLog* events_;
    std::string stage_;
    double last_seconds_ = 0;  // of the stage, that were printed
    int last_tenth_ = 0;
    std::int64_t tets_at_start_ = 0;  // made by an interrupted run
    Stopwatch of_stage_;
};

}  // namespace kerf

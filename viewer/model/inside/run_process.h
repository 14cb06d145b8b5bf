// A run in a process of its own, and the temporary folder of its files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fill/volume/child_process.h"
#include "run/request/run_request.h"
#include "run/run/trace.h"

namespace kerf::view {

/// A temporary folder below that of the system; the destructor removes it.
class ScratchFolder {
 public:
    /// Throws Error(io).
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
    std::string path_;
};

/// Returns the command line of a run without the program: the options that differ from the defaults of kerf. `options`
/// has the paths of input, output, trace and events, too.
std::vector<std::string> command_line_of(RunRequest options, bool volume);

/// Writes the surface of a trace so that its coordinates are read back bit for bit; patches keep their numbers, but not
/// their names. Throws Error(io).
void write_surface_of(const Trace& trace, const std::string& path);

/// The process of a run, which can be interrupted. The destructor kills it.
class RunProcess {
 public:
    /// Throws Error(io) if it cannot be started.
    RunProcess(const std::string& program, const std::vector<std::string>& arguments,
               std::shared_ptr<ScratchFolder> scratch);

    /// Asks the process to end.
    void interrupt();
    /// Returns whether the process was asked to end so long ago that it should be killed.
    bool is_overdue() const;
    bool was_interrupted() const { return interrupted_.has_value(); }
    /// Returns the result, once, when the process has ended; waits for that at most `seconds`.
    std::optional<ChildResult> wait(double seconds);
    bool is_running() const { return pool_.running() > 0; }
    double seconds() const;

 private:
    using Clock = std::chrono::steady_clock;
    std::shared_ptr<ScratchFolder> scratch_;  // outlives the process
    ChildPool pool_;
    Clock::time_point start_ = Clock::now();
    std::optional<Clock::time_point> interrupted_;
};

/// Returns the reason why a run has ended, from its result alone: the end of its log, or else its exit.
std::string reason_of(const ChildResult& result);

}  // namespace kerf::view

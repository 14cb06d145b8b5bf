// A run in a process of its own, and the temporary folder of its files.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "request/options.h"
#include "run/trace.h"
#include "volume/child_process.h"

namespace kerf::view {

/// A folder of its own below that of the system, removed at its end.
class ScratchFolder {
 public:
    /// Throws std::filesystem::filesystem_error.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
    std::string path_;
};

/// The command line of a run without the program: what differs from the defaults of kerf. `options` says input,
/// output, trace and events, too.
std::vector<std::string> command_line_of(RunOptions options, bool volume);

/// Writes the surface of a trace so that its coordinates are read back bit for bit; patches keep their numbers, but not
/// their names. Throws Error(io).
void write_surface_of(const Trace& trace, const std::string& path);

/// A child that can be interrupted. The destructor kills it.
class RunProcess {
 public:
    /// Throws Error(io) if it cannot be started.
    RunProcess(const std::string& program, const std::vector<std::string>& arguments,
               std::shared_ptr<ScratchFolder> scratch);

    /// Asks it to end.
    void interrupt();
    /// It was asked to end so long ago that it should be killed.
    bool is_overdue() const;
    bool was_interrupted() const { return interrupted_.has_value(); }
    /// Its result, once, when it has ended; waits for that at most `seconds`.
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

/// Why a run has ended, from its result alone: the end of what it said.
std::string reason_of(const ChildResult& result);

}  // namespace kerf::view

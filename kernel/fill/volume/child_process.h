// Programs run side by side in processes of their own, with limits.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "base/core/bytes.h"

namespace kerf {

/// The end of a child process, and its output.
struct ChildResult {
    enum class End { exited, signalled, timed_out };
    End end = End::exited;
    int exit_code = 0;           ///< its exit code, if it exited
    int signal = 0;              ///< the signal that killed it, if one did
    Bytes output;                ///< all it wrote to its standard output
    std::string log;             ///< the last 4 KiB of its standard error
    double seconds = 0;          ///< wall clock
    double timeout_seconds = 0;  ///< the limit it was given, 0: none
    /// Peak of resident memory. Linux counts from the start, so it is at least this process's own at that moment.
    std::int64_t peak_rss_bytes = 0;

    /// Returns a few words on the end: "ended with exit code 3", "was killed by signal 9 (Killed)", "ran longer than
    /// its 30 s and was stopped".
    std::string describe() const;
};

/// Runs child processes side by side: start() starts a program by posix_spawn, feeds `input` to its standard input and
/// collects its output.
///
/// Several children run at once; wait_any() serves all their pipes until one ends, without busy waiting. A child that
/// exceeds its time limit is killed. The destructor kills and reaps all children that still run. A child inherits no
/// other open file. Not thread-safe; one pool per thread.
class ChildPool {
 public:
    ChildPool();
    ChildPool(const ChildPool&) = delete;
    ChildPool& operator=(const ChildPool&) = delete;
    ~ChildPool();

    /// Starts `program` with `arguments`. `tag` comes back with the result. `timeout_seconds` 0: none. Throws Error(io)
    /// if the program cannot be started, std::bad_alloc if there is no memory for it.
    void start(int tag, const std::string& program, const std::vector<std::string>& arguments, Bytes input,
               double timeout_seconds);
    std::size_t running() const;
    /// Asks the running children with this tag to end, by SIGINT as Ctrl-C does; wait_any() tells when one has.
    void interrupt(int tag);

    struct Finished {
        int tag;
        ChildResult result;
    };
    /// Blocks until a child has ended, at most `wait_seconds` (negative: without end), and returns its result; nothing
    /// if the time is over. Requires running() > 0.
    std::optional<Finished> wait_any(double wait_seconds = -1);

 private:
    struct Child;
    std::vector<Child> children_;
};

}  // namespace kerf

// Programs run side by side in processes of their own, with limits.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/bytes.h"

namespace kerf {

/// How a child process ended.
struct ChildResult {
    enum class End { exited, signalled, timed_out };
    End end = End::exited;
    int exit_code = 0;                ///< if exited
    int signal = 0;                   ///< if signalled
    Bytes output;                     ///< all it wrote to its standard output
    std::string log;                  ///< the last 4 KiB of its standard error
    double seconds = 0;               ///< wall clock
    double timeout_seconds = 0;       ///< the limit it was given, 0: none
    std::int64_t peak_rss_bytes = 0;  ///< Linux counts from the start, so at least this process's own at that moment

    /// "ended with exit code 3", "was killed by signal 9 (Killed)", "ran longer than its 30 s and was stopped".
    std::string describe() const;
};

/// Starts `program` with `arguments` by posix_spawn, feeds `input` to its standard input and collects its output.
///
/// Several children run at once; `wait_any` serves all their pipes until one ends, without busy waiting. A child that
/// exceeds its time limit is killed. The destructor kills and reaps what still runs. A child inherits no other open
/// file. Not thread-safe; one pool per thread.
class ChildPool {
 public:
    ChildPool();
    ChildPool(const ChildPool&) = delete;
    ChildPool& operator=(const ChildPool&) = delete;
    ~ChildPool();

    /// `tag` comes back with the result. `timeout_seconds` 0: none. Throws Error(io) if the program cannot be started,
    /// std::bad_alloc if there is no memory for it.
    void start(int tag, const std::string& program, const std::vector<std::string>& arguments, Bytes input,
               double timeout_seconds);
    std::size_t running() const;
    /// Asks the running children with this tag to end, by SIGINT as Ctrl-C does; wait_any() tells when one has.
    void interrupt(int tag);

    struct Finished {
        int tag;
        ChildResult result;
    };
    /// Blocks until a child has ended, at most `wait_seconds` (negative: without end). Nothing if the time is over.
    /// Requires running() > 0.
    std::optional<Finished> wait_any(double wait_seconds = -1);

 private:
    struct Child;
    std::vector<Child> children_;
};

}  // namespace kerf

// The progress of a run for other programs: one JSON object per line.
#pragma once

#include <memory>
#include <string>

#include "base/core/stopwatch.h"
#include "run/report/listener.h"

namespace kerf {

class CheckedFile;

/// Writes each event when it happens. All objects have "event" and "seconds" since the start:
///
///     {"event": "run", "input", "scale", "output", "trace", "parts"}
///     {"event": "stage", "stage": "read" | "repair" | "remesh" | "decompose" | "prepare" | "volume" | "reference" |
///                                 "write" | "hash"}
///     {"event": "parts", "parts": [{"id", "load", "facets", "volume", "resumed"}]}
///     {"event": "part", "id", "state": "done" | "resumed" | "failed", "rank", "worker", "mesher", "attempts",
///                       "tets", "part_seconds", "parts_done", "parts", "load_done", "tets_done", "message", "remedy",
///                       "way", "reason", "core_tets", "recovery": {"missing", "by_flips", "split", "added_vertices"}}
///     {"event": "equations", "unknowns"}
///     {"event": "iteration", "iteration", "residual", "wanted", "seconds_left"}
///     {"event": "working", "stage", "done", "total", "stage_seconds"}
///     {"event": "end", "exit_code", "message"}
///
/// Events of equations and iterations come from `kerf solve`, which has more stages (SolveListener), and which tells
/// each second that one goes on. "seconds_left" is -1 where it is not known. The first event names the run: absolute
/// paths, "" for a file that is not written, and K, 0 if the run chooses it. A reader of a pipe that leaves is told
/// nothing more, and the run goes on. "message" is there where something failed, "remedy" where the first attempt did,
/// "way" where the mesher has several, "reason" where it did not go its first one, "core_tets" where it has stamped
/// cells, "recovery" where facets had to be recovered (FacetRecoveryCounts).
class EventLog : public RunListener {
 public:
    /// `target`: the path of a file, which is replaced, or fd:N, an open file descriptor, which stays open. Throws
    /// Error(io).
    explicit EventLog(const std::string& target);
    ~EventLog() override;

    /// Writes the first event. Throws Error(io).
    void on_start(const RunRequest& request);
    void on_progress(const char* stage, std::size_t done, std::size_t total) override;
    void on_parts(const std::vector<PartReport>& parts, const std::string& plan) override;
    void on_part(const PartEvent& event) override;
    /// Write the events of a solution: the number of unknowns, an iteration with the seconds that are left, and the
    /// progress of a stage that goes on.
    void on_equations(std::int64_t unknowns);
    void on_solver_iteration(int iteration, double residual, double wanted, double seconds_left);
    void on_working(const std::string& stage, std::size_t done, std::size_t total, double stage_seconds);
    /// Writes the last event. `message`: the error, or empty. An event that cannot be written is lost: the run has
    /// ended anyway.
    void on_end(int exit_code, const std::string& message);

 private:
    template <class Object>
    void write(Object json);

    std::unique_ptr<CheckedFile> file_;  // null when the reader has left
    std::string stage_;
    Stopwatch stopwatch_;
};

}  // namespace kerf

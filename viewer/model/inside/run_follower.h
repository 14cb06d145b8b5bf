// A run is followed by its events file, or, if another process has started it without one, by looking at its folder.
// Its trace and the surfaces of its parts are there when the stage "prepare" begins, and its report at its end.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/model/inside/fetched.h"
#include "viewer/model/inside/opened_run.h"
#include "viewer/model/inside/run_events.h"

namespace kerf::view {

/// A run that a document follows: ours, or that of another process.
struct Followed {
    enum class TraceState { none, loading, known };
    std::optional<EventTail> tail;  ///< none: the folder of the run is looked at
    std::string input, output, trace;
    std::vector<RunEvent> events;  ///< the events that tell of parts
    TraceState trace_state = TraceState::none;
    std::optional<RunEvent> end;
    bool is_shown = false;   ///< the document shows this run and no older result any more
    bool is_ending = false;  ///< its report is being read
    std::chrono::steady_clock::time_point next_look = {};
    bool is_looking = false;
    std::optional<PartialRun> last_look;
    std::set<NodeId> finished;  ///< parts whose outcome is known
    // The members below are for a run of ours.
    std::shared_ptr<ScratchFolder> scratch;
    bool has_scratch_output = false;
    RunRequest options;              ///< the options as they were asked for
    std::optional<Document> before;  ///< the document that was shown; empty: there was none, or it was set aside

    std::string partial() const { return output + ".kerf-partial"; }
};

/// Fills the shown document with the progress and the result of the run that it follows.
class RunFollower {
 public:
    RunFollower(Background& background, ShownPair& pair, Fetched& fetched)
        : background_(background), pair_(pair), document_(pair.now.document), fetched_(fetched) {}

    bool is_following() const { return run_.has_value(); }
    /// Returns whether the last event of the run has come; its result may still be being read.
    bool has_ended() const { return run_ && run_->end; }
    /// Returns whether the run whose files are in this scratch folder is followed.
    bool is_following(const std::shared_ptr<ScratchFolder>& scratch) const { return run_ && run_->scratch == scratch; }

    void follow(Followed run) { run_ = std::move(run); }
    /// Follows the run of another process by its events.
    void follow_events(const std::string& path);
    /// Follows a run by its folder, from the state in which the shown document has it.
    void follow_folder(const std::string& output, const PartialRun& state);
    /// Returns the document that a comparison shows beside the next run; may be empty. The run that is followed loses
    /// the document that was kept for it.
    std::optional<Document> take_before();
    void stop();

    /// Reads new events, and returns whether there are any; looks at folders now and then. Called once a frame.
    bool poll();
    /// Takes the end of the process of our run; `reason` tells of it if the events do not.
    void end_process(const std::string& reason, bool cancelled);
    /// Ends the run that is followed, or was to be followed.
    void end_without_result(const std::string& message, int exit_code = 1);

 private:
    bool poll_events();
    void apply(const RunEvent& event);
    void apply_parts(const RunEvent& event);
    void show_input();
    void load_trace();
    void show_run_under_way(std::shared_ptr<const Trace> trace);
    void use_partial_folder();
    void look_at_folder();
    void mark_taken(const std::set<NodeId>& taken);
    void apply_state(const PartialRun& state);
    void end_if_complete();
    void read_result();
    void show_result(OpenedRun run);

    Background& background_;
    ShownPair& pair_;
    Document& document_;
    Fetched& fetched_;
    std::optional<Followed> run_;
};

}  // namespace kerf::view

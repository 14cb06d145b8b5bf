// A run is followed by its events file, or, if another process has started it without one, by looking at its folder.
// Its trace and the surfaces of its parts are there when the stage "prepare" begins, and its report at its end.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/model/fetched.h"
#include "viewer/model/opened_run.h"
#include "viewer/model/run_events.h"

namespace kerf::view {

/// A run that a document follows: ours, or that of another process.
struct Followed {
    enum class TraceState { none, loading, known };
    std::optional<EventTail> tail;  ///< none: its folder is looked at
    std::string input, output, trace;
    std::vector<RunEvent> events;  ///< those that tell of parts
    TraceState trace_state = TraceState::none;
    std::optional<RunEvent> end;
    bool is_shown = false;   ///< the document shows this run and no older result any more
    bool is_ending = false;  ///< its report is being read
    std::chrono::steady_clock::time_point next_look = {};
    bool is_looking = false;
    std::optional<PartialRun> last_look;
    std::set<NodeId> finished;  ///< parts whose outcome is known
    // Of ours:
    std::shared_ptr<ScratchFolder> scratch;
    bool has_scratch_output = false;
    RunOptions options;              ///< as they were asked for
    std::optional<Document> before;  ///< what was shown; empty: nothing to compare with, or it was set aside

    std::string partial() const { return output + ".kerf-partial"; }
};

class RunFollower {
 public:
    RunFollower(Background& background, ShownPair& pair, Fetched& fetched)
        : background_(background), pair_(pair), document_(pair.now.document), fetched_(fetched) {}

    bool is_following() const { return run_.has_value(); }
    /// Its last event has come; its result may be being read.
    bool has_ended() const { return run_ && run_->end; }
    /// The run whose files are in a scratch folder.
    bool is_following(const std::shared_ptr<ScratchFolder>& scratch) const { return run_ && run_->scratch == scratch; }

    void follow(Followed run) { run_ = std::move(run); }
    /// One that another process makes, by its events.
    void follow_events(const std::string& path);
    /// One whose document is shown, as it was when it was looked at.
    void follow_folder(const std::string& output, const PartialRun& state);
    /// What a comparison shows beside the next run; may be empty. Leaves nothing to the one that is followed.
    std::optional<Document> take_before();
    void stop();

    /// Reads what is new; whether anything is. Looks at folders now and then. Once a frame.
    bool poll();
    /// The process of our run has ended. `reason`: why, if its events do not say so.
    void end_process(const std::string& reason, bool cancelled);
    /// The run that is followed, or was to be, ends here.
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

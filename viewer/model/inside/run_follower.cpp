// A run is followed by its events, or else by a look at DIR.kerf-partial four times a second. Both end alike:
// report.json is read and replaces all that was known (show_result()). Events do not tell which parts are being meshed,
// so that the folder is looked at for these, too (mark_taken()). The result before stays shown until a trace is there,
// or parts are announced without one (show_run_under_way()); then it becomes the other document. The end of a run comes
// from two sides, in any order: its last event or the end of its process, and the trace that is being read;
// end_if_complete() is called from each and goes on when both are there. A work may come back after another run was
// started: it is dropped with its scope, or asks is_following() first.
#include "viewer/model/inside/run_follower.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/geometry/box.h"
#include "run/prepare/cad_input.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

namespace {

std::string message_of(int exit_code, const Tree& tree) {
    if (exit_code == static_cast<int>(ErrorCode::verification)) return "The verification of the mesh has failed.";
    const auto failed = std::count_if(tree.rows.begin(), tree.rows.end(),
                                      [](const TreeRow& row) { return row.state == NodeState::failed; });
    return failed == 0 ? "" : fmt::format("{} part{} could not be meshed.", failed, failed == 1 ? "" : "s");
}

// Keeps the rows of parts that were not cut again.
void keep_known_rows(const Tree& known, Tree& tree) {
    for (TreeRow& row : tree.rows)
        if (const TreeRow* before = known.find(row.id); before && before->leaf() == row.leaf()) row = *before;
}

void set_states(const PartialRun& state, Tree& tree) {
    for (const NodeId part : state.parts)
        tree.at(part).state = state.finished.contains(part)                  ? NodeState::done
                              : state.failed.contains(part)                  ? NodeState::failed
                              : state.taken.contains(part) && state.is_alive ? NodeState::meshing
                                                                             : NodeState::waiting;
    for (const TreeRow& outcome : state.outcomes) {
        TreeRow& row = tree.at(outcome.id);
        row.tets = outcome.tets;
        row.core_tets = outcome.core_tets;
        row.filled_by = outcome.filled_by;
        row.seconds = outcome.seconds;
    }
}

}  // namespace

void RunFollower::follow_folder(const std::string& output, const PartialRun& state) {
    run_ = Followed();
    run_->output = output;
    run_->is_shown = true;
    apply_state(state);
}

std::optional<Document> RunFollower::take_before() {
    if (run_ && run_->before) return std::move(run_->before);
    if (!document_.progress.running && (document_.trace || !document_.folder.empty())) return document_;
    return {};
}

void RunFollower::stop() {
    run_.reset();
    background_.watch.reset();
}

bool RunFollower::poll() {
    const bool changed = poll_events();
    if (run_) look_at_folder();
    return changed;
}

// --- events ---

void RunFollower::follow_events(const std::string& path) {
    document_.kind = Document::Kind::run;
    document_.progress.running = true;
    run_ = Followed();
    run_->tail.emplace(path);
    poll_events();
}

bool RunFollower::poll_events() {
    if (!run_ || !run_->tail || run_->end) return false;
    const std::vector<RunEvent> events = run_->tail->read_new();
    for (const RunEvent& event : events) apply(event);
    if (!document_.progress.ours) end_if_complete();  // ours ends with its process
    return !events.empty();
}

void RunFollower::apply(const RunEvent& event) {
    apply_to_progress(event, document_.progress);
    switch (event.kind) {
        case RunEvent::Kind::run:
            if (document_.progress.ours) return;  // all that is known
            run_->input = event.input;
            run_->output = event.output;
            run_->trace = event.trace;
            document_.options.input = event.input;
            run_->options.input_options.scale = document_.options.input_options.scale = event.scale;
            show_input();
            return;
        case RunEvent::Kind::stage:
            if (event.stage != "read" && event.stage != "repair" && event.stage != "remesh" &&
                event.stage != "decompose")
                load_trace();
            return;
        case RunEvent::Kind::parts:
        case RunEvent::Kind::part:
            apply_parts(event);
            return;
        case RunEvent::Kind::end:
            run_->end = event;
            return;
        case RunEvent::Kind::other:
            return;
    }
}

void RunFollower::apply_parts(const RunEvent& event) {
    run_->events.push_back(event);
    load_trace();
    if (run_->is_shown)
        apply_to_tree(event, document_.tree);
    else if (run_->trace_state != Followed::TraceState::loading)
        show_run_under_way(nullptr);
    if (event.kind == RunEvent::Kind::parts && run_->is_shown) use_partial_folder();
}

// Shows the input, which is the first thing to be seen.
void RunFollower::show_input() {
    if (!exists(run_->input)) return;
    const auto read = [this, path = run_->input, input = run_->options.input_options]() -> Loader::Completion {
        const auto soup = std::make_shared<const Soup>(read_input_files(path, input).soup);
        return [this, soup, box = box_around_finite(soup->vertices)] {
            document_.soup = soup;
            if (!document_.box.isEmpty()) return;  // the trace or the report were faster
            document_.box = box;
            document_.patch_colours = soup->patch_colours;
            set_input(*soup, document_);
            document_.tree.at(root_node);
        };
    };
    background_.post(background_.open, read, [](const Error&) {});  // the run itself tells the error
}

void RunFollower::load_trace() {
    if (run_->trace_state != Followed::TraceState::none || !exists(run_->trace)) return;
    run_->trace_state = Followed::TraceState::loading;
    const auto show = [this](std::shared_ptr<const Trace> trace) {
        run_->trace_state = Followed::TraceState::known;
        show_run_under_way(std::move(trace));
        end_if_complete();
    };
    const auto read = [path = run_->trace, show]() -> Loader::Completion {
        return [show, trace = std::make_shared<const Trace>(read_trace(path))] { show(trace); };
    };
    // The reading belongs to the run: it is dropped when another run is started.
    background_.post(background_.watch, read, [this, show](const Error& error) {
        background_.note_failure(error);
        show(nullptr);
    });
}

// From now on the document is about this run. Without a trace the tree follows from the parts.
void RunFollower::show_run_under_way(std::shared_ptr<const Trace> trace) {
    if (run_->before) pair_.set_aside(std::move(*run_->before));
    run_->before.reset();
    fetched_.forget();
    document_.trace.reset();
    document_.folder.clear();
    document_.saved_as.clear();
    document_.histograms = {};
    document_.cut_seconds = document_.mesh_seconds = -1;
    document_.verified.reset();
    document_.tree = {};
    document_.remeshed = false;
    pair_.now.scratch = run_->scratch;
    run_->is_shown = true;
    if (trace) {
        set_input(*trace, document_);
        document_.tree = tree_of(*trace);
    }
    for (const RunEvent& event : run_->events) apply_to_tree(event, document_.tree);
    if (document_.tree.rows.empty()) document_.tree.at(root_node);
    if (trace) fetched_.use_trace(std::move(trace));
    use_partial_folder();
}

// The surfaces are there when the parts are announced.
void RunFollower::use_partial_folder() {
    if (run_->events.empty() || !exists(run_->partial())) return;
    document_.folder = run_->partial();
    const std::vector<NodeId> parts = document_.tree.parts_below(root_node);
    pair_.now.folder_parts = {parts.begin(), parts.end()};
}

// --- folders ---

void RunFollower::look_at_folder() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds period{250};
    const bool takes_turns = run_->tail.has_value();
    if (run_->is_looking || run_->is_ending || run_->end || Clock::now() < run_->next_look) return;
    if (takes_turns && (!run_->is_shown || document_.progress.stage != "volume")) return;
    run_->is_looking = true;
    const auto looked = [this, period] {
        run_->is_looking = false;
        run_->next_look = Clock::now() + period;
    };
    const auto look = [this, partial = run_->partial(), finished = run_->finished, takes_turns,
                       looked]() -> Loader::Completion {
        if (takes_turns)
            return [this, looked, taken = parts_taken(partial)] {
                looked();
                mark_taken(taken);
            };
        return [this, looked, state = look_at_partial_run(partial, finished)] {
            looked();
            apply_state(state);
        };
    };
    background_.post(background_.watch, look, [looked](const Error&) { looked(); });
}

void RunFollower::mark_taken(const std::set<NodeId>& taken) {
    bool any = false;
    for (const NodeId part : taken)
        if (TreeRow* row = document_.tree.find(part); row && row->state == NodeState::waiting) {
            row->state = NodeState::meshing;
            any = true;
        }
    if (!any) background_.note_in_vain();
}

void RunFollower::apply_state(const PartialRun& state) {
    if (!state.exists) {
        read_result();
        return;
    }
    const bool is_known = run_->last_look && run_->last_look->is_at_the_same(state);
    run_->last_look = state;
    if (is_known) {
        background_.note_in_vain();
        return;
    }
    if (state.parts != pair_.now.folder_parts && !document_.trace) {
        Tree tree = tree_of(std::vector<NodeId>(state.parts.begin(), state.parts.end()));
        keep_known_rows(document_.tree, tree);
        document_.tree = std::move(tree);
        pair_.now.store.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::surface; });
    }
    pair_.now.folder_parts = state.parts;
    set_states(state, document_.tree);
    for (const TreeRow& outcome : state.outcomes) run_->finished.insert(outcome.id);
    Progress& progress = document_.progress;
    progress.running = state.is_alive;
    progress.stage = "volume";
    progress.parts = std::ssize(state.parts);
    progress.parts_done = std::ssize(state.finished) + std::ssize(state.failed);
    progress.load_done = progress.parts > 0 ? static_cast<double>(progress.parts_done) / progress.parts : 0;
    progress.message =
        state.is_alive
            ? ""
            : fmt::format("The run was interrupted. kerf mesh --resume {} does the other parts.", run_->output);
}

// --- the end ---

void RunFollower::end_process(const std::string& reason, bool cancelled) {
    if (!run_) return;
    poll_events();  // the last ones
    if (!run_->end) {
        run_->end.emplace();
        run_->end->message = reason;
    }
    // The run cannot be continued, because its files go with the scratch folder.
    if (cancelled && run_->has_scratch_output && !run_->end->message.empty())
        run_->end->message = "The run was cancelled.";
    end_if_complete();
}

void RunFollower::end_if_complete() {
    if (!run_ || !run_->end || run_->is_ending) return;
    if (run_->trace_state == Followed::TraceState::loading) return;
    if (run_->end->message.empty() && !run_->output.empty())
        read_result();
    else
        end_without_result(run_->end->message, run_->end->exit_code);
}

void RunFollower::read_result() {
    run_->is_ending = true;
    const auto read = [this, folder = run_->output, own = run_->scratch]() -> Loader::Completion {
        return [this, own, run = read_run(folder)]() mutable {
            if (is_following(own)) show_result(std::move(run));
        };
    };
    background_.post(background_.open, read, [this, own = run_->scratch](const Error& error) {
        if (is_following(own)) end_without_result(error.what());
    });
}

// Interior vertices have got their numbers and the files their place.
void RunFollower::show_result(OpenedRun run) {
    if (!run_->is_shown) show_run_under_way(nullptr);
    Shown& now = pair_.now;
    if (document_.trace && !is_trace_of(*document_.trace, run.report.tree)) {
        document_.trace.reset();
        now.replayer.reset();
        now.store.clear();
    }
    fetched_.restart();
    now.store.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::cells; });
    const bool ours = document_.progress.ours;
    const int exit_code = run.report.exit_code;
    background_.note_failure(run.report.damage);
    complete_from_report(std::move(run), now);
    if (ours) {
        document_.options = run_->options;
        note_remeshing(document_.remeshed, document_);
    }
    document_.progress.running = document_.progress.ours = false;
    document_.progress.exit_code = exit_code;
    document_.progress.message = message_of(exit_code, document_.tree);
    stop();
    fetched_.prefetch_surfaces();
}

// `message` may be a member of run_, which stop() ends.
void RunFollower::end_without_result(const std::string& message, int exit_code) {
    document_.progress.running = document_.progress.ours = false;
    document_.progress.message = message;
    document_.progress.exit_code = exit_code;
    for (TreeRow& row : document_.tree.rows)
        if (row.state == NodeState::meshing) row.state = NodeState::waiting;
    const bool shown = run_ && run_->is_shown;
    stop();
    if (!shown || exists(document_.folder)) return;
    document_.folder.clear();
    pair_.now.folder_parts.clear();
    fetched_.restart();
    fetched_.prefetch_surfaces();
}

}  // namespace kerf::view

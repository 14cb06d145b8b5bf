// A run is followed by its events file, or, if another process has started it without one, by looking at its folder.
// Its trace and the surfaces of its parts are there when the stage "prepare" begins, and its report at its end.
#include "viewer/model/session_impl.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "prepare/cad_input.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/tree_source.h"

namespace kerf::view {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds period_of_looks{250};

std::string message_of(int exit_code, const Tree& tree) {
    if (exit_code == static_cast<int>(ErrorCode::verification)) return "The verification of the mesh has failed.";
    const auto failed = std::count_if(tree.rows.begin(), tree.rows.end(),
                                      [](const TreeRow& row) { return row.state == NodeState::failed; });
    return failed == 0 ? "" : fmt::format("{} part{} could not be meshed.", failed, failed == 1 ? "" : "s");
}

}  // namespace

// --- events ---

void Session::Impl::follow_events(const std::string& path) {
    opening_ = false;
    document_.kind = Document::Kind::run;
    document_.progress.running = true;
    followed_ = Followed();
    followed_->tail.emplace(path);
    poll_events();
}

bool Session::Impl::poll_run() {
    if (!leaving_.empty()) poll_leaving_processes();
    if (!followed_) return false;
    bool changed = poll_events();
    changed |= poll_process();
    if (followed_) look_at_folder();
    return changed;
}

bool Session::Impl::poll_events() {
    if (!followed_ || !followed_->tail || followed_->end) return false;
    const std::vector<RunEvent> events = followed_->tail->read_new();
    for (const RunEvent& event : events) apply(event);
    if (!process_ && !document_.progress.ours) end_if_complete();  // ours ends with its process
    return !events.empty();
}

void Session::Impl::apply(const RunEvent& event) {
    apply_to_progress(event, document_.progress);
    switch (event.kind) {
        case RunEvent::Kind::run:
            if (document_.progress.ours) return;  // all that is known
            followed_->input = event.input;
            followed_->output = event.output;
            followed_->trace = event.trace;
            document_.options.input = event.input;
            followed_->options.input_options.scale = document_.options.input_options.scale = event.scale;
            show_input_of_run();
            return;
        case RunEvent::Kind::stage:
            if (event.stage != "read" && event.stage != "repair" && event.stage != "remesh" &&
                event.stage != "decompose")
                load_trace_of_run();
            return;
        case RunEvent::Kind::parts:
        case RunEvent::Kind::part:
            followed_->events.push_back(event);
            load_trace_of_run();
            if (followed_->is_shown)
                apply_to_tree(event, document_.tree);
            else if (followed_->trace_state != Followed::TraceState::loading)
                show_run_under_way(nullptr);
            if (event.kind == RunEvent::Kind::parts && followed_->is_shown) use_partial_folder();
            return;
        case RunEvent::Kind::end:
            followed_->end = event;
            return;
        case RunEvent::Kind::other:
            return;
    }
}

// The first thing that is there to be seen.
void Session::Impl::show_input_of_run() {
    if (!exists(followed_->input)) return;
    const auto read = [this, path = followed_->input,
                       input = followed_->options.input_options]() -> Loader::Completion {
        const auto soup = std::make_shared<const Soup>(read_input_files(path, input).soup);
        Eigen::AlignedBox3d box;
        for (const Vec3& p : soup->vertices)
            if (p.allFinite()) box.extend(p);
        return [this, soup, box] {
            document_.soup = soup;
            if (!document_.box.isEmpty()) return;  // the trace or the report were faster
            document_.box = box;
            document_.patch_names = soup->patch_names;
            document_.patch_colours = soup->patch_colours;
            document_.input_facets = static_cast<std::int64_t>(soup->facets.size());
            document_.input_vertices = static_cast<std::int64_t>(soup->vertices.size());
            document_.tree.at(1);
        };
    };
    post(open_, read, [](const std::string&) {});  // the run itself says what is wrong with it
}

void Session::Impl::load_trace_of_run() {
    if (followed_->trace_state != Followed::TraceState::none || !exists(followed_->trace)) return;
    followed_->trace_state = Followed::TraceState::loading;
    const auto show = [this](std::shared_ptr<const Trace> trace) {
        followed_->trace_state = Followed::TraceState::known;
        show_run_under_way(std::move(trace));
        end_if_complete();
    };
    const auto read = [path = followed_->trace, show]() -> Loader::Completion {
        return [show, trace = std::make_shared<const Trace>(read_trace(path))] { show(trace); };
    };
    // Reading belongs to the run: another one that is started makes it void.
    post(watch_, read, [this, show](const std::string& message) {
        note_failure(message);
        show(nullptr);
    });
}

// From now on the document is about this run. Without a trace the tree follows from the parts.
void Session::Impl::show_run_under_way(std::shared_ptr<const Trace> trace) {
    if (followed_->before) set_aside(std::move(*followed_->before));
    followed_->before.reset();
    forget_data();
    document_.trace.reset();
    document_.folder.clear();
    document_.saved_as.clear();
    document_.histograms = {};
    document_.cut_seconds = document_.mesh_seconds = -1;
    document_.tree = {};
    document_.remeshed = false;
    scratch_ = followed_->scratch;
    followed_->is_shown = true;
    if (trace) {
        describe_trace_input(*trace);
        document_.tree = tree_of(*trace);
    }
    for (const RunEvent& event : followed_->events) apply_to_tree(event, document_.tree);
    if (document_.tree.rows.empty()) document_.tree.at(1);
    if (trace) use_trace(std::make_shared<Replayer>(std::move(trace), replayer_bytes));
    use_partial_folder();
}

// The surfaces are there when the parts are announced.
void Session::Impl::use_partial_folder() {
    if (followed_->events.empty() || !exists(followed_->partial())) return;
    document_.folder = followed_->partial();
    const std::vector<NodeId> parts = document_.tree.parts_below(1);
    folder_parts_ = {parts.begin(), parts.end()};
}

// --- folders ---

void Session::Impl::look_at_folder() {
    const bool takes_turns = followed_->tail.has_value();
    if (followed_->is_looking || followed_->is_ending || followed_->end || Clock::now() < followed_->next_look) return;
    if (takes_turns && (!followed_->is_shown || document_.progress.stage != "volume")) return;
    followed_->is_looking = true;
    const auto looked = [this] {
        followed_->is_looking = false;
        followed_->next_look = Clock::now() + period_of_looks;
    };
    const auto look = [this, partial = followed_->partial(), finished = followed_->finished, takes_turns,
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
    post(watch_, look, [looked](const std::string&) { looked(); });
}

void Session::Impl::mark_taken(const std::set<NodeId>& taken) {
    bool any = false;
    for (const NodeId part : taken)
        if (TreeRow* row = document_.tree.find(part); row && row->state == NodeState::waiting) {
            row->state = NodeState::meshing;
            any = true;
        }
    if (!any) ++looks_in_vain_;
}

void Session::Impl::apply_state(const PartialRun& state) {
    if (!state.exists) {
        read_result();
        return;
    }
    const bool is_known = followed_->last_look && followed_->last_look->is_at_the_same(state);
    followed_->last_look = state;
    if (is_known) {
        ++looks_in_vain_;
        return;
    }
    if (state.parts != folder_parts_ && !document_.trace) {
        Tree tree = tree_of(std::vector<NodeId>(state.parts.begin(), state.parts.end()));
        for (TreeRow& row : tree.rows)
            if (const TreeRow* known = document_.tree.find(row.id); known && known->leaf() == row.leaf()) row = *known;
        document_.tree = std::move(tree);
        store_.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::surface; });
    }
    folder_parts_ = state.parts;
    for (const NodeId part : state.parts) {
        TreeRow& row = document_.tree.at(part);
        row.state = state.finished.contains(part)                  ? NodeState::done
                    : state.failed.contains(part)                  ? NodeState::failed
                    : state.taken.contains(part) && state.is_alive ? NodeState::meshing
                                                                   : NodeState::waiting;
    }
    for (const TreeRow& outcome : state.outcomes) {
        TreeRow& row = document_.tree.at(outcome.id);
        row.tets = outcome.tets;
        row.core_tets = outcome.core_tets;
        row.filled_by = outcome.filled_by;
        row.seconds = outcome.seconds;
        followed_->finished.insert(outcome.id);
    }
    Progress& progress = document_.progress;
    progress.running = state.is_alive;
    progress.stage = "volume";
    progress.parts = static_cast<std::int64_t>(state.parts.size());
    progress.parts_done = static_cast<std::int64_t>(state.finished.size() + state.failed.size());
    progress.load_done = progress.parts > 0 ? static_cast<double>(progress.parts_done) / progress.parts : 0;
    progress.message =
        state.is_alive
            ? ""
            : fmt::format("The run was interrupted. kerf mesh --resume {} does the other parts.", followed_->output);
}

// --- the end ---

void Session::Impl::end_if_complete() {
    if (!followed_ || !followed_->end || followed_->is_ending) return;
    if (followed_->trace_state == Followed::TraceState::loading) return;
    if (followed_->end->message.empty() && !followed_->output.empty())
        read_result();
    else
        end_without_result(followed_->end->message, followed_->end->exit_code);
}

void Session::Impl::read_result() {
    followed_->is_ending = true;
    post(
        open_,
        [this, folder = followed_->output, own = followed_->scratch]() -> Loader::Completion {
            return [this, own, run = read_run(folder)]() mutable {
                if (followed_ && followed_->scratch == own) show_result(std::move(run));
            };
        },
        [this, own = followed_->scratch](const std::string& message) {
            if (followed_ && followed_->scratch == own) end_without_result(message);
        });
}

// Interior vertices have got their numbers and the files their place.
void Session::Impl::show_result(OpenedRun run) {
    if (!followed_->is_shown) show_run_under_way(nullptr);
    if (document_.trace && !is_trace_of(*document_.trace, run.report.tree)) {
        document_.trace.reset();
        replayer_.reset();
        store_.clear();
    }
    restart_data();
    store_.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::cells; });
    const bool ours = document_.progress.ours;
    const int exit_code = run.report.exit_code;
    complete_from_report(std::move(run));
    if (ours) {
        document_.options = followed_->options;
        note_remeshing(document_.remeshed);
    }
    document_.progress.running = document_.progress.ours = false;
    document_.progress.exit_code = exit_code;
    document_.progress.message = message_of(exit_code, document_.tree);
    followed_.reset();
    watch_.reset();
    if (replayer_) prefetch_surfaces();
}

void Session::Impl::end_without_result(const std::string& message, int exit_code) {
    document_.progress.running = document_.progress.ours = false;
    document_.progress.message = message;
    document_.progress.exit_code = exit_code;
    for (TreeRow& row : document_.tree.rows)
        if (row.state == NodeState::meshing) row.state = NodeState::waiting;
    const bool shown = followed_->is_shown;
    followed_.reset();
    watch_.reset();
    if (!shown || exists(document_.folder)) return;
    document_.folder.clear();
    folder_parts_.clear();
    restart_data();
    if (replayer_) prefetch_surfaces();
}

}  // namespace kerf::view

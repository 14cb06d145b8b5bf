// A run of ours is a process of `kerf mesh` or `kerf decompose`, followed by its events like any other run. Files that
// the user has not named lie in a scratch folder, which lives as long as the process or a document needs it. Where the
// input is not there any more, the surface of the trace is written into the scratch folder and meshed instead; that
// needs a trace of a single region. One run is followed at a time: a run that is left is interrupted, and kept in
// `leaving_` until it has ended or is overdue, when the destructor of its process kills it. An interrupted run writes
// all that is needed to continue it, which is why it gets that time.
#include "viewer/model/inside/own_runs.h"

#include <algorithm>

#include "viewer/model/file_kind.h"

namespace kerf::view {

namespace {

// Files that nobody has named lie in the scratch folder.
void name_files(RunRequest& options, Followed& run) {
    const ScratchFolder& scratch = *run.scratch;
    options.output = options.output.empty() ? scratch.file("run") : absolute_path(options.output);
    options.outputs.trace_file =
        options.outputs.trace_file.empty() ? scratch.file("run.trace") : absolute_path(options.outputs.trace_file);
    options.outputs.events_file = scratch.file("events");
    run.input = options.input;
    run.output = options.output;
    run.trace = options.outputs.trace_file;
    run.tail.emplace(options.outputs.events_file);
}

}  // namespace

void OwnRuns::start(RunRequest options, bool volume) {
    leave();
    Followed run;
    run.before = follower_.take_before();
    follower_.stop();
    background_.forget_failures();
    document_.progress = {};
    const bool is_input_there = exists(document_.options.input);
    if (!is_input_there && (!document_.trace || !document_.trace->sides.empty())) {
        document_.progress.message = "The surface of the run is not there any more. Open a surface first.";
        return;
    }
    try {
        run.scratch = std::make_shared<ScratchFolder>();
    } catch (const std::exception& error) {
        follower_.end_without_result(error.what());
        return;
    }
    options.input = is_input_there ? absolute_path(document_.options.input) : document_.options.input;
    options.volume = volume;
    if (!is_input_there) options.input_options.scale = 1;  // the surface of a trace is scaled already
    run.options = options;
    run.has_scratch_output = options.output.empty();
    const bool is_read_otherwise = !same_input(options.input_options, document_.options.input_options);
    document_.options = options;
    if (is_read_otherwise) repairs_.check_again();
    store_.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::on_surface; });  // of other sizes
    const std::shared_ptr<ScratchFolder> scratch = run.scratch;
    if (!is_input_there) options.input = scratch->file("surface.mesh");
    name_files(options, run);
    follower_.follow(std::move(run));
    document_.progress.running = document_.progress.ours = true;
    if (is_input_there)
        launch(options, scratch);
    else
        launch_on_surface_of_trace(options, scratch);
}

void OwnRuns::launch(const RunRequest& options, const std::shared_ptr<ScratchFolder>& scratch) {
    try {
        process_ = std::make_unique<RunProcess>(kerf_, command_line_of(options, options.volume), scratch);
    } catch (const std::exception& error) {
        follower_.end_without_result(error.what());
    }
}

void OwnRuns::launch_on_surface_of_trace(const RunRequest& options, const std::shared_ptr<ScratchFolder>& scratch) {
    if (document_.patch_names.size() > 1) document_.notes.push_back("The run does not know the names of the patches");
    const auto write = [this, trace = document_.trace, options, scratch]() -> Loader::Completion {
        write_surface_of(*trace, options.input);
        return [this, options, scratch] {
            if (follower_.is_following(scratch)) launch(options, scratch);
        };
    };
    background_.post(background_.open, write,
                     [this](const Error& error) { follower_.end_without_result(error.what()); });
}

void OwnRuns::cancel() {
    if (repairs_.is_repairing())
        repairs_.cancel();
    else if (process_)
        process_->interrupt();
    else if (document_.progress.ours && !follower_.has_ended())
        follower_.end_without_result("The run was cancelled.", static_cast<int>(ErrorCode::cancelled));
}

void OwnRuns::leave() {
    if (!process_) return;
    process_->interrupt();
    leaving_.push_back(std::move(process_));
}

bool OwnRuns::poll() {
    std::erase_if(leaving_, [](const auto& process) { return process->wait(0) || process->is_overdue(); });
    if (!process_ || !follower_.is_following()) return false;
    document_.progress.seconds = process_->seconds();
    const std::optional<ChildResult> result = process_->wait(0);
    if (!result && !process_->is_overdue()) return false;
    const bool cancelled = process_->was_interrupted();
    process_.reset();
    follower_.end_process(result ? reason_of(*result) : "The run did not end and was stopped.", cancelled);
    return true;
}

// A run that is asked to end writes all that is needed to continue it; one that does not end in time is killed.
void OwnRuns::end() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::seconds patience{2};
    leave();
    for (const auto& process : leaving_) process->interrupt();
    const auto end = Clock::now() + patience;
    for (const auto& process : leaving_)
        process->wait(std::max(0.0, std::chrono::duration<double>(end - Clock::now()).count()));
}

}  // namespace kerf::view

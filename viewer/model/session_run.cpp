// Runs that the viewer starts itself, as processes of their own: how they begin and how they are ended.
#include "viewer/model/session_impl.h"

#include <algorithm>

#include <fmt/format.h>

#include "viewer/model/file_kind.h"

namespace kerf::view {

std::string Session::Impl::input_of_next_run() const {
    const std::string& input = document_.options.input;
    return exists(input) ? absolute_path(input) : "";
}

// What a comparison shows beside the next run.
std::optional<Document> Session::Impl::document_before_next_run() {
    if (followed_ && followed_->before) return std::move(followed_->before);
    if (!document_.progress.running && (document_.trace || !document_.folder.empty())) return document_;
    return {};
}

// Files that nobody has named lie in the scratch folder.
void Session::Impl::follow_files_of(RunOptions& options) {
    const ScratchFolder& scratch = *followed_->scratch;
    options.output = options.output.empty() ? scratch.file("run") : absolute_path(options.output);
    options.trace_file = options.trace_file.empty() ? scratch.file("run.trace") : absolute_path(options.trace_file);
    options.events_file = scratch.file("events");
    followed_->input = options.input;
    followed_->output = options.output;
    followed_->trace = options.trace_file;
    followed_->tail.emplace(options.events_file);
}

void Session::Impl::start_run(RunOptions options, bool volume) {
    if (process_) {
        process_->interrupt();
        leaving_.push_back(std::move(process_));
    }
    std::optional<Document> before = document_before_next_run();
    watch_.reset();
    followed_.reset();
    failures_.clear();
    document_.progress = {};
    const std::string input = input_of_next_run();
    if (input.empty() && (!document_.trace || !document_.trace->sides.empty())) {
        document_.progress.message = "The surface of the run is not there any more. Open a surface first.";
        return;
    }
    try {
        followed_ = Followed();
        followed_->scratch = std::make_shared<ScratchFolder>();
    } catch (const std::exception& error) {
        end_without_result(error.what());
        return;
    }
    const ScratchFolder& scratch = *followed_->scratch;
    options.input = input.empty() ? document_.options.input : input;
    options.volume = volume;
    if (input.empty()) options.input_options.scale = 1;  // the surface of a trace is what was read
    followed_->options = options;
    followed_->has_scratch_output = options.output.empty();
    followed_->before = std::move(before);
    const bool checks_again =
        files_ && document_.checked && !same_input(options.input_options, document_.options.input_options);
    document_.options = options;
    if (checks_again) check_files_in_background();
    store_.erase_if([](const Store::Key& key) { return key.kind == Store::Kind::on_surface; });  // of other sizes
    options.input = input.empty() ? scratch.file("surface.mesh") : input;
    follow_files_of(options);
    document_.progress.running = document_.progress.ours = true;
    if (!input.empty()) {
        launch(options, volume);
        return;
    }
    if (document_.patch_names.size() > 1) document_.notes.push_back("The run does not know the names of the patches");
    const auto write = [this, trace = document_.trace, options, volume,
                        own = followed_->scratch]() -> Loader::Completion {
        write_surface_of(*trace, options.input);
        return [this, options, volume, own] {
            if (followed_ && followed_->scratch == own) launch(options, volume);
        };
    };
    post(open_, write, [this](const std::string& message) { end_without_result(message); });
}

void Session::Impl::launch(const RunOptions& options, bool volume) {
    try {
        process_ = std::make_unique<RunProcess>(kerf_program_, command_line_of(options, volume), followed_->scratch);
    } catch (const std::exception& error) {
        end_without_result(error.what());
    }
}

void Session::Impl::cancel_run() {
    if (is_repairing())
        cancel_repair();
    else if (process_)
        process_->interrupt();
    else if (document_.progress.ours && !followed_->end)
        end_without_result("The run was cancelled.", static_cast<int>(ErrorCode::cancelled));
}

bool Session::Impl::poll_process() {
    if (!process_) return false;
    document_.progress.seconds = process_->seconds();
    const std::optional<ChildResult> result = process_->wait(0);
    if (!result && !process_->is_overdue()) return false;
    const bool cancelled = process_->was_interrupted();
    process_.reset();
    poll_events();  // the last ones
    if (!followed_->end) {
        followed_->end.emplace();
        followed_->end->message = result ? reason_of(*result) : "The run did not end and was stopped.";
    }
    // What could be continued goes with the folder.
    if (cancelled && followed_->has_scratch_output && !followed_->end->message.empty())
        followed_->end->message = "The run was cancelled.";
    end_if_complete();
    return true;
}

void Session::Impl::poll_leaving_processes() {
    std::erase_if(leaving_, [](const auto& process) { return process->wait(0) || process->is_overdue(); });
}

}  // namespace kerf::view

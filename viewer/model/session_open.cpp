// What lies under a path is read on the loader's thread, as far as the first picture needs it; the rest follows.
#include "viewer/model/session_impl.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "prepare/cad_input.h"
#include "request/saved_run.h"
#include "surface/mass_properties.h"
#include "viewer/model/advice.h"
#include "viewer/model/node_surface.h"
#include "viewer/model/part_files.h"
#include "viewer/model/tree_source.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

Eigen::AlignedBox3d box_of(const std::vector<Vec3>& points) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points)
        if (p.allFinite()) box.extend(p);
    return box;
}

std::string title_of(const std::string& path, const std::vector<std::string>& more) {
    const auto name_of = [](const fs::path& clean) {
        return (clean.has_filename() ? clean : clean.parent_path()).filename().string();
    };
    if (more.empty()) return name_of(path);
    return name_of(path) + " + " + (more.size() == 1 ? name_of(more[0]) : fmt::format("{} files", more.size()));
}

std::string existing_path(const std::string& path, const std::string& beside) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return fs::absolute(path, ignored).lexically_normal().string();
    const fs::path other = fs::absolute(beside, ignored).parent_path() / fs::path(path).filename();
    return fs::exists(other, ignored) ? other.lexically_normal().string() : path;
}

// Those of the trace; an option of another version is no reason not to show it.
RunOptions options_for(const Trace& trace, const std::string& path) {
    RunOptions options;
    for (const OptionText& option : trace.options) {
        try {
            set_options(options, {option}, "The trace");
        } catch (const Error&) {
        }
    }
    options.input = existing_path(trace.input, path);
    return options;
}

// A run that is made from the options of another one shall not write over its files. Returns where its trace is.
std::string take_files(RunOptions& options, const std::string& folder) {
    std::string trace = options.trace_file.empty() ? "" : existing_path(options.trace_file, folder);
    std::error_code ignored;
    if (!trace.empty() && !fs::exists(trace, ignored)) trace = folder + ".trace";  // of a run that the viewer has saved
    for (std::string* file : {&options.report_file, &options.events_file, &options.trace_file}) file->clear();
    return trace;
}

std::shared_ptr<const Soup> read_soup_if_there(const std::string& path, const InputOptions& options) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return nullptr;
    try {
        return std::make_shared<const Soup>(read_input_files(path, options).soup);
    } catch (const Error&) {
        return nullptr;
    }
}

}  // namespace

void Session::Impl::close() {
    open_.reset();
    watch_.reset();
    mending_.reset();
    forget_data();
    if (process_) {
        process_->interrupt();
        leaving_.push_back(std::move(process_));
    }
    followed_.reset();
    scratch_.reset();
    other_.reset();
    shows_before_ = false;
    failures_.clear();
    document_ = {};
    files_.reset();
    history_.clear();
    opening_ = false;
}

void Session::Impl::open(const std::string& path, const RunOptions& options) {
    close();
    document_.path = path;
    document_.options = options;
    document_.title = title_of(path, options.input_options.more_files);
    opening_ = true;
    const auto read = [this, path, input = options.input_options]() -> Loader::Completion {
        try {
            return read_what_is_there(path, input);
        } catch (const Error& error) {
            return [this, code = error.code(), message = std::string(error.what())] { show_error(code, message); };
        }
    };
    post(open_, read, [this](const std::string& message) { show_error(ErrorCode::internal, message); });
}

void Session::Impl::reload() {
    if (document_.path.empty()) return;
    RunOptions options = document_.options;
    const bool is_result = document_.kind == Document::Kind::trace || document_.kind == Document::Kind::run;
    if (is_result) options.input_options.more_files.clear();  // of the files that it was made of
    open(std::string(document_.path), options);
}

Loader::Completion Session::Impl::read_what_is_there(const std::string& path, const InputOptions& input) {
    const OpenedPath what = tell_kind(path);
    if (!input.more_files.empty())
        for (const std::string& file : files_of(path, input))
            if (tell_kind(file).kind != OpenedPath::Kind::surface)
                throw Error(ErrorCode::usage,
                            fmt::format("{} is no surface: open it alone. Several files are opened together where each "
                                        "is the surface of a body.",
                                        file));
    switch (what.kind) {
        case OpenedPath::Kind::surface: {
            auto files = std::make_shared<const InputFiles>(read_input_files(path, input));
            auto surface = std::make_shared<const NodeSurface>(node_surface_of(files->soup));
            return [this, files, surface] { show_files(files, surface); };
        }
        case OpenedPath::Kind::trace: {
            auto trace = std::make_shared<const Trace>(read_trace(path));
            return [this, trace, options = options_for(*trace, path)] { show_trace(trace, options); };
        }
        case OpenedPath::Kind::events:
            return [this, path] { follow_events(path); };
        case OpenedPath::Kind::run:
            return [this, run = read_run(what.folder)]() mutable { show_run(std::move(run)); };
        case OpenedPath::Kind::partial_run:
            try {
                return [this, run = read_partial_run(what)] { show_partial_run(run); };
            } catch (const Error&) {
                if (tell_kind(what.folder).kind != OpenedPath::Kind::run) throw;
                return
                    [this, run = read_run(what.folder)]() mutable { show_run(std::move(run)); };  // it has just ended
            }
    }
    return {};
}

void Session::Impl::show_error(ErrorCode code, const std::string& message) {
    opening_ = false;
    document_.error_code = code;
    document_.error = message;
}

// The surface is there at once: it would wait for the check else.
void Session::Impl::show_files(const std::shared_ptr<const InputFiles>& files,
                               const std::shared_ptr<const NodeSurface>& surface) {
    const Soup* soup = &files->soup;
    opening_ = false;
    files_ = files;
    document_.kind = Document::Kind::surface;
    document_.soup = {files, soup};
    document_.box = box_of(soup->vertices);
    document_.patch_names = soup->patch_names;
    document_.patch_colours = soup->patch_colours;
    document_.notes = soup->notes;
    document_.input_vertices = static_cast<std::int64_t>(soup->vertices.size());
    document_.input_facets = static_cast<std::int64_t>(soup->facets.size());
    document_.options.input = fs::absolute(document_.path).lexically_normal().string();
    TreeRow& root = document_.tree.at(1);
    root.vertices = document_.input_vertices;
    root.facets = document_.input_facets;
    store_.insert({Store::Kind::surface, 1}, surface, bytes_of(*surface));
    check_files_in_background();
}

void Session::Impl::describe_trace_input(const Trace& trace) {
    document_.box = box_of(trace.surface.vertices);
    document_.patch_names = trace.patch_names;
    document_.region_names = trace.region_names;
    document_.region_places = region_places(trace);
    document_.input_vertices = static_cast<std::int64_t>(trace.surface.vertices.size());
    document_.input_facets = static_cast<std::int64_t>(trace.surface.facets.size());
    document_.volume = enclosed_volume(trace.surface.vertices, trace.surface.facets);
}

void Session::Impl::show_trace(std::shared_ptr<const Trace> trace, const RunOptions& options) {
    opening_ = false;
    document_.kind = Document::Kind::trace;
    document_.options = options;
    describe_trace_input(*trace);
    document_.tree = tree_of(*trace);
    use_trace(std::make_shared<Replayer>(std::move(trace), replayer_bytes));
}

Session::Impl::OpenedRun Session::Impl::read_run(const std::string& path) {
    OpenedRun run;
    run.solution = find_solution(path);
    const std::string folder = run.solution ? run.solution->mesh : path;
    run.folder = folder;
    run.report = read_report(folder);
    run.report.options.input = existing_path(run.report.options.input, folder);
    run.trace = take_files(run.report.options, folder);
    const std::vector<NodeId> parts = run.report.tree.parts_below(1);
    run.box = box_of_parts(folder, parts);
    if (const std::size_t count = run.report.region_names.size(); count > 0)
        run.region_places = region_places(folder, run.report.tree, count);
    if (!parts.empty()) read_part_surface(folder, parts.front(), &run.patch_names);
    return run;
}

// The tree, the numbers and the files of a finished run; a trace stays if its cuts are those of the run.
void Session::Impl::complete_from_report(OpenedRun run) {
    RunReportFile& report = run.report;
    if (!report.damage.empty()) note_failure(report.damage);
    document_.folder = run.folder;
    document_.solution = run.solution;
    document_.tree = std::move(report.tree);
    document_.options = report.options;
    document_.histograms = std::move(report.histograms);
    document_.region_names = std::move(report.region_names);
    document_.region_places = std::move(run.region_places);
    std::erase_if(document_.notes, [&](const std::string& note) {
        const std::optional<OptionText> advice = advised_option(note);
        if (!advice) return false;
        const bool is_done = report.remeshed && advice->name == "surface" && advice->text == "remesh";
        return is_done || is_set(document_.options, *advice);  // it was followed
    });
    for (const std::string& note : report.notes) add_note(note);
    note_remeshing(report.remeshed);
    document_.volume = report.volume;
    document_.cut_seconds = report.cut_seconds;
    document_.mesh_seconds = report.mesh_seconds;
    document_.box = run.box;
    document_.patch_names = run.patch_names;
    document_.input_facets = report.input_facets;
    document_.input_vertices = report.input_vertices;
    const std::vector<NodeId> parts = document_.tree.parts_below(1);
    folder_parts_ = {parts.begin(), parts.end()};
    Progress& progress = document_.progress;
    progress.parts = static_cast<std::int64_t>(parts.size());
    progress.parts_done = std::count_if(
        parts.begin(), parts.end(), [&](NodeId part) { return document_.tree.find(part)->state == NodeState::done; });
    progress.load_done = 1;
    progress.seconds = report.seconds;
}

// A run of the surface that is open repeats those of its reader.
void Session::Impl::add_note(const std::string& note) {
    std::vector<std::string>& notes = document_.notes;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

void Session::Impl::show_run(OpenedRun run) {
    opening_ = false;
    document_.kind = Document::Kind::run;
    const std::string trace = run.trace;
    complete_from_report(std::move(run));
    find_trace_of_run(trace);
}

// The run says where it has written its trace; a later run may have written another one there.
void Session::Impl::find_trace_of_run(const std::string& path) {
    std::error_code ignored;
    if (path.empty() || !fs::exists(path, ignored)) return;
    const auto read = [this, path, tree = document_.tree]() -> Loader::Completion {
        auto trace = std::make_shared<const Trace>(read_trace(path));
        if (!is_trace_of(*trace, tree)) return {};
        return [this, trace] { use_trace(std::make_shared<Replayer>(trace, replayer_bytes)); };
    };
    post(open_, read, [](const std::string&) {});  // the run can be shown without it
}

Session::Impl::OpenedPartialRun Session::Impl::read_partial_run(const OpenedPath& path) {
    OpenedPartialRun run;
    run.folder = path.folder;
    run.partial = path.partial;
    run.options = load_interrupted_run(path.folder);
    run.trace = take_files(run.options, path.folder);
    run.state = look_at_partial_run(path.partial, {});
    const std::vector<NodeId> parts(run.state.parts.begin(), run.state.parts.end());
    run.box = box_of_parts(path.partial, parts);
    if (!parts.empty()) read_part_surface(path.partial, parts.front(), &run.patch_names);
    run.soup = read_soup_if_there(run.options.input, run.options.input_options);
    if (run.soup && run.box.isEmpty()) run.box = box_of(run.soup->vertices);
    return run;
}

void Session::Impl::show_partial_run(const OpenedPartialRun& run) {
    opening_ = false;
    document_.kind = Document::Kind::run;
    document_.options = run.options;
    document_.folder = run.partial;
    document_.box = run.box;
    document_.patch_names = run.patch_names;
    if (run.soup) {
        document_.soup = run.soup;
        document_.input_facets = static_cast<std::int64_t>(run.soup->facets.size());
        document_.input_vertices = static_cast<std::int64_t>(run.soup->vertices.size());
    }
    followed_ = Followed();
    followed_->output = run.folder;
    followed_->is_shown = true;
    apply_state(run.state);
    find_trace_of_run(run.trace);
}

}  // namespace kerf::view

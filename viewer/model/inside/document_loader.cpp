// A path is opened in three steps. read() runs on the loader's thread: it tells the kind of the path and reads as much
// as the first picture needs. The completion that it returns runs on the first thread and fills the document
// (show_files(), show_trace(), show_run(), show_partial_run()). The rest is posted from there: the check of a surface,
// the trace of a run, the watch on a run that is under way. A run may end between the look at its folder and the
// reading; it is read as a finished one then. The trace of a run lies where its report says, but a later run may have
// written another one there: it is taken only if its cuts are those of the report.
#include "viewer/model/inside/document_loader.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "base/geometry/box.h"
#include "run/prepare/cad_input.h"
#include "viewer/model/inside/node_surface.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

std::string title_of(const std::string& path, const std::vector<std::string>& more) {
    const auto name_of = [](const fs::path& clean) {
        return (clean.has_filename() ? clean : clean.parent_path()).filename().string();
    };
    if (more.empty()) return name_of(path);
    return name_of(path) + " + " + (more.size() == 1 ? name_of(more[0]) : fmt::format("{} files", more.size()));
}

}  // namespace

void DocumentLoader::open(const std::string& path, const RunRequest& options) {
    Document& document = shown_.document;
    document.path = path;
    document.options = options;
    document.title = title_of(path, options.input_options.more_files);
    const auto work = [this, path, input = options.input_options]() -> Loader::Completion { return read(path, input); };
    background_.post(background_.open, work, [this](const Error& error) { show_error(error.code(), error.what()); });
}

Loader::Completion DocumentLoader::read(const std::string& path, const InputOptions& input) {
    const OpenedPath what = tell_kind(path);
    if (what.kind == OpenedPath::Kind::run && input.more_files.size() == 1) {
        const std::string& other = input.more_files.front();
        const OpenedPath beside = tell_kind(other);
        if (beside.kind == OpenedPath::Kind::run)
            return [this, other, before = read_run(what.folder), now = read_run(beside.folder)]() mutable {
                show_runs(std::move(before), std::move(now), other);
            };
    }
    if (!input.more_files.empty())
        for (const std::string& file : files_of(path, input))
            if (tell_kind(file).kind != OpenedPath::Kind::surface)
                throw Error(ErrorCode::usage,
                            fmt::format("{} is no surface: open it alone. Several files are opened together where each "
                                        "is the surface of a body, and two finished runs to be compared.",
                                        file));
    switch (what.kind) {
        case OpenedPath::Kind::surface: {
            auto files = std::make_shared<const InputFiles>(read_input_files(path, input));
            auto surface = std::make_shared<const NodeSurface>(node_surface_of(files->soup));
            return [this, files, surface] { show_files(files, surface); };
        }
        case OpenedPath::Kind::trace: {
            auto trace = std::make_shared<const Trace>(read_trace(path));
            return [this, trace, options = options_of(*trace, path)] { show_trace(trace, options); };
        }
        case OpenedPath::Kind::events:
            return [this, path] { follower_.follow_events(path); };
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

void DocumentLoader::show_error(ErrorCode code, const std::string& message) {
    shown_.document.error_code = code;
    shown_.document.error = message;
}

// The surface is shown at once, and does not wait for its check.
void DocumentLoader::show_files(const std::shared_ptr<const InputFiles>& files,
                                const std::shared_ptr<const NodeSurface>& surface) {
    Document& document = shown_.document;
    document.kind = Document::Kind::surface;
    document.soup = {files, &files->soup};
    document.box = box_around_finite(files->soup.vertices);
    document.patch_colours = files->soup.patch_colours;
    document.notes = files->soup.notes;
    set_input(files->soup, document);
    document.options.input = fs::absolute(document.path).lexically_normal().string();
    TreeRow& root = document.tree.at(root_node);
    root.vertices = document.input_vertices;
    root.facets = document.input_facets;
    shown_.store.insert({Store::Kind::surface, root_node}, surface, bytes_of(*surface));
    repairs_.begin(files);
}

void DocumentLoader::show_trace(std::shared_ptr<const Trace> trace, const RunRequest& options) {
    Document& document = shown_.document;
    document.kind = Document::Kind::trace;
    document.options = options;
    set_input(*trace, document);
    document.tree = tree_of(*trace);
    fetched_.use_trace(std::move(trace));
}

void DocumentLoader::show_run(OpenedRun run) {
    shown_.document.kind = Document::Kind::run;
    const std::string trace = run.trace;
    background_.note_failure(run.report.damage);
    complete_from_report(std::move(run), shown_);
    find_trace_of_run(trace);
}

// The first run is the one before, without its trace, which would come too late. The second one is shown.
void DocumentLoader::show_runs(OpenedRun before, OpenedRun now, const std::string& path) {
    Document& document = shown_.document;
    document.kind = Document::Kind::run;
    document.title = title_of(document.path, {});
    background_.note_failure(before.report.damage);
    complete_from_report(std::move(before), shown_);
    pair_.set_aside(std::exchange(document, {}));
    document.path = path;
    document.title = title_of(path, {});
    show_run(std::move(now));
}

void DocumentLoader::show_partial_run(const OpenedPartialRun& run) {
    Document& document = shown_.document;
    document.kind = Document::Kind::run;
    document.options = run.options;
    document.folder = run.partial;
    document.soup = run.soup;
    if (run.soup) set_input(*run.soup, document);
    document.box = run.box;
    document.patch_names = run.patch_names;
    follower_.follow_folder(run.folder, run.state);
    find_trace_of_run(run.trace);
}

// The run says where it has written its trace; a later run may have written another one there.
void DocumentLoader::find_trace_of_run(const std::string& path) {
    if (!exists(path)) return;
    const auto work = [this, path, tree = shown_.document.tree]() -> Loader::Completion {
        auto trace = std::make_shared<const Trace>(read_trace(path));
        if (!is_trace_of(*trace, tree)) return {};
        return [this, trace] { fetched_.use_trace(trace); };
    };
    background_.post(background_.open, work, [](const Error&) {});  // the run can be shown without it
}

}  // namespace kerf::view

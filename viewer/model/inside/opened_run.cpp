// A run is read as far as the first picture needs it: its report or request, the box of its parts, the places of its
// regions. Paths in a report or trace may be out of date, because folders are moved: a file that is not at its path is
// looked for by its name beside the run (existing_path()). The options of the run become those of the next one, so that
// the names of files that the run has written are taken out of them (take_files()): a run that is made from the options
// of another one must not write over its files. Notes whose advice the run has followed leave the document.
// What a run that is under way has done is told by the names of the files in its folder; its lock tells whether it
// lives.
#include "viewer/model/inside/opened_run.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/core/host_name.h"
#include "base/geometry/box.h"
#include "files/io/run_folder.h"
#include "files/part/vtu_reader.h"
#include "run/request/saved_run.h"
#include "run/work/journal.h"
#include "surface/complex/mass_properties.h"
#include "viewer/model/advice.h"
#include "viewer/model/inside/part_files.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

std::string existing_path(const std::string& path, const std::string& beside) {
    std::error_code ignored;
    if (fs::exists(path, ignored)) return fs::absolute(path, ignored).lexically_normal().string();
    const fs::path other = fs::absolute(beside, ignored).parent_path() / fs::path(path).filename();
    return fs::exists(other, ignored) ? other.lexically_normal().string() : path;
}

// A run that is made from the options of another one shall not write over its files. Returns the path of its trace.
std::string take_files(RunRequest& options, const std::string& folder) {
    std::string trace = options.outputs.trace_file.empty() ? "" : existing_path(options.outputs.trace_file, folder);
    if (!trace.empty() && !exists(trace)) trace = folder + ".trace";  // of a run that the viewer has saved
    for (std::string* file : {&options.outputs.report_file, &options.outputs.events_file, &options.outputs.trace_file})
        file->clear();
    return trace;
}

// The number between a prefix and an ending; no_node if the name is another one.
NodeId number_in(const std::string& name, std::string_view prefix, std::string_view ending) {
    std::int32_t number = 0;
    if (!name.starts_with(prefix) || !name.ends_with(ending) || name.size() < prefix.size() + ending.size())
        return no_node;
    const char* end = name.data() + name.size() - ending.size();
    const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, number);
    return error == std::errc() && stop == end && number > 0 ? NodeId(number) : no_node;
}

// Large runs have folders below, which are searched, too.
std::set<NodeId> numbers_in(const fs::path& folder, std::string_view prefix, std::string_view ending) {
    std::set<NodeId> numbers;
    std::error_code error;
    for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        std::error_code ignored;
        const NodeId number = number_in(entry->path().filename(), prefix, ending);
        if (number != no_node && !entry->is_directory(ignored)) numbers.insert(number);
    }
    return numbers;
}

// The lock holds "process 123 on host". To try the lock itself could keep a run out that starts at this moment.
bool is_alive(const fs::path& partial) {
    std::ifstream file(partial / "work/lock");
    std::string word, host;
    pid_t process = 0;
    file >> word >> process >> word >> host;
    if (process <= 0) return false;
    return host != host_name() || ::kill(process, 0) == 0 || errno == EPERM;
}

std::shared_ptr<const Soup> read_soup_if_there(const std::string& path, const InputOptions& options) {
    if (!exists(path)) return nullptr;
    try {
        return std::make_shared<const Soup>(read_input_files(path, options).soup);
    } catch (const Error&) {
        return nullptr;
    }
}

}  // namespace

RunRequest options_of(const Trace& trace, const std::string& path) {
    RunRequest options;
    for (const OptionText& option : trace.options) {
        try {
            set_options(options, {option}, "The trace");
        } catch (const Error&) {
        }
    }
    options.input = existing_path(trace.input, path);
    return options;
}

OpenedRun read_run(const std::string& path) {
    OpenedRun run;
    run.solution = find_solution(path);
    const std::string folder = run.solution ? run.solution->mesh : path;
    run.folder = folder;
    run.report = read_report(folder);
    run.report.options.input = existing_path(run.report.options.input, folder);
    run.trace = take_files(run.report.options, folder);
    const std::vector<NodeId> parts = run.report.tree.parts_below(root_node);
    run.box = box_of_parts(folder, parts);
    if (const std::size_t count = run.report.region_names.size(); count > 0)
        run.region_places = region_places(folder, run.report.tree, count);
    run.patch_names = run.report.patch_names;
    if (!parts.empty() && run.patch_names.empty()) read_part_surface(folder, parts.front(), &run.patch_names);
    return run;
}

std::set<NodeId> parts_taken(const std::string& partial) { return numbers_in(partial + "/work/taken", "", ""); }

PartialRun look_at_partial_run(const std::string& partial, const std::set<NodeId>& known) {
    PartialRun run;
    std::error_code ignored;
    run.exists = fs::is_directory(partial, ignored);
    if (!run.exists) return run;
    run.is_alive = is_alive(partial);
    run.parts = numbers_in(partial + "/parts", "part_", ".surface.vtu");
    std::erase_if(run.parts, [&](NodeId part) {
        return !is_complete_part_file(partial + "/parts/" + part_surface_file_name(part));
    });
    run.taken = parts_taken(partial);
    run.failed = numbers_in(partial + "/failed", "part_", ".txt");
    for (const NodeId part : numbers_in(partial + "/work/journal", "", "")) {
        if (known.contains(part)) {
            run.finished.insert(part);
            continue;
        }
        const auto entry = read_journal_entry(partial + "/" + journal_file_name(part));
        if (!entry) continue;
        run.finished.insert(part);
        TreeRow row;
        row.id = part;
        row.tets = entry->outcome.result.tets;
        row.core_tets = entry->outcome.result.core_tets;
        row.filled_by = name_of_filler(entry->outcome.result.mesher, entry->outcome.result.strategy);
        row.seconds = entry->outcome.seconds;
        run.outcomes.push_back(row);
    }
    return run;
}

OpenedPartialRun read_partial_run(const OpenedPath& path) {
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
    if (run.soup && run.box.isEmpty()) run.box = box_around_finite(run.soup->vertices);
    return run;
}

void complete_from_report(OpenedRun run, Shown& shown) {
    Document& document = shown.document;
    RunReportFile& report = run.report;
    document.folder = run.folder;
    document.solution = run.solution;
    document.tree = std::move(report.tree);
    document.options = report.options;
    document.histograms = std::move(report.histograms);
    document.region_names = std::move(report.region_names);
    document.region_places = std::move(run.region_places);
    std::erase_if(document.notes, [&](const std::string& note) {
        const std::optional<OptionText> advice = advised_option(note);
        if (!advice) return false;
        const bool is_done = report.remeshed && advice->name == "surface" && advice->text == "remesh";
        return is_done || is_set(document.options, *advice);  // it was followed
    });
    for (const std::string& note : report.notes) add_note(note, document);
    note_remeshing(report.remeshed, document);
    document.volume = report.volume;
    document.cut_seconds = report.cut_seconds;
    document.mesh_seconds = report.mesh_seconds;
    document.verified = report.verified;
    document.box = run.box;
    document.patch_names = run.patch_names;
    document.input_facets = report.input_facets;
    document.input_vertices = report.input_vertices;
    const std::vector<NodeId> parts = document.tree.parts_below(root_node);
    shown.folder_parts = {parts.begin(), parts.end()};
    Progress& progress = document.progress;
    progress.parts = std::ssize(parts);
    progress.parts_done = std::count_if(
        parts.begin(), parts.end(), [&](NodeId part) { return document.tree.find(part)->state == NodeState::done; });
    progress.load_done = 1;
    progress.seconds = report.seconds;
}

void set_input(const Soup& soup, Document& document) {
    document.patch_names = soup.patch_names;
    document.input_vertices = std::ssize(soup.vertices);
    document.input_facets = std::ssize(soup.facets);
}

void set_input(const Trace& trace, Document& document) {
    document.box = box_around_finite(trace.surface.vertices);
    document.patch_names = trace.patch_names;
    document.region_names = trace.region_names;
    document.region_places = region_places(trace);
    document.input_vertices = std::ssize(trace.surface.vertices);
    document.input_facets = std::ssize(trace.surface.facets);
    document.volume = enclosed_volume(trace.surface.vertices, trace.surface.facets);
}

void note_remeshing(bool remeshed, Document& document) {
    document.remeshed = remeshed && exists(document.options.input);
}

void add_note(const std::string& note, Document& document) {
    std::vector<std::string>& notes = document.notes;
    if (std::find(notes.begin(), notes.end(), note) == notes.end()) notes.push_back(note);
}

}  // namespace kerf::view

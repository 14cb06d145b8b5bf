// A run changes places with the one before only where nothing is under way for either. Cuts that are made again wait in
// a queue, because each changes the trace of which the next one is made; the document before each is set aside whole. A
// run is saved by a copy of its folder, which appears complete or not at all: RunFolder writes beside the place and
// moves the folder at the end. Nothing is replaced there but a run and a trace of Kerf.
#include "viewer/model/inside/run_pair.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/folder_files.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/inside/tree_source.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

void copy_to(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    if (!error) fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot write {}: {}. Check the permissions and the free space there, "
                                               "or choose another folder.",
                                               to.string(), error.message()));
}

void require_replaceable_trace(const std::string& path) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(path, error))) return;
    if (!fs::is_regular_file(path, error) || tell_kind(path).kind != OpenedPath::Kind::trace)
        throw Error(ErrorCode::io, fmt::format("{} is not a trace of Kerf, so it is not replaced. Choose another "
                                               "folder, or move it away.",
                                               path));
}

// Copies the finished run in `folder` to `path`, which appears complete or not at all, and its trace, if there is one,
// beside it, to its name and ".trace". Only a run of Kerf and a trace are ever replaced. Returns the absolute path of
// the run, which is `path`.failed for one with failed parts if a valid one has that name. Throws Error(io).
std::string copy_run(const std::string& folder, const std::string& trace, const std::string& path) {
    if (path.empty()) throw Error(ErrorCode::io, "Say where the run shall be saved: a folder that does not exist yet.");
    const std::string full = absolute_path(path);
    std::error_code ignored;
    const bool has_trace = fs::exists(trace, ignored);
    if (has_trace)
        for (const char* end : {".trace", ".failed.trace"}) require_replaceable_trace(full + end);
    RunFolder copy = RunFolder::create(full);
    if (copy.finished_parts() > 0)
        throw Error(ErrorCode::io, fmt::format("An interrupted run into {} would be lost. Choose another folder, or "
                                               "remove {}.",
                                               full, copy.partial_path()));
    copy.keep_only({});
    for (const std::string& file : list_files(folder))
        if (!file.ends_with('/')) copy_to(fs::path(folder) / file, copy.file(file));
    const std::string place = copy.commit(inspect_run_folder(folder).is_valid);
    if (has_trace) copy_to(trace, place + ".trace");
    return place;
}

}  // namespace

bool RunPair::can_swap() const {
    return pair_.other && !follower_.is_following() && background_.repair.jobs == 0 && background_.redo.jobs == 0 &&
           background_.open.jobs == 0 && now_.cuts_again.empty();
}

void RunPair::swap() {
    if (!can_swap()) return;
    fetched_.restart();
    background_.forget_failures();
    pair_.swap();
    fetched_.prefetch_surfaces();
}

// A cut that was made again is in no folder.
bool RunPair::is_unsaved(const Shown& run) {
    const Document& document = run.document;
    if (!run.scratch || document.folder != run.scratch->file("run") || !document.saved_as.empty()) return false;
    const std::vector<NodeId> parts = document.tree.parts_below(root_node);
    return std::all_of(parts.begin(), parts.end(), [&](NodeId part) { return run.folder_parts.contains(part); });
}

void RunPair::save(const std::string& path) {
    if (can_save()) save(now_, path);
}

void RunPair::save_other(const std::string& path) {
    if (can_save_other()) save(*pair_.other, path);
}

// The two may change places meanwhile.
void RunPair::save(const Shown& run, const std::string& path) {
    background_.forget_failures();
    const auto copy = [this, folder = run.document.folder, path, kept = run.scratch]() -> Loader::Completion {
        const std::string place = copy_run(folder, kept->file("run.trace"), path);
        return [this, folder, place] {
            if (now_.document.folder == folder) now_.document.saved_as = place;
            if (pair_.other && pair_.other->document.folder == folder) pair_.other->document.saved_as = place;
        };
    };
    background_.post(background_.open, copy);
}

void RunPair::redo_cut(NodeId node, const RunRequest& options, const std::optional<Plane>& plane) {
    background_.forget_failures();
    if (!now_.replayer || !now_.document.tree.find(node)) {
        background_.note_failure("A cut can be made again where a trace of the run is open.");
        return;
    }
    now_.cuts_again.push_back({node, options, plane});
    start_redo();
}

// Cuts are made one after the other, because each changes the trace.
void RunPair::start_redo() {
    if (background_.redo.jobs > 0 || now_.cuts_again.empty()) return;
    const CutAgain cut = std::move(now_.cuts_again.front());
    now_.cuts_again.pop_front();
    const auto work = [this, replayer = now_.replayer, cut]() -> Loader::Completion {
        return [this, node = cut.node, redone = view::redo_cut(*replayer, cut.node, cut.options, cut.plane)] {
            take_redone(node, redone);
        };
    };
    background_.post(background_.redo, work, [this](const Error& error) {
        background_.note_failure(error);
        start_redo();
    });
}

void RunPair::take_redone(NodeId node, const RedoneCut& redone) {
    Document& document = now_.document;
    pair_.set_aside(document);
    now_.store.share(pair_.other->store);
    document.histograms = {};
    document.cut_seconds = document.mesh_seconds = -1;
    document.verified.reset();
    document.progress.message.clear();
    document.saved_as.clear();
    const auto is_gone = [&](NodeId id) { return id != node && lies_below(id, node); };
    std::erase_if(document.tree.rows, [&](const TreeRow& row) { return is_gone(row.id); });
    for (TreeRow row : redone.rows) {
        if (row.id == node && document.tree.find(node)) row.load = document.tree.find(node)->load;
        document.tree.at(row.id) = row;
    }
    count_leaves(document.tree);
    std::erase_if(now_.folder_parts, [&](NodeId id) { return lies_below(id, node); });
    now_.store.erase_if([&](const Store::Key& key) {
        return key.kind == Store::Kind::worst_cells || key.kind == Store::Kind::on_surface ||
               (key.node > no_node && lies_below(key.node, node));
    });
    fetched_.restart();
    now_.replayer = redone.replayer;
    document.trace = redone.replayer->trace();
    fetched_.prefetch_surfaces();
    start_redo();
}

}  // namespace kerf::view

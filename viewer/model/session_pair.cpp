// The document before the last change, with all that belongs to it: it can be shown again at once. One such change is a
// cut that is made again.
#include "viewer/model/session_impl.h"

#include <algorithm>
#include <utility>

#include "viewer/model/saved_copy.h"

namespace kerf::view {

// What follows belongs to a new document, whose store is empty.
void Session::Impl::set_aside(Document before) {
    other_ = Shown();
    other_->document = std::move(before);
    other_->replayer = replayer_;
    other_->folder_parts = folder_parts_;
    other_->scratch = scratch_;
    std::swap(other_->store, store_);
    other_->store.shrink(bytes_aside);
    shows_before_ = false;
}

bool Session::Impl::can_swap_runs() const {
    return other_ && !followed_ && !is_repairing() && !redoing_ && redo_queue_.empty() && !opening_ && open_.jobs == 0;
}

void Session::Impl::swap_runs() {
    if (!can_swap_runs()) return;
    restart_data();
    failures_.clear();
    std::swap(other_->document, document_);
    std::swap(other_->replayer, replayer_);
    std::swap(other_->folder_parts, folder_parts_);
    std::swap(other_->scratch, scratch_);
    std::swap(other_->store, store_);
    other_->store.shrink(bytes_aside);
    shows_before_ = !shows_before_;
    if (replayer_) prefetch_surfaces();
}

// A cut that was made again is in no folder.
bool Session::Impl::can_save_run() const {
    if (!scratch_ || followed_ || open_.jobs > 0 || document_.folder != scratch_->file("run")) return false;
    const std::vector<NodeId> parts = document_.tree.parts_below(1);
    return document_.saved_as.empty() &&
           std::all_of(parts.begin(), parts.end(), [&](NodeId part) { return folder_parts_.contains(part); });
}

void Session::Impl::save_run(const std::string& path) {
    if (!can_save_run()) return;
    failures_.clear();
    const auto copy = [this, folder = document_.folder, trace = scratch_->file("run.trace"), path,
                       kept = scratch_]() -> Loader::Completion {
        const std::string place = copy_run(folder, trace, path);
        return [this, folder, place] {
            if (document_.folder == folder) document_.saved_as = place;
            if (other_ && other_->document.folder == folder) other_->document.saved_as = place;
        };
    };
    post(open_, copy, [this](const std::string& message) { note_failure(message); });
}

void Session::Impl::redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) {
    failures_.clear();
    if (!replayer_ || !document_.tree.find(node)) {
        note_failure("A cut can be made again where a trace of the run is open.");
        return;
    }
    redo_queue_.push_back({node, options, plane});
    start_redo();
}

// One after the other: each changes the trace.
void Session::Impl::start_redo() {
    if (redoing_ || redo_queue_.empty()) return;
    const Redo redo = redo_queue_.front();
    redo_queue_.pop_front();
    redoing_ = true;
    const auto work = [this, replayer = replayer_, redo]() -> Loader::Completion {
        const auto redone = std::make_shared<RedoneCut>(view::redo_cut(*replayer, redo.node, redo.options, redo.plane));
        return [this, id = redo.node, redone] { take_redone(id, std::move(*redone)); };
    };
    post(data_, work, [this](const std::string& message) {
        redoing_ = false;
        note_failure(message);
        start_redo();
    });
}

void Session::Impl::take_redone(NodeId node, RedoneCut redone) {
    set_aside(document_);
    store_.share(other_->store);
    document_.histograms = {};
    document_.cut_seconds = document_.mesh_seconds = -1;
    document_.progress.message.clear();
    document_.saved_as.clear();
    const auto is_gone = [&](NodeId id) { return id != node && lies_below(id, node); };
    std::erase_if(document_.tree.rows, [&](const TreeRow& row) { return is_gone(row.id); });
    for (TreeRow& row : redone.rows) {
        if (row.id == node && document_.tree.find(node)) row.load = document_.tree.find(node)->load;
        document_.tree.at(row.id) = row;
    }
    count_leaves(document_.tree);
    std::erase_if(folder_parts_, [&](NodeId id) { return lies_below(id, node); });
    store_.erase_if([&](const Store::Key& key) {
        return key.kind == Store::Kind::worst_cells || key.kind == Store::Kind::on_surface ||
               (key.node > 0 && lies_below(key.node, node));
    });
    restart_data();
    replayer_ = redone.replayer;
    document_.trace = redone.replayer->trace();
    prefetch_surfaces();
    start_redo();
}

}  // namespace kerf::view

// The document before the last change, with all that belongs to it: it can be shown again at once.
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
    return other_ && !followed_ && !redoing_ && redo_queue_.empty() && !opening_ && open_.jobs == 0;
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

}  // namespace kerf::view

// Operations on the run that is shown: it changes places with the one before, a cut is made again, it is saved.
#pragma once

#include <optional>
#include <string>

#include "viewer/model/inside/redo.h"
#include "viewer/model/inside/run_follower.h"

namespace kerf::view {

/// Changes, compares and saves the shown run.
class RunPair {
 public:
    RunPair(Background& background, ShownPair& pair, Fetched& fetched, const RunFollower& follower)
        : background_(background), pair_(pair), now_(pair.now), fetched_(fetched), follower_(follower) {}

    /// Shows Session::other_document(), unless anything is under way.
    void swap();
    bool can_swap() const;

    /// Makes the cut of one node again with other options, in the background; needs a trace. The result takes the
    /// place of that cut in Document::trace; the cuts and parts below it are gone, and so are measures of the whole
    /// run. The cut is made at `plane` if there is one, else where it was (view::redo_cut()).
    void redo_cut(NodeId node, const RunRequest& options, const std::optional<Plane>& plane = {});

    /// Return whether the shown run, or Session::other_document(), is a finished one that is removed with this session
    /// and was not saved yet.
    bool is_unsaved() const { return is_unsaved(now_); }
    bool is_other_unsaved() const { return pair_.other && is_unsaved(*pair_.other); }
    /// Return whether it can be saved now: nothing is being read or saved.
    /// Returns whether cuts are being made again, or wait for it.
    bool is_redoing() const { return background_.redo.jobs > 0 || !now_.cuts_again.empty(); }
    bool can_save() const { return is_unsaved() && is_idle(); }
    bool can_save_other() const { return is_other_unsaved() && is_idle(); }
    /// Copies that run, in the background, to a place where it stays, as kerf mesh would have written it there: only a
    /// run of Kerf is ever replaced. Its trace goes beside it, to its name and ".trace". At the end Document::saved_as
    /// is the folder, or Session::failures() has the error.
    void save(const std::string& path);
    void save_other(const std::string& path);

 private:
    static bool is_unsaved(const Shown& run);
    bool is_idle() const { return !follower_.is_following() && background_.open.jobs == 0; }
    void save(const Shown& run, const std::string& path);
    void start_redo();
    void take_redone(NodeId node, const RedoneCut& redone);

    Background& background_;
    ShownPair& pair_;
    Shown& now_;
    Fetched& fetched_;
    const RunFollower& follower_;
};

}  // namespace kerf::view

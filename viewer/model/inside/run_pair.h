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

    /// Returns whether a finished run is open that is removed with this session and was not saved yet.
    bool can_save() const;
    /// Copies that run, in the background, to a place where it stays, as kerf mesh would have written it there: only a
    /// run of Kerf is ever replaced. Its trace goes beside it, to its name and ".trace". At the end Document::saved_as
    /// is the folder, or Session::failures() has the error.
    void save(const std::string& path);

 private:
    void start_redo();
    void take_redone(NodeId node, const RedoneCut& redone);

    Background& background_;
    ShownPair& pair_;
    Shown& now_;
    Fetched& fetched_;
    const RunFollower& follower_;
};

}  // namespace kerf::view

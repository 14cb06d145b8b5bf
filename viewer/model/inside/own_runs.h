// Runs that the viewer starts itself, as processes of their own: how they begin and how they are ended.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/inside/repairs.h"
#include "viewer/model/inside/run_follower.h"

namespace kerf::view {

/// Starts runs, one of which is followed, and ends them.
class OwnRuns {
 public:
    /// `kerf`: the path of the program that makes them.
    OwnRuns(std::string kerf, Background& background, Shown& shown, Repairs& repairs, RunFollower& follower)
        : kerf_(std::move(kerf)),
          background_(background),
          document_(shown.document),
          store_(shown.store),
          repairs_(repairs),
          follower_(follower) {}

    /// Do as Session::start_run() and Session::cancel_run() say.
    void start(RunRequest options, bool volume);
    void cancel();

    /// Interrupts our run, whose end nobody waits for.
    void leave();
    /// Returns whether runs that were left are still there.
    bool are_leaving() const { return !leaving_.empty(); }
    /// Returns whether our run has ended; called once a frame. Kills runs that do not end in time after an interrupt.
    bool poll();
    /// Interrupts all runs, and waits for two seconds at most; those that have not ended then are killed by the
    /// destructor.
    void end();

 private:
    void launch(const RunRequest& options, const std::shared_ptr<ScratchFolder>& scratch);
    void launch_on_surface_of_trace(const RunRequest& options, const std::shared_ptr<ScratchFolder>& scratch);

    std::string kerf_;
    Background& background_;
    Document& document_;
    Store& store_;
    Repairs& repairs_;
    RunFollower& follower_;
    std::unique_ptr<RunProcess> process_;               // process of the run that is followed
    std::vector<std::unique_ptr<RunProcess>> leaving_;  // interrupted ones that nobody follows
};

}  // namespace kerf::view

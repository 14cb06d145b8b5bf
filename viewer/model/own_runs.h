// Runs that the viewer starts itself, as processes of their own: how they begin and how they are ended.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/model/repairs.h"
#include "viewer/model/run_follower.h"

namespace kerf::view {

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

    /// As those of Session.
    void start(RunOptions options, bool volume);
    void cancel();

    /// Interrupts our run, and follows it no more.
    void leave();
    /// Some that were left are still there.
    bool are_leaving() const { return !leaving_.empty(); }
    /// Whether our run has ended. Once a frame.
    bool poll();
    /// Interrupts all, and waits for two seconds at most; what has not ended then is killed by the destructor.
    void end();

 private:
    void launch(const RunOptions& options, const std::shared_ptr<ScratchFolder>& scratch);
    void launch_on_surface_of_trace(const RunOptions& options, const std::shared_ptr<ScratchFolder>& scratch);

    std::string kerf_;
    Background& background_;
    Document& document_;
    Store& store_;
    Repairs& repairs_;
    RunFollower& follower_;
    std::unique_ptr<RunProcess> process_;               // of the run that is followed
    std::vector<std::unique_ptr<RunProcess>> leaving_;  // interrupted ones that nobody follows
};

}  // namespace kerf::view

// The work of the second thread, in groups that are dropped as wholes, and the messages of works that failed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/core/error.h"
#include "viewer/model/inside/loader.h"

namespace kerf::view {

/// Queues works for the second thread. All calls come from the first thread, which owns all that is shown. Works get
/// copies and shared constants, and give back a completion, which the first thread runs in take_over().
class Background {
 public:
    /// Works that are dropped together, and the number of those that are queued or under way.
    struct Group {
        std::shared_ptr<Scope> scope = std::make_shared<Scope>();
        int jobs = 0;

        /// Drops the works that wait, and the results of all.
        void reset();
    };
    Group open;    ///< reads, checks and writes the open document
    Group data;    ///< fetches data that panels and scene ask for
    Group redo;    ///< makes cuts again
    Group repair;  ///< repairs a surface
    Group watch;   ///< looks at the followed run now and then; nobody waits for it

    using Failed = std::function<void(const Error&)>;
    /// Queues a work and counts it in its group. If it throws, `failed` runs instead of the completion; without
    /// `failed` the failure is noted.
    void post(Group& group, Loader::Work work, Failed failed = {});
    /// Queues a work that is done when nothing else is to be done. It is not counted, and its failure is passed over.
    void post_idle(const Group& group, Loader::Work work);

    /// Runs the completions that have come. Returns whether one of them has changed something.
    bool take_over();
    /// Called by a completion that has changed nothing.
    void note_in_vain() { ++in_vain_; }
    /// Blocks until there is something to take over, at most `seconds`.
    void wait(double seconds) { loader_->wait(seconds); }
    /// Drops all works, and waits for the one under way. Nothing may be posted afterwards.
    void end();

    /// The messages of the last hundred failures, newest last.
    const std::vector<std::string>& failures() const { return failures_; }
    /// The code of the first failure; ErrorCode::io for one that was noted by its message alone.
    ErrorCode failure_code() const { return failure_code_; }
    void note_failure(const Error& error) { note_failure(error.what(), error.code()); }
    /// Notes a failure by its message; an empty message is ignored.
    void note_failure(const std::string& message, ErrorCode code = ErrorCode::io);
    void forget_failures() { failures_.clear(); }

 private:
    std::vector<std::string> failures_;
    ErrorCode failure_code_ = ErrorCode::io;
    std::size_t in_vain_ = 0;
    std::optional<Loader> loader_{std::in_place};
};

}  // namespace kerf::view

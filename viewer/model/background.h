// The work of the second thread, in groups of one fate, and what has failed of it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "viewer/model/loader.h"

namespace kerf::view {

/// All calls come from the first thread, which owns all that is shown. Works get copies and shared constants, and give
/// back a completion, which the first thread runs in take_over().
class Background {
 public:
    /// Works with one fate, and how many of them are under way.
    struct Group {
        std::shared_ptr<Scope> scope = std::make_shared<Scope>();
        int jobs = 0;

        /// Those that wait and all results are dropped.
        void reset();
    };
    Group open;    ///< what is open is read, checked and written
    Group data;    ///< what is asked for is fetched
    Group redo;    ///< cuts are made again
    Group repair;  ///< a surface is repaired
    Group watch;   ///< the run that is followed is looked at now and then: nobody waits for it

    using Failed = std::function<void(const Error&)>;
    /// `failed` runs instead of the completion; a failure is noted if there is none.
    void post(Group& group, Loader::Work work, Failed failed = {});
    /// Done when nothing else is to be done, and not counted; failures are passed over.
    void post_idle(const Group& group, Loader::Work work);

    /// Runs the completions that have come; whether one has changed something.
    bool take_over();
    /// Said by a completion that has changed nothing.
    void note_in_vain() { ++in_vain_; }
    /// Blocks until there is something to take over, at most `seconds`.
    void wait(double seconds) { loader_->wait(seconds); }
    /// Drops all, and waits for the work under way. Nothing may be posted any more.
    void end();

    /// The last hundred, newest last.
    const std::vector<std::string>& failures() const { return failures_; }
    /// Of the first one; Error(io) where that was none that was thrown.
    ErrorCode failure_code() const { return failure_code_; }
    void note_failure(const Error& error) { note_failure(error.what(), error.code()); }
    /// An empty message is none.
    void note_failure(const std::string& message, ErrorCode code = ErrorCode::io);
    void forget_failures() { failures_.clear(); }

 private:
    std::vector<std::string> failures_;
    ErrorCode failure_code_ = ErrorCode::io;
    std::size_t in_vain_ = 0;
    std::optional<Loader> loader_{std::in_place};
};

}  // namespace kerf::view

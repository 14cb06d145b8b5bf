// The question that comes before work is lost that nobody has saved.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "viewer/app/view.h"

namespace kerf::view {

class Unsaved {
 public:
    explicit Unsaved(View& view) : view_(view) {}

    /// Asks, if work would be lost when all is closed, and returns whether it does: `then` is done when the answer
    /// allows it.
    bool asks_before(std::function<void()> then) { return asks_for(of_all(), std::move(then)); }
    /// Does the same for a change after which the shown run is the other one, whose place it takes.
    bool asks_before_change(std::function<void()> then) { return asks_for(of_change(), std::move(then)); }
    void answer(UnsavedFate answer);
    /// Goes on with what waits for work to be saved, once it is; it asks again if there is more.
    void follow();

 private:
    std::vector<UnsavedWork> of_all() const;
    std::vector<UnsavedWork> of_change() const;
    bool is_unsaved(UnsavedWork work) const;
    bool asks_for(std::vector<UnsavedWork> work, std::function<void()> then);

    View& view_;
    std::function<void()> then_;          // what waits for the answer; empty: nothing
    std::optional<UnsavedWork> awaited_;  // work that is being saved before that
    bool is_answered_ = false;            // all may go
    bool has_old_failures_ = false;       // failures that are told are from before the answer
};

}  // namespace kerf::view

// The question that comes before a mesh is lost that nobody has saved.
#pragma once

#include <functional>

#include "viewer/app/view.h"

namespace kerf::view {

class Unsaved {
 public:
    explicit Unsaved(View& view) : view_(view) {}

    /// Asks, if the open mesh would be lost, and returns whether it does: `then` is done when the answer allows it.
    bool asks_before(std::function<void()> then);
    void answer(UnsavedMesh answer);
    /// Goes on with what waits for a run to be saved, once it is.
    void follow();

 private:
    void go_on();

    View& view_;
    std::function<void()> then_;  // what waits for the answer; empty: nothing
    bool is_answered_ = false;    // the mesh may go
};

}  // namespace kerf::view

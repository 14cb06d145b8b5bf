// The other of two finished runs, drawn beside the shown one under the same camera.
#pragma once

#include <optional>
#include <string>

#include "viewer/app/view.h"

namespace kerf::view {

class Beside {
 public:
    explicit Beside(View& view) : view_(view) {}

    /// Opens the other run if it is to be seen, and takes what has arrived from its files. Call it once a frame.
    void follow();
    /// Gives the shown run its share of the scene's rectangle, View::area: all of it, or the right half, and the left
    /// one where it is the run before.
    void share(const Rectangle& scene);
    /// Builds the scene of the other run, for the state and with the range of colours of the shown one.
    void build();

    /// Returns whether the picture of the other run is not complete yet.
    bool is_pending() const;
    /// Waits until data arrive for it, at most `seconds`.
    void wait(double seconds);

 private:
    View& view_;
    std::optional<Session> session_;
    SceneBuilder builder_;
    ViewState built_for_;
    std::string place_;  // of the open run
    std::int64_t scenes_built_ = 0;
    bool has_new_data_ = false;
};

}  // namespace kerf::view

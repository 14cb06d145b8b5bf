// The picture of a frame: the whole scene, or its stand-in while the camera moves where the whole takes too long.
#pragma once

#include "viewer/app/view.h"

namespace kerf::view {

class Painting {
 public:
    explicit Painting(View& view) : view_(view) {}

    /// Notes whether somebody moves the camera. `by_hand`: the frame has taken input.
    void follow(bool by_hand);
    /// Paints the layout of the last frame.
    void paint();
    Image picture();  ///< paints the whole scene and returns the picture

    bool is_coarse() const { return is_coarse_; }  ///< the stand-in is painted, until the camera has come to rest

 private:
    void paint(const Scene& scene);

    View& view_;
    Camera camera_;
    double moved_at_ = -1, whole_seconds_ = 0;
    bool is_coarse_ = false;
    Scene stand_in_;
    std::int64_t stand_in_of_ = -1;  // View::scenes_built of its scene
};

}  // namespace kerf::view

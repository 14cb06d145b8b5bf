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
    /// Paints the scene, and the one beside it if there is one.
    void paint(const Scene& scene, const Scene* beside);

    View& view_;
    Camera camera_;
    double moved_at_ = -1, whole_seconds_ = 0;
    bool is_coarse_ = false;
    // The stand-in of a scene, with the number of scenes that were built before it was made.
    struct StandIn {
        Scene scene;
        std::int64_t of = -1;
    };
    static const Scene& stand_in(StandIn& stand_in, const BuiltScene& of, std::int64_t scenes_built);
    StandIn stand_in_, stand_in_beside_;
};

}  // namespace kerf::view

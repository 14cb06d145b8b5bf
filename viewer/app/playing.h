// Changes of the view with time (steps that play, a deformation that moves) and from step to step.
#pragma once

#include "viewer/app/view.h"

namespace kerf::view {

class Playing : public PlayActions {
 public:
    explicit Playing(View& view) : view_(view) {}

    void toggle_play() override;
    void toggle_motion() override;
    void move_step(int count) override;
    void move_node(int count) override;
    void go_on();  ///< goes on as far as time has gone

 private:
    void play();
    void move();

    View& view_;
    double motion_ = 0;        // phase of the motion, before it is rounded to that of a picture
    double played_until_ = 0;  // time of the next step, in ImGui's seconds
};

}  // namespace kerf::view

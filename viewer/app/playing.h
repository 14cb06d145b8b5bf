// What goes on with time, and from step to step.
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
    void go_on();  ///< as far as time has

 private:
    void play();
    void move();

    View& view_;
    double motion_ = 0;  // phase of the motion that plays, not yet that of a picture
    double played_until_ = 0;
};

}  // namespace kerf::view

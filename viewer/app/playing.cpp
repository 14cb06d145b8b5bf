// What goes on with time: from step to step, and the motion of a deformation.
#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "viewer/app/app.h"
#include "viewer/model/timeline.h"

namespace kerf::view {

namespace {

constexpr double seconds_per_step = 0.8;
constexpr double pictures_per_period = 32;  // of a motion: each is made once

}  // namespace

void App::toggle_play() {
    facts_.playing = !facts_.playing;
    played_until_ = ImGui::GetTime() + seconds_per_step;
}

void App::toggle_motion() {
    facts_.moving = !facts_.moving;
    if (state_.motion == Motion::still) state_.motion = Motion::swing;
    motion_ = state_.phase;
}

void App::move_step(int direction) {
    const auto here = static_cast<int>(nearest_step(steps_, state_.step));
    state_.step =
        steps_[static_cast<std::size_t>(std::clamp(here + direction, 0, static_cast<int>(steps_.size()) - 1))];
}

void App::move_node(int direction) {
    state_.node = next_node(session_.document().tree, state_.node, direction);
    steps_ = steps_of(session_.document(), state_.node);
    state_.step.refused_try = -1;
}

// Where the deformation is now.
void App::move() {
    facts_.moving &= state_.motion != Motion::still && state_.deform != 0;
    if (!facts_.moving) return;
    motion_ += state_.speed * static_cast<double>(ImGui::GetIO().DeltaTime);
    motion_ -= std::floor(motion_);
    state_.phase = std::floor(motion_ * pictures_per_period) / pictures_per_period;
}

// Through the steps of the node, then on to the next node.
void App::play() {
    if (!facts_.playing || ImGui::GetTime() < played_until_) return;
    played_until_ = ImGui::GetTime() + seconds_per_step;
    if (nearest_step(steps_, state_.step) + 1 < steps_.size()) {
        move_step(1);
        return;
    }
    const NodeId before = state_.node;
    move_node(1);
    facts_.playing = state_.node != before;
    if (facts_.playing) state_.step = {};
}

}  // namespace kerf::view

#include "viewer/app/playing.h"

#include <algorithm>
#include <cmath>

#include <imgui.h>

#include "viewer/model/timeline.h"

namespace kerf::view {

namespace {

constexpr double seconds_per_step = 0.8;
constexpr double pictures_per_period = 32;  // phases of a motion; the picture of each is made once

}  // namespace

void Playing::toggle_play() {
    view_.facts.playing = !view_.facts.playing;
    // From the cells of all parts, at which runs open, everything is played.
    const bool is_last = nearest_step(view_.steps, view_.state.step) + 1 == view_.steps.size();
    if (view_.facts.playing && view_.state.node == root_node && is_last) view_.state.step = {};
    played_until_ = ImGui::GetTime() + seconds_per_step;
}

void Playing::toggle_motion() {
    view_.facts.moving = !view_.facts.moving;
    Deformation& deformation = view_.state.deformation;
    if (deformation.motion == Motion::still) deformation.motion = Motion::swing;
    motion_ = deformation.phase;
}

void Playing::move_step(int direction) {
    const std::int64_t here = nearest_step(view_.steps, view_.state.step);
    view_.state.step = view_.steps[std::clamp<std::int64_t>(here + direction, 0, std::ssize(view_.steps) - 1)];
}

void Playing::move_node(int direction) {
    view_.state.node = next_node(view_.session.document().tree, view_.state.node, direction);
    view_.steps = steps_of(view_.session.document(), view_.state.node);
    view_.state.step.refused_try = -1;
}

// Moves the deformation to its present phase.
void Playing::move() {
    Deformation& deformation = view_.state.deformation;
    view_.facts.moving &= deformation.motion != Motion::still && deformation.factor != 0;
    if (!view_.facts.moving) return;
    motion_ += deformation.speed * ImGui::GetIO().DeltaTime;
    motion_ -= std::floor(motion_);
    deformation.phase = std::floor(motion_ * pictures_per_period) / pictures_per_period;
}

// Goes through the steps of the node, then on to the next node.
void Playing::play() {
    if (!view_.facts.playing || ImGui::GetTime() < played_until_) return;
    played_until_ = ImGui::GetTime() + seconds_per_step;
    if (nearest_step(view_.steps, view_.state.step) + 1 < view_.steps.size()) {
        move_step(1);
        return;
    }
    const NodeId before = view_.state.node;
    move_node(1);
    view_.facts.playing = view_.state.node != before;
    if (view_.facts.playing) view_.state.step = {};
}

void Playing::go_on() {
    play();
    move();
}

}  // namespace kerf::view

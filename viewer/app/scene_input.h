// Keys and mouse of the scene. Panels take theirs first.
#pragma once

#include <vector>

#include "viewer/app/navigation.h"
#include "viewer/render/key_event.h"

namespace kerf::view {

class SceneInput {
 public:
    SceneInput(View& view, Ui& ui, Navigation& navigation) : view_(view), ui_(ui), navigation_(navigation) {}

    void press(const KeyEvent& event) { key_events_.push_back(event); }
    void take(UiContext& context);  ///< acts on keys and mouse as they are in this frame
    void resolve_click();           ///< makes the click a selection once its cells have arrived
    bool is_dragging() const { return dragging_; }
    bool is_pressed() const { return pressed_in_scene_; }

 private:
    void take_mouse(UiContext& context);
    void take_drag();
    void take_click(bool centers);
    void take_right_click();
    void take_other_run(UiContext& context);

    View& view_;
    Ui& ui_;
    Navigation& navigation_;
    std::vector<KeyEvent> key_events_;  // events that no frame has taken yet
    bool dragging_ = false, pressed_in_scene_ = false;
};

}  // namespace kerf::view

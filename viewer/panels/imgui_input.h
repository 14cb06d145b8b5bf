// Mouse and keys as Dear ImGui wants them. Up to 1.86 one writes its state, from 1.89 on one hands it events: only this
// file knows. Numbers of keys are ours (app/keys.h), as GLFW has them.
#pragma once

#include <imgui.h>

namespace kerf::view {

#if IMGUI_VERSION_NUM < 18700
inline constexpr auto imgui_keypad_enter = ImGuiKey_KeyPadEnter;
#else
inline constexpr auto imgui_keypad_enter = ImGuiKey_KeypadEnter;
#endif

/// Our number of a key that ImGui knows by name.
void number_imgui_key(ImGuiKey key, int number);
bool is_imgui_key_pressed(ImGuiKey key);
/// From units of the window, in which its backend has put the mouse, to pixels. Before every frame.
void scale_mouse(float x, float y);

// What the backend of a window does, for who has none.
void put_mouse(float x, float y);
void put_mouse_button(int button, bool is_down);
void put_mouse_wheel(float notches);
void put_key(int number, bool is_down, bool control, bool shift);

}  // namespace kerf::view

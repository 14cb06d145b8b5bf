// Mouse and keys in the form that Dear ImGui takes. Up to 1.86 a program writes ImGui's state, from 1.89 on it hands
// ImGui events; only this file knows the difference. Keys have Kerf's numbers (app/keys.h), which are those of GLFW.
#pragma once

#include <imgui.h>

namespace kerf::view {

#if IMGUI_VERSION_NUM < 18700
inline constexpr auto imgui_keypad_enter = ImGuiKey_KeyPadEnter;
#else
inline constexpr auto imgui_keypad_enter = ImGuiKey_KeypadEnter;
#endif

/// Sets Kerf's number of a key that ImGui knows by name.
void number_imgui_key(ImGuiKey key, int number);
bool is_imgui_key_pressed(ImGuiKey key);
/// Scales the place of the mouse from units of the window, in which its backend has put it, to pixels. Call it before
/// every frame.
void scale_mouse(float x, float y);

// Input that the backend of a window would put, for a program without a window.
void put_mouse(float x, float y);
void put_mouse_button(int button, bool is_down);
void put_mouse_wheel(float notches);
void put_key(int number, bool is_down, bool control, bool shift);

}  // namespace kerf::view

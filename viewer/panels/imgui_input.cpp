#include "viewer/panels/imgui_input.h"

#if IMGUI_VERSION_NUM >= 18700
#include <imgui_internal.h>  // for events that ImGui has not taken yet

#include <map>
#endif

namespace kerf::view {

#if IMGUI_VERSION_NUM < 18700

void number_imgui_key(ImGuiKey key, int number) { ImGui::GetIO().KeyMap[key] = number; }

bool is_imgui_key_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); }

void scale_mouse(float x, float y) {
    ImVec2& mouse = ImGui::GetIO().MousePos;
    if (ImGui::IsMousePosValid(&mouse)) mouse = {mouse.x * x, mouse.y * y};
}

void put_mouse(float x, float y) { ImGui::GetIO().MousePos = {x, y}; }
void put_mouse_button(int button, bool is_down) { ImGui::GetIO().MouseDown[button] = is_down; }
void put_mouse_wheel(float notches) { ImGui::GetIO().MouseWheel = notches; }

void put_key(int number, bool is_down, bool control, bool shift) {
    ImGuiIO& io = ImGui::GetIO();
    io.KeyCtrl = control;
    io.KeyShift = shift;
    io.KeysDown[number] = is_down;
}

#else

namespace {

std::map<int, ImGuiKey> imgui_keys;

}  // namespace

void number_imgui_key(ImGuiKey key, int number) { imgui_keys[number] = key; }

bool is_imgui_key_pressed(ImGuiKey key) { return ImGui::IsKeyPressed(key); }

// Each event is scaled once: events that do not fit into a frame stay in the queue for the next one.
void scale_mouse(float x, float y) {
    static ImU32 last = 0;
    for (ImGuiInputEvent& event : ImGui::GetCurrentContext()->InputEventsQueue) {
        if (event.EventId <= last) continue;
        last = event.EventId;
        if (event.Type != ImGuiInputEventType_MousePos || event.MousePos.PosX == -FLT_MAX) continue;
        event.MousePos.PosX *= x;
        event.MousePos.PosY *= y;
    }
}

void put_mouse(float x, float y) { ImGui::GetIO().AddMousePosEvent(x, y); }
void put_mouse_button(int button, bool is_down) { ImGui::GetIO().AddMouseButtonEvent(button, is_down); }
void put_mouse_wheel(float notches) { ImGui::GetIO().AddMouseWheelEvent(0, notches); }

void put_key(int number, bool is_down, bool control, bool shift) {
    ImGuiIO& io = ImGui::GetIO();
    io.AddKeyEvent(ImGuiMod_Ctrl, control);
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    if (const auto key = imgui_keys.find(number); key != imgui_keys.end()) io.AddKeyEvent(key->second, is_down);
}

#endif

}  // namespace kerf::view

#include "viewer/app/imgui_owner.h"

#include <utility>

#include <imgui.h>

#include "viewer/app/keys.h"

namespace kerf::view {

ImGuiOwner::ImGuiOwner() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.KeyMap[ImGuiKey_Tab] = key_tab;
    io.KeyMap[ImGuiKey_LeftArrow] = key_left;
    io.KeyMap[ImGuiKey_RightArrow] = key_right;
    io.KeyMap[ImGuiKey_UpArrow] = key_up;
    io.KeyMap[ImGuiKey_DownArrow] = key_down;
    io.KeyMap[ImGuiKey_PageUp] = key_page_up;
    io.KeyMap[ImGuiKey_PageDown] = key_page_down;
    io.KeyMap[ImGuiKey_Home] = key_home;
    io.KeyMap[ImGuiKey_End] = key_end;
    io.KeyMap[ImGuiKey_Delete] = key_delete;
    io.KeyMap[ImGuiKey_Backspace] = key_backspace;
    io.KeyMap[ImGuiKey_Space] = key_space;
    io.KeyMap[ImGuiKey_Enter] = key_enter;
    io.KeyMap[ImGuiKey_Escape] = key_escape;
    io.KeyMap[ImGuiKey_KeyPadEnter] = key_keypad_enter;
    for (const auto& [name, letter] :
         {std::pair(ImGuiKey_A, 'A'), std::pair(ImGuiKey_C, 'C'), std::pair(ImGuiKey_V, 'V'),
          std::pair(ImGuiKey_X, 'X'), std::pair(ImGuiKey_Y, 'Y'), std::pair(ImGuiKey_Z, 'Z')})
        io.KeyMap[name] = key_of(letter);
}

ImGuiOwner::~ImGuiOwner() { ImGui::DestroyContext(); }

}  // namespace kerf::view

#include "viewer/app/imgui_owner.h"

#include <utility>

#include <imgui.h>

#include "viewer/app/keys.h"
#include "viewer/panels/imgui_input.h"

namespace kerf::view {

ImGuiOwner::ImGuiOwner() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, key_tab},
                                             {ImGuiKey_LeftArrow, key_left},
                                             {ImGuiKey_RightArrow, key_right},
                                             {ImGuiKey_UpArrow, key_up},
                                             {ImGuiKey_DownArrow, key_down},
                                             {ImGuiKey_PageUp, key_page_up},
                                             {ImGuiKey_PageDown, key_page_down},
                                             {ImGuiKey_Home, key_home},
                                             {ImGuiKey_End, key_end},
                                             {ImGuiKey_Delete, key_delete},
                                             {ImGuiKey_Backspace, key_backspace},
                                             {ImGuiKey_Space, key_space},
                                             {ImGuiKey_Enter, key_enter},
                                             {ImGuiKey_Escape, key_escape},
                                             {imgui_keypad_enter, key_keypad_enter},
                                             {ImGuiKey_A, key_of('A')},
                                             {ImGuiKey_C, key_of('C')},
                                             {ImGuiKey_V, key_of('V')},
                                             {ImGuiKey_X, key_of('X')},
                                             {ImGuiKey_Y, key_of('Y')},
                                             {ImGuiKey_Z, key_of('Z')}};
    for (const auto& [key, number] : keys) number_imgui_key(key, number);
}

ImGuiOwner::~ImGuiOwner() { ImGui::DestroyContext(); }

}  // namespace kerf::view

// The lifetime of Dear ImGui.
#pragma once

namespace kerf::view {

/// Owns Dear ImGui's global context. Keys are numbered as in app/keys.h; ImGui saves no file.
class ImGuiOwner {
 public:
    ImGuiOwner();
    ~ImGuiOwner();
    ImGuiOwner(const ImGuiOwner&) = delete;
    ImGuiOwner& operator=(const ImGuiOwner&) = delete;
};

}  // namespace kerf::view

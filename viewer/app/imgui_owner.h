// Dear ImGui, for as long as a viewer lives.
#pragma once

namespace kerf::view {

/// Dear ImGui's global context, for as long as it lives. Keys are numbered as in app/keys.h; nothing is saved.
class ImGuiOwner {
 public:
    ImGuiOwner();
    ~ImGuiOwner();
    ImGuiOwner(const ImGuiOwner&) = delete;
    ImGuiOwner& operator=(const ImGuiOwner&) = delete;
};

}  // namespace kerf::view

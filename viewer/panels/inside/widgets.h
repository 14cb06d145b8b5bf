// Dear ImGui's items with a memory of their places, so that a test, or a script, can click them by name.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

namespace kerf::view {

/// The rectangle in which an item was drawn, in pixels of the window.
struct ItemRect {
    float left = 0, top = 0, right = 0, bottom = 0;
    bool enabled = true;
    bool visible = true;  ///< its middle is not scrolled away, nor its window covered by a dialog
};

/// Thin wrappers of ImGui's items. Each draws the item and records its rectangle under its label, the part of it before
/// any "##" or, if that is empty, all of it. Labels are unique among the items drawn at one time.
class Widgets {
 public:
    void begin_frame() { items_.clear(); }
    /// Returns the items drawn since begin_frame().
    const std::map<std::string, ItemRect>& items() const { return items_; }
    std::optional<ItemRect> find(const std::string& label) const;

    bool button(const char* label, const char* tip = nullptr);
    bool small_button(const char* label, const char* tip = nullptr);
    bool checkbox(const char* label, bool* value, const char* tip = nullptr);
    bool radio(const char* label, bool active);
    bool slider(const char* label, double* value, double low, double high, const char* format = "%.2f");
    /// `why_not`: for each entry the reason why it cannot be chosen, null if it can; or nothing.
    bool combo(const char* label, int* index, const std::vector<std::string>& names,
               const std::vector<const char*>& why_not = {});
    bool menu_item(const char* label, const char* shortcut = nullptr, bool* value = nullptr);
    bool header(const char* label, bool open_at_first);  ///< draws the head of a collapsing section
    bool input_text(const char* label, std::string* text);
    bool input_number(const char* label, double* value);
    /// Records the last item, which was drawn by ImGui directly, or a rectangle.
    void record(const std::string& label);
    void record(const std::string& label, const ImVec2& from, const ImVec2& to);

 private:
    std::map<std::string, ItemRect> items_;
};

}  // namespace kerf::view

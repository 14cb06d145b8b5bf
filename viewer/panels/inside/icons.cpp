// Icons as lines, discs and boxes of an ImDrawList, so that they do not depend on the glyphs of a font. A Pen draws in
// units of half of the icon's side about its centre, so that an icon fills -1 to 1 in both directions, y down. Lines
// grow with the icon and are at least a pixel wide. A new icon is a member of Icon and a case of draw_icon().
#include "viewer/panels/inside/icons.h"

#include <cmath>

#include "viewer/panels/inside/widgets.h"

namespace kerf::view {

namespace {

// A pen in units of half of the side, with the origin at the centre and y down.
class Pen {
 public:
    Pen(ImDrawList& list, const ImVec2& center, float size, ImU32 color)
        : list_(list), center_(center), half_(size / 2), color_(color), width_(std::max(1.f, size / 11)) {}

    ImVec2 at(float x, float y) const { return {center_.x + x * half_, center_.y + y * half_}; }
    void line(float x0, float y0, float x1, float y1) { list_.AddLine(at(x0, y0), at(x1, y1), color_, width_); }
    void disc(float r) { list_.AddCircleFilled(center_, r * half_, color_); }
    void circle(float r) { list_.AddCircle(center_, r * half_, color_, 0, width_); }
    void box(float x0, float y0, float x1, float y1) { list_.AddRectFilled(at(x0, y0), at(x1, y1), color_, 1); }
    void frame(float x0, float y0, float x1, float y1) { list_.AddRect(at(x0, y0), at(x1, y1), color_, 1, 0, width_); }
    void triangle(const ImVec2& a, const ImVec2& b, const ImVec2& c) {
        list_.AddTriangleFilled(at(a.x, a.y), at(b.x, b.y), at(c.x, c.y), color_);
    }
    // The lids of an eye: two arcs from corner to corner.
    void lids(bool upper) {
        list_.PathLineTo(at(-0.9f, 0));
        list_.PathBezierCubicCurveTo(at(-0.4f, 0.7f), at(0.4f, 0.7f), at(0.9f, 0));
        if (upper) list_.PathBezierCubicCurveTo(at(0.4f, -0.7f), at(-0.4f, -0.7f), at(-0.9f, 0));
        list_.PathStroke(color_, 0, width_);
    }

 private:
    ImDrawList& list_;
    ImVec2 center_;
    float half_;
    ImU32 color_;
    float width_;
};

void draw_eye(Pen& pen, bool open) {
    pen.lids(open);
    if (open) return pen.disc(0.28f);
    for (const float x : {-0.45f, 0.f, 0.45f}) pen.line(x, 0.5f, 1.3f * x, 0.8f);
}

void draw_arrow(Pen& pen, Icon icon) {
    const float s = icon == Icon::left || icon == Icon::up ? -1.f : 1.f;
    if (icon == Icon::left || icon == Icon::right)
        pen.triangle({0.6f * s, 0}, {-0.4f * s, -0.7f}, {-0.4f * s, 0.7f});
    else
        pen.triangle({0, 0.6f * s}, {-0.7f, -0.4f * s}, {0.7f, -0.4f * s});
}

void draw_surface(Pen& pen) {
    pen.line(-0.8f, 0.6f, 0.8f, 0.6f);
    pen.line(-0.8f, 0.6f, 0, -0.75f);
    pen.line(0.8f, 0.6f, 0, -0.75f);
    pen.line(0, -0.75f, 0, 0.6f);
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, const ImVec2& center, float size, ImU32 color) {
    Pen pen(list, center, size, color);
    switch (icon) {
        case Icon::eye:
        case Icon::eye_closed:
            return draw_eye(pen, icon == Icon::eye);
        case Icon::isolate:
            pen.circle(0.72f);
            return pen.disc(0.32f);
        case Icon::glass:  // one thing seen through another
            pen.frame(-0.8f, -0.8f, 0.35f, 0.35f);
            return pen.frame(-0.35f, -0.35f, 0.8f, 0.8f);
        case Icon::play:
            return pen.triangle({0.8f, 0}, {-0.55f, -0.8f}, {-0.55f, 0.8f});
        case Icon::pause:
            pen.box(-0.6f, -0.7f, -0.15f, 0.7f);
            return pen.box(0.15f, -0.7f, 0.6f, 0.7f);
        case Icon::left:
        case Icon::right:
        case Icon::up:
        case Icon::down:
            return draw_arrow(pen, icon);
        case Icon::folder:
            pen.box(-0.85f, -0.6f, -0.1f, 0);
            return pen.box(-0.85f, -0.35f, 0.85f, 0.65f);
        case Icon::run:
            for (const float x : {-0.75f, 0.1f})
                for (const float y : {-0.75f, 0.1f}) pen.box(x, y, x + 0.65f, y + 0.65f);
            return;
        case Icon::surface:
            return draw_surface(pen);
        case Icon::trace:
            pen.frame(-0.75f, -0.75f, 0.75f, 0.75f);
            return pen.line(-0.2f, -0.95f, 0.2f, 0.95f);
        case Icon::file:
            return pen.frame(-0.55f, -0.8f, 0.55f, 0.8f);
    }
}

bool icon_button(Widgets& widgets, const std::string& label, Icon icon, float size, ImU32 color, const char* tip) {
    const bool pressed = ImGui::InvisibleButton(("##" + label).c_str(), {size, size});
    widgets.record(label);
    const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) list.AddRectFilled(from, to, ImGui::GetColorU32(ImGuiCol_ButtonHovered), size / 5);
    const ImVec4 tint = ImGui::ColorConvertU32ToFloat4(color);
    draw_icon(list, icon, {(from.x + to.x) / 2, (from.y + to.y) / 2}, 0.72f * size, ImGui::GetColorU32(tint));
    if (tip && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
    return pressed;
}

}  // namespace kerf::view

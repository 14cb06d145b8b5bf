// The axes of the file as the camera has turned them; a click on an end looks from there. Ends are axes of the file,
// sides (Direction) depend on what is up: the side of an end is the one whose camera looks along it. Ends are drawn
// from back to front, and clicked from front to back.
#include <algorithm>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

struct AxisEnd {
    const char* label;
    const char* letter;
    int axis;
    double sign;
};

constexpr std::array<AxisEnd, 6> ends = {{{"view x", "x", 0, 1},
                                          {"view -x", "", 0, -1},
                                          {"view y", "y", 1, 1},
                                          {"view -y", "", 1, -1},
                                          {"view z", "z", 2, 1},
                                          {"view -z", "", 2, -1}}};

// In the order of Direction.
constexpr std::array<const char*, 6> tips = {"From the front (1)", "From the back",    "From the right (3)",
                                             "From the left",      "From the top (7)", "From the bottom"};

// The side from which one looks along an axis.
Direction side_of(const AxisEnd& end, int up) {
    Camera camera;
    int side = 0;
    for (look_from(camera, Direction::front, up); camera.back()[end.axis] * end.sign < 0.9 && side < 5;)
        look_from(camera, static_cast<Direction>(++side), up);
    return static_cast<Direction>(side);
}

constexpr std::array<Color, 3> axis_colors = {{{0.80f, 0.22f, 0.22f}, {0.24f, 0.60f, 0.25f}, {0.20f, 0.42f, 0.85f}}};

struct PlacedEnd {
    const AxisEnd* end = nullptr;
    ImVec2 at;
    double depth = 0;  // larger: nearer
};

// The ends of the axes in the window, the nearest first.
std::array<PlacedEnd, 6> place_ends(const Camera& camera, const ImVec2& center, float reach) {
    std::array<PlacedEnd, 6> placed;
    const Eigen::Quaterniond to_eye = camera.turn.conjugate();
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const Vec3 d = to_eye * (ends[i].sign * Vec3::Unit(ends[i].axis));
        const Eigen::Vector2f seen = d.head<2>().cast<float>();
        placed[i] = {&ends[i], {center.x + reach * seen.x(), center.y - reach * seen.y()}, d.z()};
    }
    std::stable_sort(placed.begin(), placed.end(), [](const auto& a, const auto& b) { return a.depth > b.depth; });
    return placed;
}

void draw_end(ImDrawList& list, const PlacedEnd& placed, const ImVec2& center, float radius, bool hovered) {
    Color color = axis_colors[placed.end->axis];
    const auto front = static_cast<float>(0.5 + 0.5 * placed.depth);
    color.a = 0.55f + 0.45f * front;
    const bool positive = placed.end->sign > 0;
    if (positive) list.AddLine(center, placed.at, packed(color), 0.28f * radius);
    const float r = (positive ? 1.f : 0.75f) * (hovered ? 1.15f : 1.f) * radius;
    if (positive || hovered) {
        list.AddCircleFilled(placed.at, r, packed(color));
    } else {
        list.AddCircleFilled(placed.at, r, packed(Color{color.r, color.g, color.b, 0.3f * color.a}));
        list.AddCircle(placed.at, r, packed(color), 0, 0.15f * radius);
    }
    const ImVec2 size = ImGui::CalcTextSize(placed.end->letter);
    list.AddText({placed.at.x - size.x / 2, placed.at.y - 0.53f * size.y}, IM_COL32_WHITE, placed.end->letter);
}

}  // namespace

void draw_gizmo(UiContext& context, const Rectangle& scene) {
    const float e = em(), radius = 0.62f * e, reach = 2.2f * e, half = reach + 1.2f * radius;
    const Rectangle place = {scene.x + scene.width - 2 * half - 0.6f * e, scene.y + 0.6f * e, 2 * half, 2 * half};
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin_place("##gizmo", place, ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    const ImVec2 center = {place.x + half, place.y + half};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled(center, half, packed(faded(palette(context.state.theme).backdrop, 0.6f)), 48);
    const std::array<PlacedEnd, 6> placed = place_ends(context.camera, center, reach);
    std::array<bool, 6> hovered = {};
    for (std::size_t i = 0; i < placed.size(); ++i) {  // of two ends at one place the nearer one is clicked
        ImGui::SetCursorScreenPos({placed[i].at.x - radius, placed[i].at.y - radius});
        if (ImGui::InvisibleButton(placed[i].end->label, {2 * radius, 2 * radius})) {
            Camera camera = context.camera;
            look_from(camera, side_of(*placed[i].end, context.facts.up), context.facts.up);
            context.actions.camera.take_camera(camera);
        }
        hovered[i] = ImGui::IsItemHovered();
        context.widgets.record(placed[i].end->label);
        explain(tips[static_cast<std::size_t>(side_of(*placed[i].end, context.facts.up))]);
    }
    for (std::size_t i = placed.size(); i-- > 0;) draw_end(list, placed[i], center, radius, hovered[i]);
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace kerf::view

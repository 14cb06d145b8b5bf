// The clip plane is moved and turned where it is seen.
#include <cmath>
#include <optional>

#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

// From the file to the screen and back, near one point.
class ScreenPlace {
 public:
    ScreenPlace(const Camera& camera, const Rectangle& scene, const Rectangle& body)
        : camera_(camera), middle_{body.x + body.width / 2, body.y + body.height / 2}, pixels_(scene.height) {}

    std::optional<ImVec2> of(const Vec3& point) const {
        const auto seen = seen_from_target(camera_, point);
        if (!seen) return std::nullopt;
        return ImVec2{middle_.x + pixels_ * static_cast<float>(seen->x()),
                      middle_.y - pixels_ * static_cast<float>(seen->y())};
    }
    /// Units of the file that a pixel is at the target's depth.
    double unit() const { return camera_.height / pixels_; }
    Vec3 moved(const Vec3& point, const ImVec2& delta) const {
        return point + unit() * (delta.x * camera_.right() - delta.y * camera_.up());
    }

 private:
    const Camera& camera_;
    ImVec2 middle_;  // where the target is
    float pixels_;   // of the camera's height
};

// Around the middle of the plane, as wide as the box asks for.
std::array<Vec3, 4> corners_of(const Vec3& middle, const Vec3& normal, const Eigen::AlignedBox3d& box) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto reach = [&](const Vec3& axis) { return 0.55 * box.sizes().dot(axis.cwiseAbs()); };
    const Vec3 a = reach(u) * u, b = reach(v) * v;
    return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
}

// A button that is dragged; returns whether the mouse has moved it.
bool drag(UiContext& context, const char* label, const ImVec2& at, const char* tip) {
    const float radius = 0.7f * em();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin_place((std::string("##") + label).c_str(), {at.x - radius, at.y - radius, 2 * radius, 2 * radius},
                ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton(label, {2 * radius, 2 * radius});
    context.widgets.record(label);
    const bool held = ImGui::IsItemActive(), lit = held || ImGui::IsItemHovered();
    if (!held) explain(tip);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Palette& colors = palette(context.state.theme);
    list.AddCircleFilled(at, (lit ? 0.5f : 0.4f) * em(), packed(colors.accent));
    list.AddCircle(at, (lit ? 0.5f : 0.4f) * em(), packed(colors.on_accent), 0, 0.1f * em());
    ImGui::End();
    ImGui::PopStyleVar();
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    return held && (delta.x != 0 || delta.y != 0);
}

}  // namespace

void draw_clip_handles(UiContext& context, const Rectangle& scene) {
    Clip& clip = context.state.clip;
    const Eigen::AlignedBox3d& box = context.session.document().box;
    if (!clip.on || box.isEmpty()) return;
    const ScreenPlace screen(context.camera, scene, body_area(context.state, scene));
    const ValueRange range = extent_along(box, clip.normal);
    const double height = range.low + clip.position * (range.high - range.low);
    const Vec3 middle = box.center() + (height - clip.normal.dot(box.center())) * clip.normal;
    const Vec3 shown_side = clip.flipped ? clip.normal : Vec3(-clip.normal);
    // Long enough to be taken hold of, whatever is seen of the body.
    const double length = 5 * em() * screen.unit();
    const Vec3 tip = middle - length * shown_side;

    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImU32 color = packed(palette(context.state.theme).accent);
    std::array<std::optional<ImVec2>, 4> corners;
    const std::array<Vec3, 4> places = corners_of(middle, clip.normal, box);
    for (std::size_t i = 0; i < places.size(); ++i) corners[i] = screen.of(places[i]);
    const auto from = screen.of(middle), to = screen.of(tip);
    list.PushClipRect({scene.x, scene.y}, {scene.x + scene.width, scene.y + scene.height});
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] && corners[(i + 1) % 4]) list.AddLine(*corners[i], *corners[(i + 1) % 4], color, 0.08f * em());
    if (from && to) list.AddLine(*from, *to, color, 0.14f * em());
    list.PopClipRect();
    if (!from || !to) return;

    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    if (drag(context, "move clip plane", *from, "Drag to move the clip plane")) {
        // Along the arrow as it is seen; where it points to the eye, up is forward.
        Eigen::Vector2d arrow(to->x - from->x, to->y - from->y);
        if (arrow.norm() < em()) arrow = Eigen::Vector2d(0, -5 * em());
        const double share = (delta.x * arrow.x() + delta.y * arrow.y()) / arrow.squaredNorm();
        snap_to(clip, {middle - share * length * shown_side, clip.normal}, box);
    }
    if (drag(context, "turn clip plane", *to, "Drag to turn the clip plane")) {
        const Vec3 turned = (screen.moved(tip, delta) - middle).normalized();
        snap_to(clip, {middle, clip.flipped ? Vec3(-turned) : turned}, box);
    }
}

}  // namespace kerf::view

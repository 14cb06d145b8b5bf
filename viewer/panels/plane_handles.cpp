// Handles in the scene that move and turn the clip plane, and move the plane of a cut. A handle is an ImGui window of
// its own around a point of the file as the camera shows it, so that ImGui takes the mouse and a drag of a handle is
// not a drag of the scene. A drag along an arrow counts as the share of the arrow's length on the screen by which the
// mouse has moved along it; where the arrow points to the eye, up is forward. Arrows are 5 ems long whatever is seen of
// the body. The clip plane follows the drag at once; a cut is made again when its handle is let go, as that takes time.
#include <cmath>
#include <optional>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// The way from the file to the screen and back, near one point.
class ScreenPlace {
 public:
    ScreenPlace(const Camera& camera, const Rectangle& scene, const Rectangle& body)
        : camera_(camera), middle_{body.x + body.width / 2, body.y + body.height / 2}, pixels_(scene.height) {}

    std::optional<ImVec2> of(const Vec3& point) const {
        const auto seen = seen_from_target(camera_, point);
        if (!seen) return std::nullopt;
        const Eigen::Vector2f offset = seen->cast<float>();
        return ImVec2{middle_.x + pixels_ * offset.x(), middle_.y - pixels_ * offset.y()};
    }
    /// Units of the file that a pixel is at the target's depth.
    double unit() const { return camera_.height / pixels_; }
    Vec3 moved(const Vec3& point, const ImVec2& delta) const {
        return point + unit() * (delta.x * camera_.right() - delta.y * camera_.up());
    }

 private:
    const Camera& camera_;
    ImVec2 middle_;  // place of the camera's target in the window
    float pixels_;   // pixels of Camera::height
};

// The corners of a rectangle around the middle of the plane, as wide as the box asks for.
std::array<Vec3, 4> corners_of(const Vec3& middle, const Vec3& normal, const Eigen::AlignedBox3d& box) {
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const auto reach = [&](const Vec3& axis) { return 0.55 * box.sizes().dot(axis.cwiseAbs()); };
    const Vec3 a = reach(u) * u, b = reach(v) * v;
    return {middle - a - b, middle + a - b, middle + a + b, middle - a + b};
}

struct Dragged {
    bool moved = false;     ///< the mouse has moved since the last frame while it held the handle
    bool released = false;  ///< the handle was let go in this frame
};

// Draws a button that can be dragged.
Dragged drag(UiContext& context, const char* label, const ImVec2& at, const char* tip) {
    const float radius = 0.7f * em();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    begin_place((std::string("##") + label).c_str(), {at.x - radius, at.y - radius, 2 * radius, 2 * radius},
                ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::InvisibleButton(label, {2 * radius, 2 * radius});
    context.widgets.record(label);
    const bool held = ImGui::IsItemActive(), lit = held || ImGui::IsItemHovered();
    const bool released = ImGui::IsItemDeactivated();
    if (!held) explain(tip);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Palette& colors = palette(context.state.theme);
    list.AddCircleFilled(at, (lit ? 0.5f : 0.4f) * em(), packed(colors.accent));
    list.AddCircle(at, (lit ? 0.5f : 0.4f) * em(), packed(colors.on_accent), 0, 0.1f * em());
    ImGui::End();
    ImGui::PopStyleVar();
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    return {held && (delta.x != 0 || delta.y != 0), released};
}

// The component of the mouse's move since the last frame along an arrow, as a share of the arrow's length. Where the
// arrow points to the eye, up is forward.
double share_along(const ImVec2& from, const ImVec2& to) {
    Eigen::Vector2d arrow(to.x - from.x, to.y - from.y);
    if (arrow.norm() < em()) arrow = Eigen::Vector2d(0, -5 * em());
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    return (delta.x * arrow.x() + delta.y * arrow.y()) / arrow.squaredNorm();
}

void draw_outline(const ScreenPlace& screen, const Rectangle& scene, const std::array<Vec3, 4>& places, ImU32 color) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    std::array<std::optional<ImVec2>, 4> corners;
    for (std::size_t i = 0; i < places.size(); ++i) corners[i] = screen.of(places[i]);
    list.PushClipRect({scene.x, scene.y}, {scene.x + scene.width, scene.y + scene.height});
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] && corners[(i + 1) % 4]) list.AddLine(*corners[i], *corners[(i + 1) % 4], color, 0.08f * em());
    list.PopClipRect();
}

void draw_clip_handles(UiContext& context, const Rectangle& scene, const ScreenPlace& screen) {
    Clip& clip = context.state.clip;
    const Eigen::AlignedBox3d& box = context.session.document().box;
    if (!clip.on || box.isEmpty()) return;
    const ValueRange range = extent_along(box, clip.normal);
    const double height = range.low + clip.position * (range.high - range.low);
    const Vec3 middle = box.center() + (height - clip.normal.dot(box.center())) * clip.normal;
    const Vec3 shown_side = clip.flipped ? clip.normal : Vec3(-clip.normal);
    // The arrow is long enough to be taken hold of, whatever is seen of the body.
    const double length = 5 * em() * screen.unit();
    const Vec3 tip = middle - length * shown_side;
    const ImU32 color = packed(palette(context.state.theme).accent);
    draw_outline(screen, scene, corners_of(middle, clip.normal, box), color);
    const auto from = screen.of(middle), to = screen.of(tip);
    if (!from || !to) return;
    ImGui::GetBackgroundDrawList()->AddLine(*from, *to, color, 0.14f * em());
    if (drag(context, "move clip plane", *from, "Drag to move the clip plane").moved)
        snap_to(clip, {middle - share_along(*from, *to) * length * shown_side, clip.normal}, box);
    if (drag(context, "turn clip plane", *to, "Drag to turn the clip plane").moved) {
        const Vec3 turned = (screen.moved(tip, ImGui::GetIO().MouseDelta) - middle).normalized();
        snap_to(clip, {middle, clip.flipped ? Vec3(-turned) : turned}, box);
    }
}

// The cut that is shown with its plane and can be made again; null: there is none.
const Cut* movable_cut(const UiContext& context) {
    const Document& document = context.session.document();
    const ViewState& state = context.state;
    if (!document.trace || document.progress.running || context.session.busy() || !state.look.plane) return nullptr;
    const Step& step = context.steps[nearest_step(context.steps, state.step)];
    if (step.refused_try >= 0 || step.stage < Stage::plane || step.stage >= Stage::split) return nullptr;
    const Cut* cut = document.trace->find(state.node);
    return cut && cut->made() ? cut : nullptr;
}

void draw_cut_handle(UiContext& context, CutHandleMemory& memory, const Rectangle& scene, const ScreenPlace& screen) {
    const Cut* cut = movable_cut(context);
    if (!cut || cut->node != memory.node) memory.dragged = 0;
    if (!cut) return;
    memory.node = cut->node;
    const Document& document = context.session.document();
    const double length = 5 * em() * screen.unit();
    const Vec3 &normal = cut->plane.normal, &origin = cut->plane.origin;
    const Vec3 middle = origin + memory.dragged * normal;
    const auto from = screen.of(middle), to = screen.of(middle + length * normal);
    if (!from || !to) {
        memory.dragged = 0;
        return;
    }
    if (memory.dragged != 0)
        draw_outline(screen, scene, corners_of(middle, normal, document.box),
                     packed(palette(context.state.theme).accent));
    const Dragged dragged = drag(context, "move cut", *from, "Drag the plane to where this cut is to be made");
    if (dragged.moved) memory.dragged += share_along(*from, *to) * length;
    if (!dragged.released || memory.dragged == 0) return;
    context.actions.runs.redo_cut(cut->node, document.options, cut->plane.shifted(memory.dragged));
    memory.dragged = 0;
}

}  // namespace

void draw_plane_handles(UiContext& context, CutHandleMemory& memory, const Rectangle& scene) {
    const ScreenPlace screen(context.camera, scene, body_area(context.state, scene));
    draw_clip_handles(context, scene, screen);
    draw_cut_handle(context, memory, scene, screen);
}

}  // namespace kerf::view

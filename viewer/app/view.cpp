#include "viewer/app/view.h"

#include <imgui.h>

#include "viewer/app/settings.h"

namespace kerf::view {

namespace {

constexpr double seconds_of_notice = 6;

}  // namespace

ViewState of_scene(ViewState state) {
    state.camera.reset();
    state.panels = {};
    state.deformation.speed = ViewState().deformation.speed;
    return state;
}

View::View(const Gl& gl, AppOptions given)
    : options(std::move(given)),
      settings(load_settings(options.config_folder)),
      session(options.kerf_program),
      renderer(gl, options.shader_folder) {
    state.theme = settings.theme;
    wake();
}

void View::notify(const std::string& text) {
    facts.notice = text;
    facts.notice_is_error = false;
    notice_until = ImGui::GetTime() + seconds_of_notice;
}

ViewState View::shown() const {
    ViewState shown = state;
    if (!session.document().tree.find(shown.node)) shown.node = root_node;
    return shown;
}

// The camera's target is in the middle of what the legend leaves.
Projection View::projection_into(const Rectangle& rectangle, const BuiltScene& scene) const {
    Projection into =
        project(camera, scene.frame, scene.box, static_cast<int>(rectangle.width), static_cast<int>(rectangle.height));
    const Rectangle left = body_area(state, rectangle);
    move_center(into, (2 * left.x + left.width - 2 * rectangle.x - rectangle.width) / std::max(rectangle.width, 1.f),
                -(2 * left.y + left.height - 2 * rectangle.y - rectangle.height) / std::max(rectangle.height, 1.f));
    into.x = static_cast<int>(rectangle.x);
    into.y = size.height - static_cast<int>(rectangle.y + rectangle.height);
    into.pixel_ratio = size.scale;
    return into;
}

std::optional<PickHit> View::pick(float x, float y) {
    return renderer.pick(built.scene, projection, static_cast<int>(x), static_cast<int>(y));
}

}  // namespace kerf::view

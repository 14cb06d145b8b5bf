#include "viewer/app/view.h"

#include <imgui.h>

#include "viewer/app/settings.h"

namespace kerf::view {

namespace {

constexpr double seconds_of_notice = 6;

}  // namespace

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

std::optional<PickHit> View::pick(float x, float y) {
    return renderer.pick(built.scene, projection, static_cast<int>(x), static_cast<int>(y));
}

}  // namespace kerf::view

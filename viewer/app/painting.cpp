// Whether the whole takes too long is measured when it was last painted, and the driver has to have finished for that.
// It is asked for again once the camera has rested for a moment, and always for a picture that is kept. While the mouse
// moves slowly it rests between its events, too, so that the moment must not be too short.
#include "viewer/app/painting.h"

#include <imgui.h>

#include "base/core/stopwatch.h"
#include "viewer/scene/stand_in.h"

namespace kerf::view {

namespace {

constexpr double seconds_to_rest = 0.2;

}  // namespace

void Painting::follow(bool by_hand) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool has_moved = !(view_.camera == camera_) && (ImGui::IsAnyMouseDown() || io.MouseWheel != 0);
    camera_ = view_.camera;
    if (by_hand && has_moved) moved_at_ = ImGui::GetTime();
    is_coarse_ = by_hand && whole_seconds_ > view_.options.frame_seconds && moved_at_ >= 0 &&
                 ImGui::GetTime() - moved_at_ < seconds_to_rest;
}

void Painting::paint() {
    const SceneBeside* beside = view_.beside ? &*view_.beside : nullptr;
    if (is_coarse_)
        return paint(stand_in(stand_in_, view_.built, view_.scenes_built),
                     beside ? &stand_in(stand_in_beside_, beside->built, beside->scenes_built) : nullptr);
    const Stopwatch stopwatch;
    paint(view_.built.scene, beside ? &beside->built.scene : nullptr);
    view_.renderer.finish();
    whole_seconds_ = stopwatch.seconds();
}

const Scene& Painting::stand_in(StandIn& stand_in, const BuiltScene& of, std::int64_t scenes_built) {
    if (stand_in.of != scenes_built) stand_in.scene = stand_in_for(of.scene);
    stand_in.of = scenes_built;
    return stand_in.scene;
}

void Painting::paint(const Scene& scene, const Scene* beside) {
    Renderer& renderer = view_.renderer;
    renderer.clear(scene.background_bottom);
    if (beside && view_.beside->area.width >= 1) renderer.draw(*beside, view_.beside->projection);
    if (view_.area.width >= 1 && view_.area.height >= 1) renderer.draw(scene, view_.projection);
    if (const ImDrawData* ui = ImGui::GetDrawData()) renderer.draw_ui(*ui, *ImGui::GetIO().Fonts);
}

Image Painting::picture() {
    is_coarse_ = false;
    paint();
    return view_.renderer.read();
}

}  // namespace kerf::view

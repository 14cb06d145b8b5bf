// The value under the mouse.
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "core/number_text.h"
#include "viewer/app/app.h"
#include "viewer/panels/text.h"

namespace kerf::view {

// Of what is drawn already: a pixel is drawn again when mouse or view have moved, and no scene is built. A picture
// to be kept has none.
void App::probe(bool panels) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_over_scene = !io.WantCaptureMouse && io.MousePos.x >= area_.x && io.MousePos.y >= area_.y &&
                               io.MousePos.x < area_.x + area_.width && io.MousePos.y < area_.y + area_.height;
    const bool is_steady = panels && !pressed_in_scene_ && !facts_.moving;
    if (!is_over_scene || !is_steady || !built_.legend.values) {
        facts_.probe.reset();
        probed_.reset();
        return;
    }
    const Probed here{numbered_view(), io.MousePos.x, io.MousePos.y};
    if (probed_ == here) return;
    probed_ = here;
    facts_.probe.reset();
    const auto hit =
        renderer_.pick(built_.scene, projection_, static_cast<int>(io.MousePos.x), static_cast<int>(io.MousePos.y));
    if (!hit || std::isnan(hit->value)) return;
    const Vec3 place = built_.frame.to_file(hit->rest.cast<double>());
    facts_.probe = ValueLabel{
        fmt::format("{} {}\n{}", title(state_.color), rounded(static_cast<double>(hit->value)), place_text(place)),
        io.MousePos.x, io.MousePos.y, true};
}

}  // namespace kerf::view

// A length to compare with, at the lower left of the scene, in units of the file: files do not say which these are. It
// is true for the plane of the camera's target, which is the middle of the body until somebody moves the camera.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// The largest of 1, 2, 5, 10, ... that is no longer.
double round_length(double longest) {
    const double power = std::pow(10, std::floor(std::log10(longest)));
    const double digit = longest / power;
    return power * (digit < 2 ? 1 : digit < 5 ? 2 : 5);
}

}  // namespace

void draw_scale_bar(UiContext& context, const Rectangle& scene) {
    const float e = em(), longest = std::min(0.25f * scene.width, 10 * e);
    const float least_width = (context.facts.beside ? 16 : 32) * e;
    if (!context.state.look.scale_bar || scene.width < least_width || !(context.camera.height > 0)) return;
    const double unit = scene.height / context.camera.height, length = round_length(longest / unit);
    if (!std::isfinite(length * unit)) return;
    const auto pixels = static_cast<float>(length * unit);
    const std::string text = fmt::format("{:.6g} {}", length, length == 1 ? "unit" : "units");
    const float line = ImGui::GetTextLineHeight(), width = std::max(pixels, width_of(text)), end = 0.3f * e;
    const Rectangle body = body_area(context.state, scene);  // a legend below it may be as wide as the scene
    const ImVec2 from = {scene.x + 1.2f * e, body.y + body.height - 1.1f * e - line - 2 * end};
    const Palette& colors = palette(context.state.theme);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    draw_backdrop(list, context.state.theme, from, {from.x + width, from.y + line + 2 * end});
    list.AddText(from, packed(colors.text), text.c_str());
    const float y = from.y + line + end, thick = 0.13f * e;
    list.AddLine({from.x, y}, {from.x + pixels, y}, packed(colors.text), thick);
    for (const float x : {from.x, from.x + pixels})
        list.AddLine({x, y - end}, {x, y + end}, packed(colors.text), thick);
}

}  // namespace kerf::view

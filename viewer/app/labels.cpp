// Numbers in the scene: of patches, of isolines, of the least and the largest value.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/app/app.h"
#include "viewer/panels/text.h"
#include "viewer/render/line_labels.h"

namespace kerf::view {

namespace {

constexpr float line_spacing = 11;  // between two numbers of one value, in heights of the font

}  // namespace

App::NumberedView App::numbered_view() const {
    return {projection_.projection * projection_.view,
            {projection_.x, projection_.y, projection_.width, projection_.height},
            scenes_built_};
}

// While the hand turns it, or it moves, a picture has none: they would jump, and each takes another drawing.
void App::place_labels() {
    const bool is_steady = !dragging_ && !facts_.moving;
    const NumberedView view = numbered_view();
    if (is_steady && numbered_ == view) return;
    numbered_.reset();
    facts_.labels.clear();
    if (area_.width < 1 || area_.height < 1) return facts_.numbers.clear();
    place_numbers();
    place_extremes();
    if (!is_steady) return;
    place_line_values();
    numbered_ = view;
}

// Of patches, where there is room for them on what is seen of their faces.
void App::place_numbers() {
    const auto has_numbers = [](const Layer& layer) { return layer.patch != nullptr; };
    const std::vector<Layer>& layers = built_.scene.layers;
    facts_.numbers.clear();
    if (std::none_of(layers.begin(), layers.end(), has_numbers)) return;
    const float least_room = 0.7f * ImGui::GetFontSize();
    for (const NumberPlace& place : renderer_.places_of_patches(built_.scene, projection_))
        if (static_cast<float>(place.room) >= least_room)
            facts_.numbers.push_back(
                {place.number, static_cast<float>(place.x) + 0.5f, static_cast<float>(place.y) + 0.5f});
}

void App::place_line_values() {
    const auto has_lines = [](const Layer& layer) { return !layer.geometry->origins.empty(); };
    const std::vector<Layer>& layers = built_.scene.layers;
    if (!state_.numbers || std::none_of(layers.begin(), layers.end(), has_lines)) return;
    const auto size = [](float value) {
        const ImVec2 extent = ImGui::CalcTextSize(rounded(static_cast<double>(value)).c_str());
        return Eigen::Vector2f(extent.x, extent.y);
    };
    std::vector<LabelArea> taken;
    for (const ValueLabel& label : facts_.labels) {
        const Rectangle r = rectangle_of(label);
        taken.push_back({{r.x, r.y}, {r.x + r.width, r.y + r.height}});
    }
    const LabelArea area{{body_.x, body_.y}, {body_.x + body_.width, body_.y + body_.height}};
    const std::vector<SeenSegment> seen = renderer_.seen_isolines(built_.scene, projection_);
    for (const LineLabel& label : places_on_lines(seen, size, area, line_spacing * ImGui::GetFontSize(), taken))
        facts_.labels.push_back({rounded(static_cast<double>(label.value)), label.place.x(), label.place.y()});
}

void App::place_extremes() {
    const std::vector<PlacedValue>& marked = built_.legend.marked;
    const Eigen::Matrix4f matrix = projection_.projection * projection_.view;
    for (std::size_t i = 0; i < marked.size(); ++i) {
        const Eigen::Vector3f p = built_.frame.to_draw(marked[i].place).cast<float>();
        const Eigen::Vector4f clip = matrix * p.homogeneous();
        if (!(clip.w() > 0)) continue;
        ValueLabel label;
        label.text = fmt::format("{} {}", i == 0 ? "least" : "largest", rounded(marked[i].value));
        label.x = area_.x + (clip.x() / clip.w() + 1) / 2 * area_.width;
        label.y = area_.y + (1 - clip.y() / clip.w()) / 2 * area_.height;
        label.is_beside = true;
        facts_.labels.push_back(label);
    }
}

}  // namespace kerf::view

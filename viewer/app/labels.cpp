// The places of the numbers in the scene, in pixels of the window. Numbers of patches and of isolines must lie where
// the patch or line is really seen: the renderer draws the scene once more with numbers for colours
// (places_of_patches(), seen_isolines()), which costs another frame, so that they are kept for as long as NumberedView
// is the same. The order matters: numbers of extremes are placed before those of isolines, which must not overlap them.
// The value under the mouse is read from the same kind of drawing of a single pixel.
#include "viewer/app/labels.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "base/core/number_text.h"
#include "viewer/panels/text.h"
#include "viewer/render/line_labels.h"

namespace kerf::view {

namespace {

constexpr float line_spacing = 11;  // least distance of two numbers of one value, in heights of the font

}  // namespace

Labels::NumberedView Labels::numbered_view() const {
    return {view_.projection.projection * view_.projection.view,
            {view_.projection.x, view_.projection.y, view_.projection.width, view_.projection.height},
            view_.scenes_built};
}

void Labels::place(bool held) {
    const bool is_steady = !held && !view_.facts.moving;
    const NumberedView view = numbered_view();
    if (is_steady && numbered_ == view) return;
    numbered_.reset();
    view_.facts.labels.clear();
    if (view_.area.width < 1 || view_.area.height < 1) return view_.facts.numbers.clear();
    place_numbers();
    place_extremes();
    if (!is_steady) return;
    place_line_values();
    numbered_ = view;
}

// Places the numbers of patches where there is room for them on the visible part of their faces.
void Labels::place_numbers() {
    const auto has_numbers = [](const Layer& layer) { return layer.patch != nullptr; };
    const std::vector<Layer>& layers = view_.built.scene.layers;
    view_.facts.numbers.clear();
    if (!view_.state.look.numbers || std::none_of(layers.begin(), layers.end(), has_numbers)) return;
    const float least_room = 0.7f * ImGui::GetFontSize();
    for (const NumberPlace& place : view_.renderer.places_of_patches(view_.built.scene, view_.projection))
        if (place.room >= least_room)
            view_.facts.numbers.push_back({patch_number(place.number), place.x + 0.5f, place.y + 0.5f});
}

void Labels::place_line_values() {
    const auto has_lines = [](const Layer& layer) { return !layer.geometry->origins.empty(); };
    const std::vector<Layer>& layers = view_.built.scene.layers;
    if (!view_.state.look.numbers || std::none_of(layers.begin(), layers.end(), has_lines)) return;
    const auto size = [](float value) {
        const ImVec2 extent = ImGui::CalcTextSize(rounded(value).c_str());
        return Eigen::Vector2f(extent.x, extent.y);
    };
    std::vector<LabelArea> taken;
    for (const ValueLabel& label : view_.facts.labels) {
        const Rectangle r = rectangle_of(label);
        taken.push_back({{r.x, r.y}, {r.x + r.width, r.y + r.height}});
    }
    const LabelArea area{{view_.body.x, view_.body.y},
                         {view_.body.x + view_.body.width, view_.body.y + view_.body.height}};
    const std::vector<SeenSegment> seen = view_.renderer.seen_isolines(view_.built.scene, view_.projection);
    for (const LineLabel& label : places_on_lines(seen, size, area, line_spacing * ImGui::GetFontSize(), taken))
        view_.facts.labels.push_back({rounded(label.value), label.place.x(), label.place.y()});
}

void Labels::place_extremes() {
    const std::vector<PlacedValue>& marked = view_.built.legend.marked;
    const Eigen::Matrix4f matrix = view_.projection.projection * view_.projection.view;
    for (std::size_t i = 0; i < marked.size(); ++i) {
        const Eigen::Vector3f p = view_.built.frame.to_draw(marked[i].place).cast<float>();
        const Eigen::Vector4f clip = matrix * p.homogeneous();
        if (!(clip.w() > 0)) continue;
        ValueLabel label;
        label.text = fmt::format("{} {}", i == 0 ? "least" : "largest", rounded(marked[i].value));
        label.x = view_.area.x + (clip.x() / clip.w() + 1) / 2 * view_.area.width;
        label.y = view_.area.y + (1 - clip.y() / clip.w()) / 2 * view_.area.height;
        label.is_beside = true;
        view_.facts.labels.push_back(label);
    }
}

void Labels::probe(bool wanted) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool is_over_scene = !io.WantCaptureMouse && view_.area.contains(io.MousePos.x, io.MousePos.y);
    const bool is_steady = wanted && !view_.facts.moving;
    if (!is_over_scene || !is_steady || !view_.built.legend.values) {
        view_.facts.probe.reset();
        probed_.reset();
        return;
    }
    const Probed here{numbered_view(), io.MousePos.x, io.MousePos.y};
    if (probed_ == here) return;
    probed_ = here;
    view_.facts.probe.reset();
    const auto hit = view_.pick(io.MousePos.x, io.MousePos.y);
    if (!hit || std::isnan(hit->value)) return;
    const Vec3 place = view_.built.frame.to_file(hit->rest.cast<double>());
    view_.facts.probe =
        ValueLabel{fmt::format("{} {}\n{}", title(view_.state.coloring.by), rounded(hit->value), place_text(place)),
                   io.MousePos.x, io.MousePos.y, true};
}

}  // namespace kerf::view

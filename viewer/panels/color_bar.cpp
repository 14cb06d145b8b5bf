// A bar with the colours over all values. A drag over it gives the values between which colours change; a drag of an
// end of the colours moves that end.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

class ColorBar {
 public:
    ColorBar(UiContext& context, ColorBarMemory& memory, const ValueRange& colored, const ValueRange& extent)
        : context_(context), memory_(memory), colored_(colored), extent_(extent) {}

    void draw() {
        size_ = {ImGui::GetContentRegionAvail().x, 1.3f * em()};
        from_ = ImGui::GetCursorScreenPos();
        ImGui::InvisibleButton("##colour bar", size_);
        context_.widgets.record("colour bar");
        draw_colors();
        const float x = ImGui::GetIO().MousePos.x;
        if (ImGui::IsItemClicked()) begin_drag(x);
        if (ImGui::IsItemActive() && std::abs(x - ImGui::GetIO().MouseClickedPos[0].x) >= 3) drag_to(value_at(x));
        if (ImGui::IsItemHovered() && !ImGui::IsItemActive())
            explain(fmt::format("{}\nDrag over it, or an end of the colours, to spread them otherwise.",
                                rounded(value_at(x))));
    }

 private:
    double length() const { return extent_.high - extent_.low; }
    float x_of(double value) const {
        return from_.x + size_.x * static_cast<float>(std::clamp((value - extent_.low) / length(), 0., 1.));
    }
    double value_at(float x) const { return extent_.low + length() * std::clamp((x - from_.x) / size_.x, 0.f, 1.f); }

    void draw_colors() const {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const std::vector<Color>& scale = context_.facts.legend.scale;
        const ImVec2 to = {from_.x + size_.x, from_.y + size_.y};
        const float low = x_of(colored_.low), high = x_of(colored_.high);
        list.AddRectFilled(from_, {low, to.y}, packed(scale.front()));
        list.AddRectFilled({high, from_.y}, to, packed(scale.back()));
        const float pieces = scale.size() - 1;
        for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
            const float left = low + (high - low) * i / pieces;
            const float right = low + (high - low) * (i + 1) / pieces;
            const ImU32 first = packed(scale[i]), second = packed(scale[i + 1]);
            list.AddRectFilledMultiColor({left, from_.y}, {right, to.y}, first, second, second, first);
        }
        const Palette& colors = palette(context_.state.theme);
        list.AddRect(from_, to, packed(colors.dim));
        for (const float end : {low, high})
            list.AddRectFilled({end - 1.5f, from_.y - 2}, {end + 1.5f, to.y + 2}, packed(colors.text));
    }

    void begin_drag(float x) {
        const float reach = 0.5f * em(), to_low = std::abs(x - x_of(colored_.low)),
                    to_high = std::abs(x - x_of(colored_.high));
        memory_.drag_from = value_at(x);
        if (std::min(to_low, to_high) < reach) memory_.drag_from = to_low < to_high ? colored_.high : colored_.low;
    }

    // Spreads the colours between this value and the one where the drag began, or the other end.
    void drag_to(double value) {
        const double least = 1e-3 * length();  // else there would be no colours between
        if (std::abs(value - memory_.drag_from) < least) return;
        context_.state.coloring.range = {std::min(value, memory_.drag_from), std::max(value, memory_.drag_from)};
    }

    UiContext& context_;
    ColorBarMemory& memory_;
    const ValueRange colored_, extent_;
    ImVec2 from_, size_;
};

}  // namespace

void draw_color_bar(UiContext& context, ColorBarMemory& memory) {
    const ViewState& state = context.state;
    const auto& values = context.facts.legend.values;
    const std::string of = fmt::format("{} of {}", name(state.coloring.by), context.session.document().path);
    if (memory.colored_of != of) memory.colored.reset();
    memory.colored_of = of;
    if (values && !state.coloring.range) memory.colored = values;
    if (!values || context.facts.legend.scale.size() < 2) return;
    const ValueRange colored = state.coloring.range.value_or(*values);
    ValueRange extent = memory.colored.value_or(values_of_run(context));
    extent = {std::min(extent.low, colored.low), std::max(extent.high, colored.high)};
    if (extent.high > extent.low) ColorBar(context, memory, colored, extent).draw();
}

}  // namespace kerf::view

// What the colours of the scene mean, at its lower right.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/parts.h"

namespace kerf::view {

namespace {

constexpr std::size_t most_categories = 12;

// Ticks of one legend have equally many decimals.
std::string tick_text(double value, double step) {
    const double size = std::max(std::abs(value), std::abs(step));
    if (size >= 1e5 || step < 1e-4) return fmt::format("{:.3g}", value);
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return fmt::format("{:.{}f}", value, decimals);
}

class Legend {
 public:
    Legend(const UiContext& context, const Rectangle& scene)
        : context_(context), scene_(scene), colors_(palette(context.state.theme)) {}

    void draw() {
        if (context_.facts.values && context_.facts.scale.size() >= 2)
            draw_scale();
        else if (!context_.facts.categories.empty())
            draw_categories();
    }

 private:
    // The ground for a content of this size; returns its upper left corner, below the title.
    ImVec2 begin(float width, float height) {
        const float e = em(), line = ImGui::GetTextLineHeight();
        const std::string& head = context_.facts.legend_title;
        std::string filter;
        if (context_.state.filter && is_measure(context_.state.color))
            filter =
                fmt::format("only {} to {}", rounded(context_.state.filter->low), rounded(context_.state.filter->high));
        width = std::max({width, std::min(width_of(head), 9 * e), width_of(filter)});
        const float head_height = ImGui::CalcTextSize(head.c_str(), nullptr, false, width).y;
        const float lines = (head.empty() ? 0 : head_height) + (filter.empty() ? 0 : line);
        const float titles = lines > 0 ? lines + 0.4f * e : 0;
        const ImVec2 to = {scene_.x + scene_.width - 1.2f * e, scene_.y + scene_.height - 1.1f * e};
        const ImVec2 from = {to.x - width, to.y - height - titles};
        draw_backdrop(list_, context_.state.theme, from, to);
        list_.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, packed(colors_.text), head.c_str(), nullptr, width);
        if (!filter.empty()) list_.AddText({from.x, from.y + head_height}, packed(colors_.accent), filter.c_str());
        return {from.x, from.y + titles};
    }

    void draw_scale() {
        const ValueRange range = context_.state.color_range.value_or(*context_.facts.values);
        const float e = em(), bar = 1.1f * e, height = std::clamp(0.3f * scene_.height, 5 * e, 11 * e);
        const std::vector<double> ticks = round_ticks(range.low, range.high, 5);
        const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : range.high - range.low;
        const auto text_of = [&](double tick) { return ticks.size() > 1 ? tick_text(tick, step) : rounded(tick); };
        float widest = 0;
        for (const double tick : ticks) widest = std::max(widest, width_of(text_of(tick)));
        ImVec2 from = begin(bar + 0.9f * e + widest, height + ImGui::GetTextLineHeight());
        from.y += ImGui::GetTextLineHeight() / 2;  // room for the text of a tick at the very end
        draw_bar(from, bar, height);
        for (const double tick : ticks) {
            const double part = range.high > range.low ? (tick - range.low) / (range.high - range.low) : 0.5;
            const float y = from.y + height * static_cast<float>(1 - part);
            list_.AddLine({from.x + bar, y}, {from.x + bar + 0.35f * e, y}, packed(colors_.text));
            list_.AddText({from.x + bar + 0.6f * e, y - ImGui::GetTextLineHeight() / 2}, packed(colors_.text),
                          text_of(tick).c_str());
        }
    }

    // Highest at the top.
    void draw_bar(const ImVec2& from, float width, float height) {
        const std::vector<Color>& scale = context_.facts.scale;
        const auto pieces = static_cast<float>(scale.size() - 1);
        for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
            const float low = from.y + height * (1 - static_cast<float>(i) / pieces);
            const float high = from.y + height * (1 - static_cast<float>(i + 1) / pieces);
            const ImU32 below = packed(scale[i]), above = packed(scale[i + 1]);
            list_.AddRectFilledMultiColor({from.x, high}, {from.x + width, low}, above, above, below, below);
        }
        list_.AddRect(from, {from.x + width, from.y + height}, packed(colors_.dim));
    }

    void draw_categories() {
        const auto& categories = context_.facts.categories;
        const float e = em(), line = ImGui::GetTextLineHeight() + 0.15f * e, swatch = 0.8f * e;
        const auto fitting = static_cast<std::size_t>(std::max(1.f, (scene_.height - 11 * e) / line));
        const std::size_t shown = std::min({categories.size(), most_categories, fitting});
        const std::string more =
            categories.size() > shown ? fmt::format("+ {} more", categories.size() - shown) : std::string();
        float widest = width_of(more);
        std::vector<std::string> names;
        for (std::size_t i = 0; i < shown; ++i) {
            names.push_back(shortened(categories[i].first, 12 * e));
            widest = std::max(widest, width_of(names.back()));
        }
        const float lines = static_cast<float>(shown + (more.empty() ? 0 : 1));
        ImVec2 at = begin(swatch + 0.6f * e + widest, lines * line);
        for (std::size_t i = 0; i < shown; ++i, at.y += line) {
            const float drop = (ImGui::GetTextLineHeight() - swatch) / 2;
            list_.AddRectFilled({at.x, at.y + drop}, {at.x + swatch, at.y + drop + swatch},
                                packed(categories[i].second), 0.15f * e);
            list_.AddText({at.x + swatch + 0.6f * e, at.y}, packed(colors_.text), names[i].c_str());
        }
        list_.AddText({at.x + swatch + 0.6f * e, at.y}, packed(colors_.dim), more.c_str());
    }

    const UiContext& context_;
    const Rectangle& scene_;
    const Palette& colors_;
    ImDrawList& list_ = *ImGui::GetBackgroundDrawList();
};

}  // namespace

void draw_legend(UiContext& context, const Rectangle& scene) {
    if (context.state.legend) Legend(context, scene).draw();
}

}  // namespace kerf::view

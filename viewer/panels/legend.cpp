// The legend at the lower right of the scene: a title, a scale with ticks where colours are numbers, and samples of
// other colours. It is a part of the picture and should not cover the body: body_area() gives it a strip at the right
// of a wide scene and below the body of another one, besides one for the caption above, of a size that does not depend
// on its content, and the camera fits the body into the rest. The legend is measured first (prepare_scale(),
// prepare_entries()) and then placed by its lower right corner. Entries that have no room become "+ N more". Ticks are
// round values with equally many decimals.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

constexpr std::size_t most_categories = 12;

// The text of a tick; ticks of one legend have equally many decimals.
std::string tick_text(double value, double step) {
    const double size = std::max(std::abs(value), std::abs(step));
    if (size >= 1e5 || step < 1e-4) return fmt::format("{:.3g}", value);
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    return fmt::format("{:.{}f}", value, decimals);
}

// The legend stands at the right of the body in a wide scene, and below it in another one.
bool is_wide(const Rectangle& scene) { return scene.width > 1.25f * scene.height; }

class LegendBox {
 public:
    LegendBox(const UiContext& context, const Rectangle& scene)
        : context_(context), legend_(context.facts.legend), scene_(scene), colors_(palette(context.state.theme)) {
        const float e = em();
        const Rectangle body = body_area(context.state, scene);
        widest_ = (is_wide(scene) ? scene.width - body.width : scene.width) - 2 * e;
        const float below = scene.y + scene.height - body.y - body.height;
        highest_ = (is_wide(scene) ? scene.height - 9 * e : below) - 1.5f * e;
        if (!legend_.title.empty()) highest_ -= ImGui::GetTextLineHeight() + 0.4f * e;
    }

    // Draws title, scale (if colours are numbers) and entries from top to bottom.
    void draw() {
        const bool has_scale = legend_.values && legend_.scale.size() >= 2;
        if (!has_scale && legend_.categories.empty()) return;
        if (has_scale) prepare_scale();
        prepare_entries();
        const float gap = has_scale && shown_ > 0 ? 0.6f * em() : 0;
        ImVec2 at = begin(scale_height_ + gap + line_height() * rows_);
        if (has_scale) draw_scale(at);
        at.y += scale_height_ + gap;
        draw_entries(at);
    }

 private:
    // Draws ground and title for a content of this height; returns the upper left corner of the content, below the
    // title.
    ImVec2 begin(float height) {
        const float e = em(), line = ImGui::GetTextLineHeight();
        const std::string& head = legend_.title;
        std::string filter;
        if (filter_) filter = fmt::format("only {} to {}", rounded(filter_->low), rounded(filter_->high));
        const float width = std::min(std::max({width_, std::min(width_of(head), 9 * e), width_of(filter)}), widest_);
        const float head_height = head.empty() ? 0 : ImGui::CalcTextSize(head.c_str(), nullptr, false, width).y;
        const float lines = head_height + (filter.empty() ? 0 : line);
        const float titles = lines > 0 ? lines + 0.4f * e : 0;
        const ImVec2 to = {scene_.x + scene_.width - 1.2f * e, scene_.y + scene_.height - 1.1f * e};
        const ImVec2 from = {to.x - width, to.y - height - titles};
        draw_backdrop(list_, context_.state.theme, from, to);
        list_.AddText(ImGui::GetFont(), ImGui::GetFontSize(), from, packed(colors_.text), head.c_str(), nullptr, width);
        if (!filter.empty()) list_.AddText({from.x, from.y + head_height}, packed(colors_.accent), filter.c_str());
        return {from.x, from.y + titles};
    }

    void prepare_scale() {
        range_ = context_.state.coloring.range.value_or(*legend_.values);
        if (is_measure(context_.state.coloring.by)) filter_ = context_.state.coloring.filter;
        const float entries = line_height() * (legend_.categories.size() + 2);
        bar_height_ = std::clamp(std::min(0.7f * highest_, highest_ - entries), 4.5f * em(), 11 * em());
        const float most_ticks = bar_height_ / (1.3f * ImGui::GetTextLineHeight());
        ticks_ = round_ticks(range_.low, range_.high, std::clamp(static_cast<int>(most_ticks), 2, 5));
        scale_height_ = bar_height_ + ImGui::GetTextLineHeight();  // room for the text of a tick at the very end
        if (legend_.extremes) {
            least_ = "least " + rounded(legend_.extremes->low);
            largest_ = "largest " + rounded(legend_.extremes->high);
            scale_height_ += 2 * ImGui::GetTextLineHeight();
            width_ = std::max({width_, width_of(least_), width_of(largest_)});
        }
        for (const double tick : ticks_) width_ = std::max(width_, 2 * em() + width_of(text_of(tick)));
    }

    std::string text_of(double tick) const {
        return ticks_.size() > 1 ? tick_text(tick, ticks_[1] - ticks_[0]) : rounded(tick);
    }

    float height_of(double value) const {
        const double part = range_.high > range_.low ? (value - range_.low) / (range_.high - range_.low) : 0.5;
        return bar_height_ * static_cast<float>(std::clamp(part, 0.0, 1.0));
    }

    void draw_scale(const ImVec2& from) {
        const float e = em(), bar = 1.1f * e, above = legend_.extremes ? ImGui::GetTextLineHeight() : 0;
        const float bottom = from.y + above + ImGui::GetTextLineHeight() / 2 + bar_height_;
        draw_bar({from.x, bottom - bar_height_}, bar);
        draw_ends({from.x, bottom - bar_height_}, bar);
        for (const double tick : ticks_) {
            const float y = bottom - height_of(tick);
            const ImVec4& color = is_filtered_out(tick) ? colors_.dim : colors_.text;
            list_.AddLine({from.x + bar, y}, {from.x + bar + 0.35f * e, y}, packed(color));
            list_.AddText({from.x + bar + 0.6f * e, y - ImGui::GetTextLineHeight() / 2}, packed(color),
                          text_of(tick).c_str());
        }
        draw_extremes(from, bottom);
    }

    // Draws pointed ends of the bar where values beyond it have its last colours. A solution has its extremes written
    // there instead.
    void draw_ends(const ImVec2& from, float width) {
        if (legend_.extremes) return;
        const float middle = from.x + width / 2, bottom = from.y + bar_height_, point = 0.4f * em();
        if (legend_.goes_above)
            list_.AddTriangleFilled({from.x, from.y}, {from.x + width, from.y}, {middle, from.y - point},
                                    packed(legend_.scale.back()));
        if (legend_.goes_below)
            list_.AddTriangleFilled({from.x, bottom}, {from.x + width, bottom}, {middle, bottom + point},
                                    packed(legend_.scale.front()));
    }

    // Writes the extremes above and below the bar, each with a mark at its colour.
    void draw_extremes(const ImVec2& from, float bottom) {
        if (!legend_.extremes) return;
        const float half = 0.28f * em();
        list_.AddText(from, packed(colors_.text), largest_.c_str());
        list_.AddText({from.x, bottom + ImGui::GetTextLineHeight() / 2}, packed(colors_.text), least_.c_str());
        for (const double value : {legend_.extremes->low, legend_.extremes->high}) {
            const float y = bottom - height_of(value);
            list_.AddTriangleFilled({from.x - 1.5f * half, y - half}, {from.x, y}, {from.x - 1.5f * half, y + half},
                                    packed(colors_.text));
        }
    }

    bool is_filtered_out(double value) const { return filter_ && (value < filter_->low || value > filter_->high); }

    // Draws the bar, its highest value at the top. Values that a filter leaves out are veiled, as the picture does not
    // have their colours.
    void draw_bar(const ImVec2& from, float width) {
        const std::vector<Color>& scale = legend_.scale;
        const float pieces = scale.size() - 1;
        for (std::size_t i = 0; i + 1 < scale.size(); ++i) {
            const float low = from.y + bar_height_ * (1 - i / pieces);
            const float high = from.y + bar_height_ * (1 - (i + 1) / pieces);
            const ImU32 below = packed(scale[i]), above = packed(scale[i + 1]);
            list_.AddRectFilledMultiColor({from.x, high}, {from.x + width, low}, above, above, below, below);
        }
        if (filter_) {
            const float low = from.y + bar_height_ - height_of(filter_->low);
            const float high = from.y + bar_height_ - height_of(filter_->high);
            for (const auto& [top, bottom] : {std::pair(from.y, high), {low, from.y + bar_height_}})
                list_.AddRectFilled({from.x, top}, {from.x + width, bottom}, packed(faded(colors_.panel, 0.9f)));
            list_.AddRect({from.x - 1, high}, {from.x + width + 1, low}, packed(colors_.accent), 0, 0, 0.12f * em());
        }
        list_.AddRect(from, {from.x + width, from.y + bar_height_}, packed(colors_.dim));
    }

    static std::string more_text(std::size_t count) { return fmt::format("+ {} more", count); }
    float line_height() const { return ImGui::GetTextLineHeight() + 0.15f * em(); }
    static float sample_width() { return 1.1f * em(); }

    // Arranges the entries: one below the other at the right of the body, in columns below it.
    void prepare_entries() {
        const auto& entries = legend_.categories;
        const float e = em(), sample = sample_width() + 0.6f * e, room = highest_ - scale_height_;
        const auto rows = static_cast<std::size_t>(std::max(1.f, room / line_height()));
        const float longest = is_wide(scene_) ? widest_ - sample : 10 * e;
        column_width_ = 0;
        for (const LegendEntry& entry : entries) {
            names_.push_back(shortened(entry.text, longest));
            column_width_ = std::max(column_width_, sample + width_of(names_.back()));
            if (names_.size() == most_categories) break;
        }
        if (entries.size() > names_.size())
            column_width_ = std::max(column_width_, sample + width_of(more_text(entries.size())));
        const auto columns =
            is_wide(scene_) ? 1 : static_cast<std::size_t>(std::max(1.f, std::floor(widest_ / (column_width_ + e))));
        shown_ = std::min(names_.size(), rows * columns);
        if (entries.size() > shown_) {
            shown_ = std::min(shown_, rows * columns - (rows > 1 ? 1 : 0));
            more_ = more_text(entries.size() - shown_);
        }
        const std::size_t cells = shown_ + (more_.empty() ? 0 : 1);
        rows_ = std::min(rows, cells);
        const float used = rows_ > 0 ? (cells + rows_ - 1) / rows_ : 0;
        if (used > 0) width_ = std::max(width_, used * column_width_ + (used - 1) * e);
    }

    void draw_entries(const ImVec2& from) {
        const float e = em(), left = sample_width() + 0.6f * e;
        const auto place = [&](std::size_t i) {
            return ImVec2{from.x + (i / rows_) * (column_width_ + e), from.y + (i % rows_) * line_height()};
        };
        for (std::size_t i = 0; i < shown_; ++i) {
            const ImVec2 at = place(i);
            draw_sample(legend_.categories[i], {at.x, at.y + ImGui::GetTextLineHeight() / 2});
            list_.AddText({at.x + left, at.y}, packed(colors_.text), names_[i].c_str());
        }
        if (more_.empty()) return;
        const ImVec2 at = place(shown_);
        list_.AddText({at.x + left, at.y}, packed(colors_.dim), more_.c_str());
    }

    // Draws a sample of the colour, as the scene has it; `left`: the middle of its left side.
    void draw_sample(const LegendEntry& entry, const ImVec2& left) {
        const float width = sample_width(), half = 0.4f * em();
        switch (entry.mark) {
            case LegendEntry::Mark::line:
                list_.AddLine(left, {left.x + width, left.y}, packed(entry.color), 0.22f * em());
                return;
            case LegendEntry::Mark::point:
                list_.AddCircleFilled({left.x + width / 2, left.y}, 0.32f * em(), packed(entry.color));
                return;
            case LegendEntry::Mark::area:
                const ImVec2 from = {left.x, left.y - half}, to = {left.x + width, left.y + half};
                Color outline = entry.color;
                outline.a = 1;
                list_.AddRectFilled(from, to, packed(entry.color), 0.15f * em());
                if (entry.color.a < 1) list_.AddRect(from, to, packed(outline), 0.15f * em());
        }
    }

    const UiContext& context_;
    const Legend& legend_;
    const Rectangle& scene_;
    const Palette& colors_;
    ImDrawList& list_ = *ImGui::GetBackgroundDrawList();
    float widest_ = 0, highest_ = 0;  // the room of the legend
    float width_ = 0;
    // Members of the scale:
    ValueRange range_;
    std::optional<ValueRange> filter_;
    std::vector<double> ticks_;
    float bar_height_ = 0, scale_height_ = 0;
    std::string least_, largest_;  // texts of the least and the largest value drawn
    // Members of the entries:
    std::size_t shown_ = 0, rows_ = 0;
    float column_width_ = 0;
    std::vector<std::string> names_;
    std::string more_;
};

}  // namespace

Rectangle body_area(const ViewState& state, const Rectangle& scene) {
    Rectangle body = scene;
    const float caption = std::min(3.4f * em(), 0.15f * scene.height);
    body.y += caption;
    body.height -= caption;
    if (!state.look.legend) return body;
    if (is_wide(scene))
        body.width -= std::clamp(0.25f * scene.width, std::min(10.5f * em(), 0.34f * scene.width), 13 * em());
    else
        body.height -= std::min(8.5f * em(), 0.25f * scene.height);
    return body;
}

void draw_legend(UiContext& context, const Rectangle& scene) {
    if (context.state.look.legend) LegendBox(context, scene).draw();
}

}  // namespace kerf::view

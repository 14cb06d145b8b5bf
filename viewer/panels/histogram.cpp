// The distribution of a measure over all cells of the run, from the bins of its report. Bin i lies between edges[i] and
// edges[i + 1]; bins before the first and after the last cell are not drawn. Positions along the axis are numbers of
// bins, not values, as the bins of some measures are logarithmic: place_of() goes from a value to them. A drag sets the
// filter to whole bins, so that the cells drawn are those counted. Heights may be logarithmic, log2(1 + count), so that
// a bin of one cell is seen beside one of a million.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

// The bins that hold cells, so that the picture is not mostly empty.
struct Span {
    std::size_t first = 0, last = 0;  // last: one behind
    std::size_t size() const { return last - first; }
};

Span used_bins(const std::vector<std::int64_t>& counts) {
    Span span{0, counts.size()};
    while (span.first + 1 < span.last && counts[span.first] == 0) ++span.first;
    while (span.last > span.first + 1 && counts[span.last - 1] == 0) --span.last;
    return span;
}

class HistogramView {
 public:
    HistogramView(UiContext& context, HistogramMemory& memory, const MeasureHistogram& histogram)
        : context_(context),
          memory_(memory),
          histogram_(histogram),
          colors_(palette(context.state.theme)),
          span_(used_bins(histogram.all)),
          most_(*std::max_element(histogram.all.begin(), histogram.all.end())) {}

    void draw() {
        const float e = em();
        size_ = {ImGui::GetContentRegionAvail().x, 6.5f * e};
        from_ = ImGui::GetCursorScreenPos();
        ImGui::InvisibleButton("##histogram", size_);
        context_.widgets.record("histogram");
        const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled(from_, {from_.x + size_.x, from_.y + size_.y}, packed(colors_.frame), 0.2f * e);
        for (std::size_t bin = span_.first; bin < span_.last; ++bin) draw_bin(list, bin, hovered);
        if (context_.state.coloring.filter) draw_filter(list);
        if (active) brush();
        if (hovered && !active) explain_bin(bin_at(ImGui::GetIO().MousePos.x));
        draw_axis();
    }

 private:
    float x_of(double bin) const { return from_.x + size_.x * static_cast<float>((bin - span_.first) / span_.size()); }
    std::size_t bin_at(float x) const {
        const double place = (x - from_.x) / size_.x * static_cast<double>(span_.size());
        return span_.first + static_cast<std::size_t>(std::clamp(place, 0., span_.size() - 1.));
    }
    float height_of(std::int64_t count) const {
        if (count <= 0 || most_ <= 0) return 0;
        const double part =
            memory_.log_counts ? std::log2(1 + count) / std::log2(1 + most_) : static_cast<double>(count) / most_;
        return std::max(1.f, 0.94f * size_.y * static_cast<float>(part));
    }

    // The place of a value among the bins, as a number of bins.
    double place_of(double value) const {
        const auto& edges = histogram_.edges;
        const auto above = std::upper_bound(edges.begin(), edges.end(), value);
        if (above == edges.begin()) return 0;
        if (above == edges.end()) return edges.size() - 1;
        const double low = *(above - 1), high = *above;
        return above - edges.begin() - 1 + (value - low) / (high - low);
    }

    // Draws a veil over the values that the filter leaves out.
    void draw_filter(ImDrawList& list) const {
        const ValueRange& filter = *context_.state.coloring.filter;
        const float left = std::clamp(x_of(place_of(filter.low)), from_.x, from_.x + size_.x);
        const float right = std::clamp(x_of(place_of(filter.high)), from_.x, from_.x + size_.x);
        const ImVec2 end = {from_.x + size_.x, from_.y + size_.y};
        const ImU32 veil = packed(faded(colors_.panel, 0.75f));
        list.AddRectFilled(from_, {left, end.y}, veil);
        list.AddRectFilled({right, from_.y}, end, veil);
        list.AddRect({left, from_.y}, {right, end.y}, packed(colors_.accent));
    }

    void draw_bin(ImDrawList& list, std::size_t bin, bool hovered) const {
        const float left = x_of(bin), right = x_of(bin + 1);
        const float gap = right - left > 4 ? 1.f : 0.f, floor = from_.y + size_.y;
        const bool under = hovered && bin == bin_at(ImGui::GetIO().MousePos.x);
        const auto bar = [&](std::int64_t count, const ImVec4& color) {
            if (count > 0) list.AddRectFilled({left, floor - height_of(count)}, {right - gap, floor}, packed(color));
        };
        bar(histogram_.all[bin], faded(colors_.accent, under ? 0.55f : 0.4f));
        if (bin < histogram_.interface.size()) bar(histogram_.interface[bin], colors_.accent);
    }

    // Sets the filter to whole bins, so that the cells shown are those counted.
    void brush() {
        const ImGuiIO& io = ImGui::GetIO();
        if (ImGui::IsItemClicked()) memory_.brush_from = bin_at(io.MousePos.x);
        if (std::abs(io.MousePos.x - io.MouseClickedPos[0].x) < 3) return;
        const std::size_t start = memory_.brush_from, here = bin_at(io.MousePos.x);
        context_.state.coloring.filter = {histogram_.edges[std::min(start, here)],
                                          histogram_.edges[std::max(start, here) + 1]};
    }

    void explain_bin(std::size_t bin) const {
        std::string text = fmt::format("{} to {}\n{} cells", rounded(histogram_.edges[bin]),
                                       rounded(histogram_.edges[bin + 1]), histogram_.all[bin]);
        if (bin < histogram_.interface.size()) text += fmt::format(", {} at an interface", histogram_.interface[bin]);
        ImGui::SetTooltip("%s\nDrag to show only some of them", text.c_str());
    }

    void draw_axis() const {
        show(rounded(histogram_.edges[span_.first]), colors_.dim);
        ImGui::SameLine();
        show_right(rounded(histogram_.edges[span_.last]), colors_.dim);
        show(fmt::format("min {}, median {}, max {}", rounded(histogram_.min), rounded(histogram_.median),
                         rounded(histogram_.max)),
             colors_.text);
    }

    UiContext& context_;
    HistogramMemory& memory_;
    const MeasureHistogram& histogram_;
    const Palette& colors_;
    Span span_;
    std::int64_t most_;
    ImVec2 from_, size_;
};

void draw_key(const Palette& colors) {
    const auto swatch = [](const ImVec4& color, const char* text, const ImVec4& ink) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float size = 0.7f * em(), drop = (ImGui::GetTextLineHeight() - size) / 2;
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + drop}, {at.x + size, at.y + drop + size},
                                                  packed(color));
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 1.1f * em());
        show(text, ink);
    };
    swatch(faded(colors.accent, 0.4f), "all", colors.dim);
    ImGui::SameLine(0, em());
    swatch(colors.accent, "at an interface", colors.dim);
}

}  // namespace

int histogram_number(ColorBy color) {
    switch (color) {
        case ColorBy::min_dihedral:
            return 0;
        case ColorBy::radius_edge:
            return 2;
        case ColorBy::aspect:
            return 3;
        case ColorBy::shape:
            return 4;
        case ColorBy::volume:
            return 5;
        case ColorBy::edge_length:
            return 7;
        default:
            return -1;
    }
}

void draw_histogram(UiContext& context, HistogramMemory& memory) {
    const int measure = histogram_number(context.state.coloring.by);
    if (measure < 0) return;
    const auto& histogram = context.session.document().histograms[measure];
    const Palette& colors = palette(context.state.theme);
    if (!histogram || histogram->all.empty() || histogram->edges.size() != histogram->all.size() + 1)
        return show_wrapped("No distribution: the report of a finished run has it.", colors.dim);
    HistogramView(context, memory, *histogram).draw();
    draw_key(colors);
    context.widgets.checkbox("Log counts", &memory.log_counts,
                             "So that few bad cells can be seen beside many good ones");
}

}  // namespace kerf::view

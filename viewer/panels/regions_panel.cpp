// The list of regions of a body that has several. Each row shows the colour of a region (where the scene is coloured by
// regions), switches that hide it, isolate it or make it glass, its name and its tetrahedra, which are summed over its
// parts once a frame. The view state knows regions by name, as files and options do, not by number. The panel is
// disabled at steps that do not show parts, because regions are drawn as parts.
#include <algorithm>

#include <fmt/format.h>

#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "viewer/model/shown_parts.h"
#include "viewer/panels/inside/icons.h"
#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

class RegionList {
 public:
    explicit RegionList(UiContext& context)
        : context_(context),
          document_(context.session.document()),
          state_(context.state),
          colors_(palette(context.state.theme)),
          tets_(document_.region_names.size(), 0) {
        for (const TreeRow& row : document_.tree.rows)
            if (row.leaf() && row.tets > 0 && row.region.is_valid() && row.region < RegionIndex(tets_.size()))
                tets_[row.region] += row.tets;
    }

    void draw() {
        constexpr float most_rows = 8;
        const float rows = std::min<float>(most_rows, document_.region_names.size());
        ImGui::BeginChild("##regions", {0, rows * row_height()});
        ImGuiListClipper clipper;
        clipper.Begin(count_of(document_.region_names), row_height());
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) draw_row(i);
        ImGui::EndChild();
    }

 private:
    static float side() { return ImGui::GetTextLineHeight() + 0.15f * em(); }
    static float row_height() { return side() + ImGui::GetStyle().ItemSpacing.y; }

    void draw_row(int number) {
        const std::string& region = document_.region_names[number];
        const bool is_shown = shows_region(state_, document_, region);
        ImGui::PushID(number);
        draw_swatch(region, is_shown ? 1 : 0.45f);
        draw_switches(region, is_shown);
        ImGui::SameLine(0, 0.5f * em());
        const std::string tets = tets_[number] > 0 ? compact(tets_[number]) : "";
        const float room = ImGui::GetContentRegionAvail().x - width_of(tets) - em();
        const ImVec4 color = faded(colors_.text, is_shown ? 1 : 0.45f);
        show(shortened(region, room), color);
        explain(tets.empty() ? region : fmt::format("{}: {} tetrahedra", region, grouped(tets_[number])));
        if (!tets.empty()) {
            ImGui::SameLine();
            show_right(tets, faded(colors_.dim, is_shown ? 1 : 0.45f));
        }
        ImGui::PopID();
    }

    void draw_swatch(const std::string& region, float alpha) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float size = 0.7f * em(), top = at.y + (side() - size) / 2;
        const Color* color = state_.coloring.by == ColorBy::region ? color_in_legend(context_.facts, region) : nullptr;
        ImDrawList& list = *ImGui::GetWindowDrawList();
        if (color)
            list.AddRectFilled({at.x, top}, {at.x + size, top + size}, packed(*color), 0.2f * size);
        else
            list.AddRect({at.x, top}, {at.x + size, top + size}, packed(faded(colors_.dim, 0.6f * alpha)), 0.2f * size);
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em());
    }

    bool draw_switch(const std::string& label, Icon icon, const ImVec4* on, const char* tip) {
        return icon_button(context_.widgets, label, icon, side(), packed(on ? *on : faded(colors_.dim, 0.55f)), tip);
    }

    void draw_switches(const std::string& region, bool is_shown) {
        if (draw_switch("show region " + region, is_shown ? Icon::eye : Icon::eye_closed,
                        is_shown ? nullptr : &colors_.warning, is_shown ? "Hide it" : "Hidden: show it again")) {
            if (is_shown)
                set_member(state_.visibility.hidden_regions, region, true);
            else
                reveal_region(state_, region);
        }
        ImGui::SameLine(0, 0.1f * em());
        const bool isolated = state_.visibility.isolated_region == region;
        if (draw_switch("isolate region " + region, Icon::isolate, isolated ? &colors_.accent : nullptr,
                        isolated ? "Show the others again" : "Show only this"))
            state_.visibility.isolated_region = isolated ? std::nullopt : std::optional(region);
        ImGui::SameLine(0, 0.1f * em());
        const bool glass = is_glass(state_, region);
        if (draw_switch("glass region " + region, Icon::glass, glass ? &colors_.accent : nullptr,
                        glass ? "Make it opaque again" : "Make it glass, so that what it holds is seen"))
            set_member(state_.visibility.glass_regions, region, !glass);
    }

    UiContext& context_;
    const Document& document_;
    ViewState& state_;
    const Palette& colors_;
    Array<RegionIndex, std::int64_t> tets_;
};

// Says why the list is disabled, and offers the way out.
void draw_reason(UiContext& context) {
    show_wrapped("Regions are shown by their parts, which this stage does not have.", palette(context.state.theme).dim);
    const Step last = context.steps.back();
    if (shows_parts(last.stage) && context.widgets.small_button("Show the parts", "Goes to the last stage"))
        context.state.step = last;
}

}  // namespace

void draw_regions(UiContext& context) {
    const Document& document = context.session.document();
    if (document.region_names.size() < 2) return;
    if (!context.widgets.header("Regions", true)) return;
    const bool has_parts = shows_parts(context.state.step.stage);
    if (!has_parts) draw_reason(context);
    ImGui::BeginDisabled(!has_parts);
    RegionList(context).draw();
    context.widgets.checkbox("Walls alone", &context.state.visibility.walls,
                             has_parts ? "Only facets between two regions" : "Parts are shown at Tetrahedra alone");
    context.widgets.checkbox("Explode as wholes", &context.state.explosion.regions,
                             "Explode moves regions, and leaves their parts together");
    ImGui::EndDisabled();
    ImGui::Spacing();
}

}  // namespace kerf::view

// One frame of the user interface, and the helpers that panels share. Order matters: the tour may exchange the view, so
// it comes first; splitters come before the panels, because the first of windows that stay where they are is in front;
// overlays are drawn into ImGui's background list, which lies behind all windows; dialogs come last. Dear ImGui keeps
// no state of Kerf's, so that each panel has its memory in Ui::Impl. Keys reach commands only here (Ui::press()), and
// not while a popup or a dialog has the keyboard, or a text field that the key belongs to. Steps that keys have asked
// of a list which no panel has drawn are forgotten at the end of the frame, and the list is left.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui_internal.h>  // whether any popup is open

#include "viewer/model/shown_parts.h"
#include "viewer/panels/inside/commands.h"

namespace kerf::view {

// The state of the panels, which ImGui does not keep.
struct Ui::Impl {
    Dialogs dialogs;
    TreeMemory tree;
    ProblemsMemory problems;
    ColorMemory color;
    TimelineMemory timeline;
    CutHandleMemory cut_handle;
    int patch_clicks = 0;  // right clicks on patches that were answered
    Theme theme = Theme::light;
    float scale = 0;

    void draw_problems_or_tree(UiContext& context);
    void draw_left(UiContext& context, const Layout& layout);
    void draw_right(UiContext& context, const Layout& layout);
};

void Ui::Impl::draw_problems_or_tree(UiContext& context) {
    const Document& document = context.session.document();
    const bool remarks = context.state.panels.problems && has_remarks(document);
    const bool is_repaired = document.unrepaired && !has_tree(document);
    if (remarks && (document.has_problems() || is_repaired || !context.state.panels.tree))
        return draw_problems(context, problems, dialogs);
    if (!remarks) return draw_tree(context, tree);
    if (!ImGui::BeginTabBar("##left")) return;
    const auto tab = [&](const char* label, const auto& draw) {
        const bool open = ImGui::BeginTabItem(label);
        context.widgets.record(label);
        if (!open) return;
        draw();
        ImGui::EndTabItem();
    };
    tab("Tree", [&] { draw_tree(context, tree); });
    tab("Problems", [&] { draw_problems(context, problems, dialogs); });
    ImGui::EndTabBar();
}

namespace {

// The height of the selection's text, about: lines may wrap. A list above keeps room for some entries.
float selection_height(const std::string& text) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), head = ImGui::GetFrameHeight();
    const float lines = 1 + std::count(text.begin(), text.end(), '\n');
    const float most = std::max(ImGui::GetContentRegionAvail().y - 12 * line, 5 * line);
    return std::min(std::min(lines + 3, 16.f) * line + head, most);
}

}  // namespace

void Ui::Impl::draw_left(UiContext& context, const Layout& layout) {
    begin_place("##left column", layout.left);
    draw_border(layout.left, ImGuiDir_Right);
    const bool selected = !context.facts.selection.empty();
    const float below = selected ? selection_height(context.facts.selection) : 0;
    ImGui::BeginChild("##upper", {0, -below});
    draw_problems_or_tree(context);
    ImGui::EndChild();
    if (selected) draw_selection(context);
    ImGui::End();
}

void Ui::Impl::draw_right(UiContext& context, const Layout& layout) {
    begin_place("##right column", layout.right);
    draw_border(layout.right, ImGuiDir_Left);
    ImGui::BeginChild("##sections");  // scrolls
    const Panels panels = context.state.panels;
    if (panels.display) {
        draw_display(context);
        draw_regions(context);
        draw_clip(context, dialogs.clip);
    }
    if (panels.display || panels.quality) draw_color(context, color, dialogs.list);
    draw_parameters(context, dialogs);
    ImGui::EndChild();
    ImGui::End();
}

namespace {

float label_pad() { return 0.2f * em(); }

// Draws the numbers of patches in discs on the faces.
void draw_numbers(const UiContext& context) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Palette& colors = palette(context.state.theme);
    for (const FaceNumber& face : context.facts.numbers) {
        const std::string text = std::to_string(face.number);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const ImVec2 from = {face.x - size.x / 2, face.y - size.y / 2};
        const float radius = 0.55f * size.y;
        list.AddRectFilled({from.x - radius / 2, from.y}, {from.x + size.x + radius / 2, from.y + size.y},
                           packed(faded(colors.panel, 0.85f)), radius);
        list.AddText(from, packed(colors.text), text.c_str());
    }
}

void draw_label(const UiContext& context, const ValueLabel& label) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Palette& colors = palette(context.state.theme);
    const Rectangle r = rectangle_of(label);
    list.AddRectFilled({r.x, r.y}, {r.x + r.width, r.y + r.height}, packed(faded(colors.panel, 0.8f)), label_pad());
    list.AddText({r.x + label_pad(), r.y}, packed(colors.text), label.text.c_str());
}

// Draws the menu of the patch that was clicked with the right button.
void draw_patch_menu(UiContext& context, int& answered) {
    constexpr const char* popup = "##patch menu";
    if (std::exchange(answered, context.facts.patch_clicks) != context.facts.patch_clicks) ImGui::OpenPopup(popup);
    if (!ImGui::BeginPopup(popup)) return;
    std::vector<std::string>& hidden = context.state.visibility.hidden_patches;
    const std::string& patch = context.facts.patch;
    show(patch.empty() ? "No patch with a name" : patch, palette(context.state.theme).dim);
    ImGui::BeginDisabled(patch.empty() || is_last_patch(context.state, context.session.document(), patch));
    if (context.widgets.menu_item("Hide this patch", "P")) set_member(hidden, patch, true);
    ImGui::EndDisabled();
    ImGui::BeginDisabled(hidden.empty());
    if (context.widgets.menu_item("Show all patches", "Shift+P")) hidden.clear();
    ImGui::EndDisabled();
    ImGui::EndPopup();
}

// Closes the menus that have popped up, but no dialog; false: there are none.
bool close_menu() {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    int dialogs = 0;
    while (dialogs < open.Size && (!open[dialogs].Window || (open[dialogs].Window->Flags & ImGuiWindowFlags_Modal)))
        ++dialogs;
    if (dialogs == open.Size) return false;
    ImGui::ClosePopupToLevel(dialogs, true);
    return true;
}

// Whether a field of text has a use for a key: letters, and Ctrl with those that select, copy and undo.
bool belongs_to_field(const std::string& key) {
    return !key.starts_with("Ctrl+") || std::string_view("ACVXYZ").find(key.back()) != std::string_view::npos;
}

}  // namespace

Rectangle rectangle_of(const ValueLabel& label) {
    const ImVec2 size = ImGui::CalcTextSize(label.text.c_str());
    const float gap = 0.8f * em(), width = size.x + 2 * label_pad();
    if (!label.is_beside) return {label.x - width / 2, label.y - size.y / 2, width, size.y};
    const bool fits = label.x + gap + width < ImGui::GetIO().DisplaySize.x;
    return {fits ? label.x + gap : label.x - gap - width, label.y - size.y - 0.5f * gap, width, size.y};
}

Ui::Ui() : impl_(std::make_unique<Impl>()) {}
Ui::~Ui() = default;

void Ui::apply(Theme theme, float scale) {
    if (scale != impl_->scale) load_fonts(*ImGui::GetIO().Fonts, std::round(15 * scale));
    impl_->theme = theme;
    impl_->scale = scale;
    set_style(theme, scale);
}

void Ui::draw(UiContext& context, const Rectangle& scene, float width, float height) {
    if (context.state.theme != impl_->theme) {
        impl_->theme = context.state.theme;
        set_style(impl_->theme, impl_->scale > 0 ? impl_->scale : 1);
    }
    const Layout layout = layout_of(context.state, context.session.document(), context.settings.panels, width, height);
    Dialogs& dialogs = impl_->dialogs;
    if (ImGui::IsMouseClicked(0) && ImGui::GetIO().WantCaptureMouse) dialogs.list.list = ListKeys::List::none;
    follow_tour(context, dialogs, scene);
    draw_menu(context, dialogs);
    draw_splitters(context, layout);  // before the panels: of windows that stay where they are the first is in front
    if (layout.has_left) impl_->draw_left(context, layout);
    if (layout.has_right) impl_->draw_right(context, layout);
    if (layout.has_timeline) {
        begin_place("##timeline", layout.timeline);
        draw_border(layout.timeline, ImGuiDir_Up);
        draw_timeline(context, impl_->timeline, dialogs);
        ImGui::End();
    }
    begin_place("##status", layout.status);
    draw_border(layout.status, ImGuiDir_Up);
    draw_status(context);
    ImGui::End();
    draw_overlays(context, scene);
    if (has_body(context.session.document())) draw_plane_handles(context, impl_->cut_handle, scene);
    draw_patch_menu(context, impl_->patch_clicks);
    draw_keys(context);
    draw_browser(context, dialogs.browser);
    draw_search(context, dialogs);
    draw_unsaved(context, dialogs.save);
    draw_save_dialog(context, dialogs.save);
    if (std::exchange(dialogs.list.steps, 0) != 0)
        dialogs.list.list = ListKeys::List::none;  // the list is not shown any more
}

void Ui::draw_overlays(UiContext& context, const Rectangle& scene) {
    if (!has_body(context.session.document())) return draw_welcome(context, impl_->dialogs, scene);
    draw_numbers(context);
    for (const ValueLabel& label : context.facts.labels) draw_label(context, label);
    if (context.facts.probe) draw_label(context, *context.facts.probe);
    draw_caption(context, scene);
    if (context.facts.beside) draw_caption_beside(context, *context.facts.beside);
    draw_legend(context, scene);
    draw_gizmo(context, scene);
    draw_scale_bar(context, scene);
}

void Ui::press(UiContext& context, const std::string& key, bool repeat) {
    if (key.ends_with("Escape") && close_menu()) return;
    Dialogs& dialogs = impl_->dialogs;
    const bool popup = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool is_typed = ImGui::GetIO().WantTextInput && belongs_to_field(key);
    if (is_typed || popup || dialogs.browser.open || dialogs.browser.requested) return;
    const Command* command = command_of_key(key);
    if (command && (command->repeats || !repeat) && is_enabled(*command, context)) command->run(context, dialogs);
}

bool Ui::leads_tour() const { return impl_->dialogs.tour.awaited || impl_->dialogs.tour.node != no_node; }

void go_to_node(UiContext& context, NodeId node) {
    const std::vector<Step> steps = steps_of(context.session.document(), node);
    context.state.node = node;
    context.state.step = steps[nearest_step(steps, context.state.step)];
}

void reveal(UiContext& context, NodeId node) {
    if (const std::string* region = region_of(context.session.document(), node)) reveal_region(context.state, *region);
    for (; node > no_node; node = parent_of(node)) context.state.visibility.set_hidden(node, false);
}

void scroll_to_row(float top, float height) {
    const float seen = ImGui::GetWindowHeight() - height;
    if (top < ImGui::GetScrollY() || top > ImGui::GetScrollY() + seen) ImGui::SetScrollY(top - seen / 2);
}

void draw_head(Widgets& widgets, const char* label, bool& open, Section& section) {
    ImGui::SetNextItemOpen(open);
    open = widgets.header(label, false);
    if (open && !section.open) section.frames_to_scroll = 2;
    section.open = open;
    if (section.frames_to_scroll <= 0) return;
    --section.frames_to_scroll;
    ImGui::SetScrollHereY(0);
}

bool input_on_leaving(Widgets& widgets, const char* label, float width, double value, double& typed) {
    ImGui::SetNextItemWidth(width);
    ImGui::InputScalar((std::string("##") + label).c_str(), ImGuiDataType_Double, &typed, nullptr, nullptr, "%.6g");
    widgets.record(label);
    const bool left = ImGui::IsItemDeactivatedAfterEdit() && std::isfinite(typed);
    if (!left && !ImGui::IsItemActive()) typed = value;
    return left;
}

const Color* part_color(const SceneFacts& facts, const ViewState& state, NodeId part) {
    return state.coloring.by == ColorBy::part ? color_in_legend(facts, "part " + std::to_string(part.value()))
                                              : nullptr;
}

const Color* color_in_legend(const SceneFacts& facts, const std::string& text) {
    for (const LegendEntry& entry : facts.legend.categories)
        if (entry.text == text) return &entry.color;
    return nullptr;
}

std::string key_of(const Document& document) {
    std::string key = document.path;
    for (const OptionText& option : option_texts(document.options, false)) key += "\n" + option.text;
    return key;
}

double diagonal_of(const Document& document) {
    Eigen::AlignedBox3d box = document.box;
    const Soup* soup = document.checked ? &document.checked->soup : document.soup.get();
    if (box.isEmpty() && soup)
        for (const Vec3& p : soup->vertices)
            if (p.allFinite()) box.extend(p);
    const double diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
    return diagonal > 0 && std::isfinite(diagonal) ? diagonal : 1;
}

void explain(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1);  // a disabled item is dim, its tip is not
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(24 * ImGui::GetFontSize());
    show(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void draw_backdrop(ImDrawList& list, Theme theme, const ImVec2& from, const ImVec2& to) {
    const float margin = 0.45f * em();
    list.AddRectFilled({from.x - margin, from.y - margin}, {to.x + margin, to.y + margin},
                       packed(palette(theme).backdrop), margin);
}

}  // namespace kerf::view

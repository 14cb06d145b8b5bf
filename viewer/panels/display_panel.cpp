// The sections of display and clip plane. Each switch writes one member of the view state, which the next frame's scene
// follows, so that nothing here draws the scene. Clip::position is a fraction of the body's extent along the normal
// (extent_along()), not a length: the slider shows the fraction, the field beside it the distance from the origin in
// units of the file. Typed numbers take effect when a field is left, as half a number would turn or move the plane.
// Items that would do nothing at the present step are disabled, and say why.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/panels/inside/parts.h"

namespace kerf::view {

namespace {

constexpr float title_share = 0.76f;  // share of a row that its title leaves

// Checkboxes in two columns.
void draw_switches(UiContext& context) {
    Look& look = context.state.look;
    bool axes = look.has_axes(context.state.step.stage);
    const bool had_axes = axes;
    struct Switch {
        const char* label;
        bool* value;
        const char* tip;
    };
    const Switch switches[] = {{"Surface", &look.surface, "Facets of the input"},
                               {"Interfaces", &look.interfaces, "Facets that cuts have made"},
                               {"Edges", &look.edges, "Edges of triangles (E)"},
                               {"Context", &look.context, "The rest of the body, translucent"},
                               {"Plane", &look.plane, "The cutting plane of the node"},
                               {"Contour", &look.contour, "The contour of the cut"},
                               {"Axes", &axes, "Principal axes and centre of gravity of the node"},
                               {"Features", &look.features, "Sharp edges and borders of patches"},
                               {"Legend", &look.legend, "What the colours mean"},
                               {"Scale bar", &look.scale_bar, "A length, as it is seen at the middle of the body"}};
    const float half = ImGui::GetContentRegionAvail().x / 2;
    int i = 0;
    for (const Switch& one : switches) {
        if (i++ % 2) ImGui::SameLine(half);
        context.widgets.checkbox(one.label, one.value, one.tip);
    }
    if (axes != had_axes) look.axes = axes;
}

// Draws the slider that pulls pieces apart; it is disabled where there is one piece, and says why.
void draw_explode(UiContext& context) {
    const Document& document = context.session.document();
    const Step& step = context.state.step;
    const bool has_pieces = document.tree.rows.size() > 1 && step.refused_try < 0 &&
                            (step.stage == Stage::split || shows_parts(step.stage));
    ImGui::BeginDisabled(!has_pieces);
    context.widgets.slider("Explode", &context.state.explosion.amount, 0, 1);
    ImGui::EndDisabled();
    explain(has_pieces                       ? "Pulls the pieces apart across the planes of the cuts"
            : document.tree.rows.size() <= 1 ? "There is one piece: cut the surface first"
                                             : "There is one piece here: only the halves (Split) and the parts "
                                               "(Tetrahedra) can be pulled apart");
}

template <class Enum, std::size_t N>
void draw_choice(Widgets& widgets, const char* title, const char* const (&labels)[N], Enum& value) {
    const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
    const auto width_of_radio = [](const char* label) {
        return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + width_of(label);
    };
    float widths = 0;
    for (const char* label : labels) widths += width_of_radio(label);
    const float gap = std::min(em(), (title_share * room - widths) / (N - 1));
    float x = left + (1 - title_share) * room;
    ImGui::AlignTextToFramePadding();
    show(title);
    for (std::size_t i = 0; i < N; ++i) {
        ImGui::SameLine(x, 0);
        if (widgets.radio(labels[i], static_cast<std::size_t>(value) == i)) value = static_cast<Enum>(i);
        x += width_of_radio(labels[i]) + gap;
    }
}

void draw_axis_buttons(UiContext& context, ClipMemory& memory) {
    Clip& clip = context.state.clip;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string label = std::string("Clip ") + "XYZ"[axis];
        const Vec3 unit = Vec3::Unit(axis);
        const bool chosen = clip.on && clip.normal.isApprox(unit);
        if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetColorU32(ImGuiCol_ButtonActive));
        if (ImGui::Button((std::string("  ") + "XYZ"[axis] + "  ##" + label).c_str())) {
            clip.normal = unit;
            clip.on = true;
        }
        context.widgets.record(label);
        if (chosen) ImGui::PopStyleColor();
        ImGui::SameLine();
    }
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.6f * em());
    if (context.widgets.checkbox("Flip", &clip.flipped, "Show the other side"))
        memory.flipped_in = context.session.document().path;
}

void draw_snap_button(UiContext& context) {
    const TreeRow* row = context.session.document().tree.find(context.state.node);
    const bool has_plane = row && row->plane() && !context.session.document().box.isEmpty();
    ImGui::BeginDisabled(!has_plane);
    const std::string label = fmt::format("Snap to cut of node {}", context.state.node.value());
    if (context.widgets.button(label.c_str(), has_plane ? "Clips at the plane of this cut" : "This node has no cut"))
        snap_to(context.state.clip, *row->plane(), context.session.document().box);
    ImGui::EndDisabled();
}

// Draws the fields of the normal. A typed normal takes effect when the field is left, so that half a number does not
// turn the plane.
void draw_normal(UiContext& context, ClipMemory& memory) {
    Clip& clip = context.state.clip;
    const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    show("Normal");
    ImGui::SameLine(left + (1 - title_share) * room, 0);
    ImGui::SetNextItemWidth(title_share * room);
    ImGui::InputScalarN("##normal", ImGuiDataType_Double, memory.normal.data(), 3, nullptr, nullptr, "%.4g");
    context.widgets.record("Normal");
    const Vec3 typed(memory.normal[0], memory.normal[1], memory.normal[2]);
    if (ImGui::IsItemDeactivatedAfterEdit() && typed.allFinite() && typed.norm() > 0) clip.normal = typed.normalized();
    if (!ImGui::IsItemActive()) memory.normal = {clip.normal.x(), clip.normal.y(), clip.normal.z()};
}

// Draws the field of the position in units of the file: the distance of the plane from the origin along its normal.
void draw_distance(UiContext& context, ClipMemory& memory) {
    Clip& clip = context.state.clip;
    const Eigen::AlignedBox3d& box = context.session.document().box;
    if (box.isEmpty()) return;
    const ValueRange range = extent_along(box, clip.normal);
    const double length = range.high - range.low;
    const float left = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    show("At, in units of the file");
    ImGui::SameLine(left + value_place * room + 6 * em(), 0);
    const bool changed = input_on_leaving(context.widgets, "Clip at", ImGui::GetContentRegionAvail().x,
                                          position_of(clip, box), memory.at);
    explain("The distance of the plane from the origin along its normal");
    if (changed && length > 0) clip.position = std::clamp((memory.at - range.low) / length, 0., 1.);
}

void draw_selection_buttons(UiContext& context) {
    ImGui::BeginDisabled(context.state.selection.kind == Selection::Kind::none);
    if (context.widgets.button("Through selection", "Clips through what is selected, with this normal (Shift+C)"))
        context.actions.camera.clip_through_selection(false);
    ImGui::SameLine();
    if (context.widgets.button("Facing me", "Clips through what is selected, across the line of sight"))
        context.actions.camera.clip_through_selection(true);
    ImGui::EndDisabled();
}

}  // namespace

void draw_display(UiContext& context) {
    if (!context.widgets.header("Display", true)) return;
    ViewState& state = context.state;
    draw_switches(context);
    ImGui::Spacing();
    draw_choice(context.widgets, "Shading", {"Flat", "Smooth"}, state.look.shading);
    draw_choice(context.widgets, "Pick", {"Facet", "Cell", "Vertex"}, state.pick);
    draw_explode(context);
    context.widgets.slider("Shrink cells", &state.explosion.shrink, 0, 0.9);
    std::vector<std::string>& hidden = state.visibility.hidden_patches;
    if (!hidden.empty() && context.widgets.small_button("Show hidden patches", "All are drawn again (Shift+P)"))
        hidden.clear();
    ImGui::Spacing();
}

void draw_clip(UiContext& context, ClipMemory& memory) {
    if (!context.widgets.header("Clip", true)) return;
    Clip& clip = context.state.clip;
    const Clip before = clip;
    context.widgets.checkbox("Clip plane", &clip.on, "Shows one side of a plane (C)");
    draw_axis_buttons(context, memory);
    ImGui::BeginDisabled(!clip.on);
    context.widgets.slider("Position", &clip.position, 0, 1, "%.3f");
    draw_distance(context, memory);
    draw_normal(context, memory);
    draw_choice(context.widgets, "Cells", {"Whole", "Cut", "Layer"}, clip.style);
    ImGui::EndDisabled();
    draw_snap_button(context);
    draw_selection_buttons(context);
    if (clip.on && (!before.on || clip.normal != before.normal)) show_cut_face(context, memory);
    ImGui::Spacing();
}

void show_cut_face(UiContext& context, const ClipMemory& memory) {
    if (memory.flipped_in != context.session.document().path) face(context.state.clip, context.camera.back());
}

}  // namespace kerf::view

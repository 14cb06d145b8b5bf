// One frame of the viewer. A frame takes data that have arrived, lays the panels out and builds the scene; painting is
// a step of its own, because it is most of a frame's time where the CPU draws. The scene is built twice in a frame:
// before the panels, which show facts about it, and after them, so that a change by a panel is in the same picture; the
// second is free if nothing has changed. A scene is built anew only when data or the state have changed (built_for_,
// without camera and panels, on which it does not depend). Frames are drawn on demand: wake() asks for three of them,
// and App::settled() tells when the picture will not change any more, which is how a screenshot knows that it is
// complete.
#include "viewer/app/app.h"

#include <utility>

#include <imgui.h>

#include "viewer/app/keys.h"
#include "viewer/app/settings.h"
#include "viewer/model/timeline.h"
#include "viewer/panels/imgui_input.h"

namespace kerf::view {

namespace {

constexpr float nearby_pixels = 6;  // how far the hand may tremble at a double click

}  // namespace

ImGuiOwner::ImGuiOwner() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    const std::pair<ImGuiKey, int> keys[] = {{ImGuiKey_Tab, key_tab},
                                             {ImGuiKey_LeftArrow, key_left},
                                             {ImGuiKey_RightArrow, key_right},
                                             {ImGuiKey_UpArrow, key_up},
                                             {ImGuiKey_DownArrow, key_down},
                                             {ImGuiKey_PageUp, key_page_up},
                                             {ImGuiKey_PageDown, key_page_down},
                                             {ImGuiKey_Home, key_home},
                                             {ImGuiKey_End, key_end},
                                             {ImGuiKey_Delete, key_delete},
                                             {ImGuiKey_Backspace, key_backspace},
                                             {ImGuiKey_Space, key_space},
                                             {ImGuiKey_Enter, key_enter},
                                             {ImGuiKey_Escape, key_escape},
                                             {imgui_keypad_enter, key_keypad_enter},
                                             {ImGuiKey_A, key_of('A')},
                                             {ImGuiKey_C, key_of('C')},
                                             {ImGuiKey_V, key_of('V')},
                                             {ImGuiKey_X, key_of('X')},
                                             {ImGuiKey_Y, key_of('Y')},
                                             {ImGuiKey_Z, key_of('Z')}};
    for (const auto& [key, number] : keys) number_imgui_key(key, number);
}

ImGuiOwner::~ImGuiOwner() { ImGui::DestroyContext(); }

App::App(const Gl& gl, AppOptions options) : view_(gl, std::move(options)) {}

App::~App() {
    keep_sizes(view_.settings, view_.session.document());
    save_settings(view_.options.config_folder, view_.settings);
}

void App::follow_session() {
    Session& session = view_.session;
    if (session.poll()) {
        view_.session_changed = true;
        view_.wake();
    }
    opening_.follow(ui_.leads_tour());
    desk_.follow();
    beside_.follow();
    if (view_.session_changed) input_.resolve_click();
    navigation_.resolve_turn();
    navigation_.resolve_clip();
    const Document& document = session.document();
    // A node that is asked for before the tree is known is waited for.
    const bool is_final = !session.busy() && !session.pending() && !document.progress.running;
    if (is_final && !document.tree.rows.empty() && !document.tree.find(view_.state.node)) view_.state.node = root_node;
    view_.steps = steps_of(document, view_.shown().node);
    view_.facts.pending = session.pending();
    view_.facts.up = view_.up();
}

void App::build_scene() {
    const ViewState shown = view_.shown();
    BuiltScene& built = view_.built;
    ViewState wanted = of_scene(shown);
    if (!view_.session_changed && wanted == built_for_ && !built.pending) return;
    view_.session_changed = false;
    built_for_ = std::move(wanted);
    built = builder_.build(shown, view_.session);
    ++view_.scenes_built;
    SceneFacts& facts = view_.facts;
    facts.legend = built.legend;
    facts.selection = describe_selection(view_.session, view_.state.selection, view_.state.deformation.load_case);
    facts.pending = view_.session.pending();
    facts.triangles = facts.lines = 0;
    for (const Layer& layer : built.scene.layers) {
        facts.triangles += layer.geometry->triangle_count();
        facts.lines += layer.geometry->segments.size();
    }
}

void App::lay_out(bool panels) {
    ImGuiIO& io = ImGui::GetIO();
    const float scale = view_.size.scale;
    io.DisplaySize = ImVec2(view_.size.width, view_.size.height);
    io.DisplayFramebufferScale = {1, 1};
    if (const std::pair style(view_.state.theme, scale); style != styled_for_) {
        ui_.apply(view_.state.theme, scale);
        io.MouseDragThreshold = io.MouseDoubleClickMaxDist = nearby_pixels * scale;
        styled_for_ = style;
    }
    ImGui::NewFrame();
    widgets_.begin_frame();
    beside_.share(scene_rectangle(view_.state, view_.session.document(), view_.settings.panels, io.DisplaySize.x,
                                  io.DisplaySize.y, panels));
    view_.body = body_area(view_.state, view_.area);
    UiContext context{view_.state, view_.session, view_.settings, view_.facts,        view_.steps,
                      actions_,    widgets_,      view_.camera,   gallery_.examples()};
    if (panels) input_.take(context);
    playing_.go_on();
    build_scene();
    beside_.build();
    navigation_.project_scene();
    labels_.place(input_.is_dragging());
    labels_.probe(panels && !input_.is_pressed());
    if (panels)
        ui_.draw(context, view_.area, io.DisplaySize.x, io.DisplaySize.y);
    else
        ui_.draw_overlays(context, view_.area);
    ImGui::Render();
    // Changes by the panels are part of this picture.
    view_.steps = steps_of(view_.session.document(), view_.shown().node);
    build_scene();
    beside_.build();
    navigation_.project_scene();
}

void App::frame(const FrameSize& size, bool panels) {
    view_.size = size;
    // A window of one pixel is iconified.
    if (panels && size.width > 1) view_.settings.window = {size.width, size.height, size.scale};
    scale_mouse(size.pixels_per_unit_x, size.pixels_per_unit_y);
    if (view_.frames_wanted > 0) --view_.frames_wanted;
    follow_session();
    desk_.clear_notice();
    if (desk_.wants_picture()) {
        lay_out(false);
        // The picture does not wait for data that a run has not made yet, as it may take long.
        if ((!view_.built.pending || !view_.session.pending()) && !beside_.is_pending()) desk_.write_picture(picture());
        wake();
    }
    lay_out(panels);
    if (panels) navigation_.remember();
    painting_.follow(panels);
    // Data that were asked for are mostly there at once: better than a picture without them.
    if (view_.built.pending) wait(0.04);
    if (beside_.is_pending()) beside_.wait(0.04);
}

bool App::wait(double seconds) {
    if (!view_.session.wait(seconds)) return false;
    view_.session_changed = true;
    wake();
    return true;
}

bool App::wants_frame() {
    follow_session();
    // Progress in words, a few times a second.
    const auto now = std::chrono::steady_clock::now();
    const bool tells =
        view_.session.document().progress.running || (!view_.facts.notice.empty() && !view_.facts.notice_is_error);
    if (settled() && !(tells && now - last_frame_ > std::chrono::milliseconds(300))) return false;
    last_frame_ = now;
    return true;
}

bool App::settled() const {
    return view_.frames_wanted == 0 && !view_.built.pending && !view_.session_changed && !view_.facts.playing &&
           !view_.facts.moving && !painting_.is_coarse() && !desk_.wants_picture() && !beside_.is_pending();
}

}  // namespace kerf::view

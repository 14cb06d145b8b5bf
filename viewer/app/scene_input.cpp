// Mouse and keys of the scene. A press belongs to the scene or to a panel by the place where it began
// (pressed_in_scene_), whatever the mouse crosses until it is let go. It is a drag once it has moved further than
// click_pixels, and else a click when it is let go. A drag turns or moves the camera; a click selects the primitive
// under the cursor, whose cell may have to be read first: the click then waits (View::unresolved) and is tried again
// when data have arrived. Keys become words, "Ctrl+Shift+Z", as the table of commands has them.
#include "viewer/app/scene_input.h"

#include <string>
#include <utility>

#include <imgui.h>

#include "viewer/app/keys.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr float click_pixels = 4;  // at scale 1; a press that moves further is a drag

bool is_of_cells(LayerKind kind) { return kind == LayerKind::cells || kind == LayerKind::section; }
bool is_of_facets(LayerKind kind) {
    return kind == LayerKind::surface || kind == LayerKind::file_surface || kind == LayerKind::half ||
           kind == LayerKind::part;
}

// The name of a key as menus have it: "Ctrl+Shift+Z".
std::string words_of(const KeyEvent& event) {
    constexpr std::pair<int, const char*> named[] = {
        {key_space, "Space"}, {key_escape, "Escape"}, {key_right, "Right"}, {key_left, "Left"},
        {key_down, "Down"},   {key_up, "Up"},         {key_home, "Home"},   {key_f12, "F12"},
    };
    std::string text = std::string(event.control ? "Ctrl+" : "") + (event.shift ? "Shift+" : "");
    for (const auto& [key, name] : named)
        if (event.key == key) return text + name;
    const bool is_keypad = event.key >= key_keypad_0 && event.key <= key_keypad_0 + 9;
    const int character = is_keypad ? event.key - key_keypad_0 + key_0 : event.key;
    return character > key_space && character < 127 ? text + static_cast<char>(character) : "";
}

}  // namespace

void SceneInput::take(UiContext& context) {
    const ImGuiIO& io = ImGui::GetIO();
    if (!io.WantCaptureMouse && view_.area.contains(io.MousePos.x, io.MousePos.y))
        navigation_.note_mouse(io.MousePos.x, io.MousePos.y);
    for (const KeyEvent& event : std::exchange(key_events_, {})) ui_.press(context, words_of(event), event.repeat);
    take_mouse(context);
}

void SceneInput::take_mouse(UiContext& context) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool in_shown = view_.area.contains(io.MousePos.x, io.MousePos.y);
    const bool in_other = view_.beside && view_.beside->area.contains(io.MousePos.x, io.MousePos.y);
    const bool in_scene = !io.WantCaptureMouse && (in_shown || in_other);
    for (int button = 0; button < 3; ++button)
        if (ImGui::IsMouseClicked(button)) pressed_in_scene_ = in_scene;
    if (pressed_in_scene_) {
        take_drag();
        const bool is_double = ImGui::IsMouseDoubleClicked(0);
        if (in_shown && (is_double || (ImGui::IsMouseReleased(0) && !dragging_))) take_click(is_double);
        if (in_other && ImGui::IsMouseReleased(0) && !dragging_) take_other_run(context);
        if (in_shown && ImGui::IsMouseReleased(1) && !dragging_) take_right_click();
        if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2))
            dragging_ = pressed_in_scene_ = false;
    }
    // One camera for both: a place of the other scene is that of the shown one.
    const float to_shown = in_other ? view_.area.x - view_.beside->area.x : 0;
    if (in_scene && io.MouseWheel != 0) navigation_.zoom(io.MousePos.x + to_shown, io.MousePos.y, io.MouseWheel);
}

void SceneInput::take_drag() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool pans = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && io.KeyShift);
    if (!pans && !ImGui::IsMouseDown(0)) return;
    const float least_drag = click_pixels * view_.size.scale;
    for (int button = 0; button < 3; ++button)  // buttons that are up still have the distance of their last drag
        dragging_ |= ImGui::IsMouseDown(button) && io.MouseDragMaxDistanceSqr[button] > least_drag * least_drag;
    if (!dragging_ || (io.MouseDelta.x == 0 && io.MouseDelta.y == 0)) return;
    Camera camera = view_.camera;
    const double height = view_.height();
    const double dx = io.MouseDelta.x / height, dy = io.MouseDelta.y / height;
    if (pans)
        pan(camera, dx, dy);
    else
        orbit(camera, dx, dy, view_.up());
    view_.state.camera = camera;
}

// Selects the primitive under the cursor, or makes the camera turn about it from now on.
void SceneInput::take_click(bool centers) {
    const ImVec2& mouse = ImGui::GetIO().MousePos;
    const auto found = view_.pick(mouse.x, mouse.y);
    view_.unresolved.reset();
    if (centers) return found ? navigation_.center(*found) : void();
    view_.state.selection = {};
    if (!found) return;
    const Vec3 point = view_.built.frame.to_file(found->rest.cast<double>());  // place in the file, before deformation
    const LayerKind kind = view_.built.scene.layers[found->layer].kind;
    if (is_of_cells(kind) || is_of_facets(kind)) {
        view_.unresolved = Hit{is_of_cells(kind), found->owner, found->element, point};
        resolve_click();
    } else {
        view_.state.selection.kind = Selection::Kind::place;
        view_.state.selection.owner = found->owner;
        view_.state.selection.place = point;
    }
}

// Makes the other one of two runs the shown one, of which the panels speak.
void SceneInput::take_other_run(UiContext& context) {
    const bool shows_before = view_.session.shows_before();
    context.actions.runs.swap_runs();
    if (view_.session.shows_before() != shows_before)
        view_.notify(shows_before ? "The panels are about B now." : "The panels are about A now.");
}

// The panels answer with a menu of what can be done with the patch.
void SceneInput::take_right_click() {
    const ImVec2& mouse = ImGui::GetIO().MousePos;
    const std::string* patch = navigation_.patch_at(mouse.x, mouse.y);
    view_.facts.patch = patch ? *patch : "";
    ++view_.facts.patch_clicks;
    view_.wake();
}

// Makes the waiting click a selection. The cells behind a facet may have to be read first: then it is tried again when
// something has arrived.
void SceneInput::resolve_click() {
    if (!view_.unresolved) return;
    const auto selection = select(view_.session, *view_.unresolved, view_.state.pick);
    if (selection) view_.state.selection = *selection;
    if (selection || !view_.session.pending()) view_.unresolved.reset();
}

}  // namespace kerf::view

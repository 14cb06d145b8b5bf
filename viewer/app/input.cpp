// Keys and mouse of the scene; panels take theirs first.
#include <algorithm>
#include <cmath>
#include <utility>

#include <imgui.h>

#include "viewer/app/app.h"
#include "viewer/app/keys.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr float click_pixels = 4;  // at scale 1; a press that moves further is a drag
constexpr double zoom_per_notch = 0.88;

bool contains(const Rectangle& r, const ImVec2& p) {
    return p.x >= r.x && p.y >= r.y && p.x < r.x + r.width && p.y < r.y + r.height;
}

bool is_of_cells(LayerKind kind) { return kind == LayerKind::cells || kind == LayerKind::section; }
bool is_of_facets(LayerKind kind) {
    return kind == LayerKind::surface || kind == LayerKind::file_surface || kind == LayerKind::half ||
           kind == LayerKind::part;
}

}  // namespace

bool App::take_digit(int key) {
    Camera camera = camera_;
    switch (key >= key_keypad_0 ? key - key_keypad_0 : key - key_0) {
        case 1:
            look_from(camera, Direction::front);
            break;
        case 3:
            look_from(camera, Direction::right);
            break;
        case 7:
            look_from(camera, Direction::top);
            break;
        case 9:
            camera.turn = (Eigen::AngleAxisd(M_PI, Vec3::UnitZ()) * camera.turn).normalized();
            break;
        case 5:
            camera.perspective = !camera.perspective;
            break;
        default:
            return false;
    }
    state_.camera = camera_ = camera;  // the next key of this frame goes on from here
    return true;
}

void App::take_character_key(const KeyEvent& event) {
    if (take_digit(event.key)) return;
    if (event.key == key_of('H')) state_.panels.keys = !state_.panels.keys;
    if (event.key == key_of('F')) frame_selection();
    if (event.key == key_of('C')) event.shift ? clip_through_selection(false) : void(state_.clip.on = !state_.clip.on);
    if (event.key == key_of('E')) state_.edges = !state_.edges;
    if (event.key == key_of('B')) show_other();
    if (event.key == key_of('N')) state_.neighbours = !state_.neighbours;
    if (event.key == key_space) toggle_play();
}

void App::take_key(const KeyEvent& event) {
    if (event.key == key_escape && ui_.close_menu()) return;
    if (ImGui::GetIO().WantTextInput || ui_.wants_keyboard()) return;
    if (event.control) {
        if (event.repeat) return;
        if (event.key == key_of('O')) ui_.open_browser();
        if (event.key == key_of('R')) reload();
        if (event.key == key_of('Q')) quit();
        if (event.key == key_of('Z')) event.shift ? redo_repair() : undo_repair();
        if (event.key == key_of('Y')) redo_repair();
        return;
    }
    if (event.key == key_left) move_step(-1);
    if (event.key == key_right) move_step(1);
    if (event.key == key_up && !ui_.step_in_list(-1)) move_node(-1);
    if (event.key == key_down && !ui_.step_in_list(1)) move_node(1);
    if (event.repeat) return;
    if (event.key == key_home) fit_all();
    if (event.key == key_f12) take_screenshot();
    if (event.key == key_escape) {
        ui_.leave_list();
        if (state_.panels.keys)
            state_.panels.keys = false;
        else
            state_.selection = {};
    }
    take_character_key(event);
}

void App::take_keys() {
    for (const KeyEvent& event : std::exchange(key_events_, {})) take_key(event);
}

void App::take_mouse() {
    const ImGuiIO& io = ImGui::GetIO();
    const bool in_scene = !io.WantCaptureMouse && contains(area_, io.MousePos);
    for (int button = 0; button < 3; ++button)
        if (ImGui::IsMouseClicked(button)) pressed_in_scene_ = in_scene;
    const double height = std::max(area_.height, 1.f);
    if (pressed_in_scene_) {
        const bool pans = ImGui::IsMouseDown(1) || ImGui::IsMouseDown(2) || (ImGui::IsMouseDown(0) && io.KeyShift);
        const bool orbits = ImGui::IsMouseDown(0) && !pans;
        const float least_drag = click_pixels * size_.scale;
        if (!dragging_ && (pans || orbits))
            for (int button = 0; button < 3; ++button)  // those that are up still have their last drag's
                dragging_ |= ImGui::IsMouseDown(button) && io.MouseDragMaxDistanceSqr[button] > least_drag * least_drag;
        if (dragging_ && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0) && (pans || orbits)) {
            Camera camera = camera_;
            (pans ? pan : orbit)(camera, io.MouseDelta.x / height, io.MouseDelta.y / height);
            state_.camera = camera;
        }
        const bool is_double = ImGui::IsMouseDoubleClicked(0);
        if (is_double || (ImGui::IsMouseReleased(0) && !dragging_)) take_click(io.MousePos.x, io.MousePos.y, is_double);
        if (!ImGui::IsMouseDown(0) && !ImGui::IsMouseDown(1) && !ImGui::IsMouseDown(2)) {
            dragging_ = false;
            pressed_in_scene_ = false;
        }
    }
    if (in_scene && io.MouseWheel != 0) zoom(io.MousePos.x, io.MousePos.y, io.MouseWheel);
}

// Towards what is seen under the cursor, and not through it.
void App::zoom(float x, float y, float notches) {
    Camera camera = camera_;
    const double diagonal = session_.document().box.diagonal().norm();
    if (const auto found = renderer_.pick(built_.scene, projection_, static_cast<int>(x), static_cast<int>(y)))
        focus_depth(camera, seen_point(*found));
    const double height = std::max(area_.height, 1.f);
    zoom_at(camera, std::pow(zoom_per_notch, notches), (x - body_.x - body_.width / 2) / height,
            -(y - body_.y - body_.height / 2) / height);
    camera.height = std::clamp(camera.height, 1e-6 * diagonal, 1e2 * diagonal);
    state_.camera = camera;
}

// Where it is on the picture, parts pulled apart.
Vec3 App::seen_point(const PickHit& hit) const {
    const std::array<float, 3>& offset = built_.scene.layers[hit.layer].ranges[hit.range].offset;
    const Eigen::Vector3f moved = hit.point + Eigen::Vector3f(offset[0], offset[1], offset[2]);
    return built_.frame.to_file(moved.cast<double>());
}

// Selects what is under the cursor, or turns about it from now on.
void App::take_click(float x, float y, bool center) {
    const auto found = renderer_.pick(built_.scene, projection_, static_cast<int>(x), static_cast<int>(y));
    unresolved_.reset();
    if (center) {
        if (!found) return;
        Camera camera = camera_;
        camera.target = seen_point(*found);
        state_.camera = camera;
        return;
    }
    state_.selection = {};
    if (!found) return;
    const Vec3 point = built_.frame.to_file(found->rest.cast<double>());  // where vertices have their places
    const LayerKind kind = built_.scene.layers[found->layer].kind;
    if (is_of_cells(kind) || is_of_facets(kind)) {
        unresolved_ = Hit{is_of_cells(kind), found->owner, found->element, point};
        resolve_click();
    } else {
        state_.selection.kind = Selection::Kind::place;
        state_.selection.owner = found->owner;
        state_.selection.place = point;
    }
}

// The cells behind a facet may have to be read first: then it is tried again when something has arrived.
void App::resolve_click() {
    if (!unresolved_) return;
    const auto selection = select(session_, *unresolved_, state_.pick);
    if (selection) state_.selection = *selection;
    if (selection || !session_.pending()) unresolved_.reset();
}

}  // namespace kerf::view

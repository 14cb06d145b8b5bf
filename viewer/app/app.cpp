#include "viewer/app/app.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.h"
#include "io/text_file.h"
#include "viewer/app/keys.h"
#include "viewer/app/settings.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/timeline.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr double usual_explosion = 0.4;  // of parts that are nothing but surfaces

constexpr double seconds_per_step = 0.8, seconds_of_notice = 6;
constexpr float nearby_pixels = 6;  // how far the hand may tremble at a double click

// What the scene depends on.
std::string scene_key(ViewState state) {
    state.camera.reset();
    state.panels = {};
    return to_json(state);
}

Eigen::AlignedBox3d framed_box(const std::vector<Vec3>& points, double least) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 more = Vec3::Constant(least) + box.sizes();
    return {box.min() - more, box.max() + more};
}

std::string unused_picture(const std::string& folder) {
    for (int i = 1;; ++i) {
        const std::string path = fmt::format("{}/kerf-{:03}.png", folder, i);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

ImGuiOwner::ImGuiOwner() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.LogFilename = nullptr;
    io.ConfigInputTextCursorBlink = false;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    io.KeyMap[ImGuiKey_Tab] = key_tab;
    io.KeyMap[ImGuiKey_LeftArrow] = key_left;
    io.KeyMap[ImGuiKey_RightArrow] = key_right;
    io.KeyMap[ImGuiKey_UpArrow] = key_up;
    io.KeyMap[ImGuiKey_DownArrow] = key_down;
    io.KeyMap[ImGuiKey_PageUp] = key_page_up;
    io.KeyMap[ImGuiKey_PageDown] = key_page_down;
    io.KeyMap[ImGuiKey_Home] = key_home;
    io.KeyMap[ImGuiKey_End] = key_end;
    io.KeyMap[ImGuiKey_Delete] = key_delete;
    io.KeyMap[ImGuiKey_Backspace] = key_backspace;
    io.KeyMap[ImGuiKey_Space] = key_space;
    io.KeyMap[ImGuiKey_Enter] = key_enter;
    io.KeyMap[ImGuiKey_Escape] = key_escape;
    io.KeyMap[ImGuiKey_KeyPadEnter] = key_keypad_enter;
    for (const auto& [name, letter] :
         {std::pair(ImGuiKey_A, 'A'), std::pair(ImGuiKey_C, 'C'), std::pair(ImGuiKey_V, 'V'),
          std::pair(ImGuiKey_X, 'X'), std::pair(ImGuiKey_Y, 'Y'), std::pair(ImGuiKey_Z, 'Z')})
        io.KeyMap[name] = key_of(letter);
}

ImGuiOwner::~ImGuiOwner() { ImGui::DestroyContext(); }

App::App(const Gl& gl, AppOptions options)
    : options_(std::move(options)),
      settings_(load_settings(options_.config_folder)),
      session_(options_.kerf_program),
      renderer_(gl, options_.shader_folder) {
    state_.theme = settings_.theme;
}

App::~App() { save_settings(options_.config_folder, settings_); }

std::string App::window_title() const {
    const Document& document = session_.document();
    return document.title.empty() ? "Kerf" : document.title + " - Kerf";
}

void App::open(const std::string& path) {
    session_.open(path, options_.run);
    remember(settings_, path);
    save_settings(options_.config_folder, settings_);
    const ViewState before = state_;
    state_ = {};
    state_.theme = before.theme;
    state_.panels = before.panels;
    state_.shading = before.shading;
    chosen_ = {};
    is_view_complete_ = false;
    await_document();
}

void App::show(const ViewState& state, const ChosenView& chosen) {
    state_ = state;
    chosen_ = chosen;
    is_view_complete_ = false;
    choose_view();
}

void App::await_document() {
    opened_.clear();
    session_changed_ = true;
    wake();
}

void App::reload() {
    session_.reload();
    await_document();
}

void App::open_again(const RunOptions& options) {
    session_.open(std::string(session_.document().path), options);
    await_document();
}

void App::frame_selection() {
    const double diagonal = session_.document().box.diagonal().norm();
    const std::vector<Vec3> points = selected_points(session_, state_.selection);
    if (!points.empty()) {
        camera_.target = framed_box(points, 0.01 * diagonal).center();
        Camera framed = camera_;
        fit_body(framed, framed_box(points, 0.01 * diagonal));
        state_.camera = framed;
    } else if (const auto surface = surface_of(session_, state_.node)) {
        Camera framed = camera_;
        fit_body(framed, framed_box(surface->vertices, 0));
        framed.height /= 2;
        state_.camera = framed;
    }
}

void App::fly_to(const Vec3& point, double radius, const Vec3& back) {
    Camera camera = camera_;
    if (back.squaredNorm() > 0 && !back.isApprox(camera.back())) look_from(camera, back);
    camera.target = point;
    camera.height = std::max(6 * radius, 1e-4 * session_.document().box.diagonal().norm());
    state_.camera = camera_ = camera;
    if (state_.selection.kind != Selection::Kind::cell) {
        state_.selection = {};
        state_.selection.kind = Selection::Kind::place;
        state_.selection.owner = state_.node;
        state_.selection.place = point;
    }
}

void App::resolve_turn() {
    if (!turning_to_) return;
    const Selection& s = *turning_to_;
    const auto cells = session_.cells(s.owner);
    const auto part = session_.part_surface(s.owner), shown = surface_of(session_, state_.node);
    const bool is_known = cells && part && shown;
    if (!is_known && session_.pending()) return;
    if (is_known && state_.selection == s && state_.camera)
        if (const auto back = direction_to_cell(*cells, *part, *shown, s.index, camera_.back())) {
            if (!back->isApprox(state_.camera->back())) look_from(*state_.camera, *back);
            wake();
        }
    turning_to_.reset();
}

void App::clip_through_selection(bool faces_eye) {
    const std::vector<Vec3> points = selected_points(session_, state_.selection);
    if (points.empty() || session_.document().box.isEmpty()) return notify("Select something to clip through first.");
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : points) middle += p / static_cast<double>(points.size());
    // What lies towards the eye is cut away.
    const Vec3 normal = faces_eye ? camera_.back() : state_.clip.normal;
    if (faces_eye) state_.clip.flipped = false;
    snap_to(state_.clip, Plane(middle, normal), session_.document().box);
}

void App::look(Direction direction) {
    Camera camera = camera_;
    look_from(camera, direction);
    state_.camera = camera;
}

void App::quit() { quit_ = true; }

void App::toggle_play() {
    facts_.playing = !facts_.playing;
    played_until_ = ImGui::GetTime() + seconds_per_step;
}

void App::copy(const std::string& text) {
    ImGui::SetClipboardText(text.c_str());
    notify("copied");
}

std::string App::clipboard() {
    const char* text = ImGui::GetClipboardText();
    return text ? text : "";
}

void App::start_run(const RunOptions& options, bool volume) {
    opened_ = session_.document().path;  // what a user runs is not run once more when its repairs have made it clean
    session_.start_run(options, volume);
}
void App::redo_cut(NodeId node, const RunOptions& options, const std::optional<Plane>& plane) {
    session_.redo_cut(node, options, plane);
}

// Under the same camera, so that what is alike stays where it is. Numbers of cells mean others there.
void App::swap_runs() {
    if (!session_.can_swap_runs()) return;
    session_.swap_runs();
    state_.camera = camera_;
    if (state_.selection.kind != Selection::Kind::place) state_.selection = {};
    unresolved_.reset();
    session_changed_ = true;
    wake();
}

void App::notify(const std::string& text) {
    facts_.notice = text;
    facts_.notice_is_error = false;
    notice_until_ = ImGui::GetTime() + seconds_of_notice;
}

void App::complain(const std::string& text) {
    facts_.notice = text;
    facts_.notice_is_error = true;
}

// A surface that can be cut is cut once, after it was opened.
void App::begin_auto_run() {
    const Document& document = session_.document();
    if (!options_.auto_run || document.kind != Document::Kind::surface || opened_ == document.path) return;
    if (!document.checked || document.has_problems()) return;
    opened_ = document.path;
    session_.start_run(document.options, options_.volume);
}

// A solution is seen by its stress, a mesh that is cut open by its cells, and parts without cells pulled apart, unless
// somebody has chosen something else.
void App::choose_view() {
    const Document& document = session_.document();
    if (is_view_complete_ || document.kind == Document::Kind::none) return;
    is_view_complete_ = true;
    if (document.solution && !chosen_.color && !chosen_.stage) {
        state_.color = ColorBy::von_mises;
        state_.step.stage = Stage::tetrahedra;
    }
    if (chosen_.faces_clip && !chosen_.stage && has_cells(document, state_.node)) state_.step = {Stage::tetrahedra, -1};
    if (!document.has_surfaces_alone() || chosen_.stage || is_of_cells(state_.color)) return;
    state_.step = {Stage::parts, -1};
    if (!chosen_.explode) state_.explode = usual_explosion;
}

void App::follow_session() {
    if (session_.poll()) {
        session_changed_ = true;
        wake();
    }
    begin_auto_run();
    choose_view();
    if (session_changed_) resolve_click();
    resolve_turn();
    const Document& document = session_.document();
    // A node that is asked for before the tree is known is waited for.
    const bool is_final = !session_.busy() && !session_.pending() && !document.progress.running;
    if (is_final && !document.tree.rows.empty() && !document.tree.find(state_.node)) state_.node = 1;
    steps_ = steps_of(document, shown_state().node);
    facts_.pending = session_.pending();
}

ViewState App::shown_state() const {
    ViewState shown = state_;
    if (!session_.document().tree.find(shown.node)) shown.node = 1;
    return shown;
}

// Without a camera in the state everything fits, whatever is shown.
void App::update_camera() {
    if (state_.camera) {
        camera_ = *state_.camera;
        return;
    }
    camera_ = {};
    const Clip& clip = state_.clip;
    if (chosen_.faces_clip && clip.on && !built_.left.isEmpty()) {
        look_from(camera_, clip.flipped ? Vec3(-clip.normal) : clip.normal);
        fit_body(camera_, built_.left);
        return;
    }
    look_from(camera_, Direction::corner);
    fit_body(camera_, built_.box);
}

void App::project_scene() {
    projection_ =
        project(camera_, built_.frame, built_.box, static_cast<int>(area_.width), static_cast<int>(area_.height));
    move_center(projection_, (2 * body_.x + body_.width - 2 * area_.x - area_.width) / std::max(area_.width, 1.f),
                -(2 * body_.y + body_.height - 2 * area_.y - area_.height) / std::max(area_.height, 1.f));
    projection_.x = static_cast<int>(area_.x);
    projection_.y = size_.height - static_cast<int>(area_.y + area_.height);
    projection_.pixel_ratio = size_.scale;
    renderer_.resize(size_.width, size_.height);
}

// Of patches, where there is room for them on what is seen of their faces.
void App::place_numbers() {
    const auto has_numbers = [](const Layer& layer) { return layer.patch != nullptr; };
    const std::vector<Layer>& layers = built_.scene.layers;
    if (area_.width < 1 || area_.height < 1 || std::none_of(layers.begin(), layers.end(), has_numbers)) {
        facts_.numbers.clear();
        numbered_.reset();
        return;
    }
    const NumberedView view{projection_.projection * projection_.view,
                            {projection_.x, projection_.y, projection_.width, projection_.height},
                            scenes_built_};
    if (numbered_ == view) return;
    numbered_ = view;
    facts_.numbers.clear();
    const float least_room = 0.7f * ImGui::GetFontSize();
    for (const NumberPlace& place : renderer_.places_of_patches(built_.scene, projection_))
        if (static_cast<float>(place.room) >= least_room)
            facts_.numbers.push_back(
                {place.number, static_cast<float>(place.x) + 0.5f, static_cast<float>(place.y) + 0.5f});
}

// Into what the legend leaves of the scene.
void App::fit_body(Camera& camera, const Eigen::AlignedBox3d& box) const {
    const float height = std::max(body_.height, 1.f);
    fit(camera, box, body_.width / height);
    camera.height *= area_.height / height;
}

void App::move_step(int direction) {
    const auto here = static_cast<int>(nearest_step(steps_, state_.step));
    state_.step =
        steps_[static_cast<std::size_t>(std::clamp(here + direction, 0, static_cast<int>(steps_.size()) - 1))];
}

void App::move_node(int direction) {
    state_.node = next_node(session_.document().tree, state_.node, direction);
    steps_ = steps_of(session_.document(), state_.node);
    state_.step.refused_try = -1;
}

// Through the steps of the node, then on to the next node.
void App::play() {
    if (!facts_.playing || ImGui::GetTime() < played_until_) return;
    played_until_ = ImGui::GetTime() + seconds_per_step;
    if (nearest_step(steps_, state_.step) + 1 < steps_.size()) {
        move_step(1);
        return;
    }
    const NodeId before = state_.node;
    move_node(1);
    facts_.playing = state_.node != before;
    if (facts_.playing) state_.step = {};
}

void App::build_scene() {
    const ViewState shown = shown_state();
    const std::string key = scene_key(shown);
    if (!session_changed_ && key == built_for_ && !built_.pending) return;
    session_changed_ = false;
    built_for_ = key;
    built_ = builder_.build(shown, session_);
    ++scenes_built_;
    facts_.legend_title = built_.legend.title;
    facts_.values = built_.legend.values;
    facts_.extremes = built_.legend.extremes;
    facts_.percentile = built_.legend.percentile;
    facts_.categories = built_.legend.categories;
    facts_.scale = built_.legend.scale;
    facts_.selection = describe_selection(session_, state_.selection, state_.load_case);
    facts_.pending = session_.pending();
    facts_.triangles = facts_.lines = 0;
    for (const Layer& layer : built_.scene.layers) {
        facts_.triangles += static_cast<std::int64_t>(layer.geometry->triangle_count());
        facts_.lines += static_cast<std::int64_t>(layer.geometry->segments.size());
    }
}

ViewOrigin App::origin_of_picture(float scale) const {
    const Document& document = session_.document();
    ViewOrigin origin;
    const bool is_temporary = session_.can_save_run() || document.kind == Document::Kind::surface;
    const std::string& input = !document.saved_as.empty() ? document.saved_as
                               : is_temporary             ? document.options.input
                                                          : document.path;
    if (!input.empty()) origin.input = absolute_path(input);
    const std::vector<OptionText> usual = option_texts({}, true);
    for (const OptionText& option : option_texts(document.options, true))
        if (is_temporary && document.saved_as.empty() &&
            std::none_of(usual.begin(), usual.end(),
                         [&](const OptionText& u) { return u.name == option.name && u.text == option.text; }))
            origin.run.push_back(option);
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    origin.width = static_cast<int>(size.x);
    origin.height = static_cast<int>(size.y);
    origin.scale = static_cast<double>(scale);
    origin.body = document.box;
    return origin;
}

void App::save_picture(float scale) {
    const std::string path = unused_picture(options_.screenshot_folder);
    try {
        write_png(path, picture());
        ViewState state = state_;
        state.camera = camera_;
        write_text_file(path.substr(0, path.size() - 4) + ".json", to_json(state, origin_of_picture(scale)));
        notify("saved as " + std::filesystem::path(path).lexically_normal().string() + ", its view as .json beside it");
    } catch (const Error& error) {
        complain(fmt::format("The picture was not saved: {} Start the viewer in a folder that can be written.",
                             error.what()));
    }
}

void App::lay_out(bool panels) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size_.width), static_cast<float>(size_.height)};
    io.DisplayFramebufferScale = {1, 1};
    const std::string style = fmt::format("{} {}", static_cast<int>(state_.theme), size_.scale);
    if (style != styled_for_) {
        ui_.apply(state_.theme, size_.scale);
        io.MouseDragThreshold = io.MouseDoubleClickMaxDist = nearby_pixels * size_.scale;
        styled_for_ = style;
    }
    ImGui::NewFrame();
    widgets_.begin_frame();
    area_ = scene_rectangle(state_, session_.document(), settings_.panels, io.DisplaySize.x, io.DisplaySize.y, panels);
    body_ = body_area(state_, area_);
    if (panels) {
        take_keys();
        take_mouse();
    }
    play();
    build_scene();
    update_camera();
    project_scene();
    place_numbers();
    UiContext context{state_, session_, settings_, facts_, steps_, *this, widgets_, camera_};
    if (panels)
        ui_.draw(context, io.DisplaySize.x, io.DisplaySize.y);
    else
        ui_.draw_overlays(context, area_);
    ImGui::Render();
    // What the panels have changed is part of this picture.
    steps_ = steps_of(session_.document(), shown_state().node);
    build_scene();
    update_camera();
    project_scene();
}

void App::paint() {
    renderer_.clear(built_.scene.background_bottom);
    if (area_.width >= 1 && area_.height >= 1) renderer_.draw(built_.scene, projection_);
    if (const ImDrawData* ui = ImGui::GetDrawData()) renderer_.draw_ui(*ui, *ImGui::GetIO().Fonts);
}

Image App::picture() {
    paint();
    return renderer_.read();
}

void App::present() {
    paint();
    renderer_.present();
}

void App::frame(const FrameSize& size, bool panels) {
    size_ = size;
    if (panels && size.width > 1) settings_.window = {size.width, size.height, size.scale};  // else it is iconified
    if (ImVec2& mouse = ImGui::GetIO().MousePos; ImGui::IsMousePosValid(&mouse))
        mouse = {mouse.x * size.pixels_per_unit_x, mouse.y * size.pixels_per_unit_y};
    if (frames_wanted_ > 0) --frames_wanted_;
    follow_session();
    const bool is_read = facts_.notice_is_error ? ImGui::IsMouseClicked(0) : ImGui::GetTime() > notice_until_;
    if (is_read) facts_.notice.clear();
    if (capture_) {
        capture_ = false;
        lay_out(false);
        save_picture(static_cast<float>(size.scale));
        wake();
    }
    lay_out(panels);
    // What was asked for is mostly there at once: better than a picture without it.
    if (built_.pending) wait(0.04);
}

bool App::wait(double seconds) {
    if (!session_.wait(seconds)) return false;
    session_changed_ = true;
    wake();
    return true;
}

bool App::wants_frame() {
    follow_session();
    // Progress in words, a few times a second.
    const auto now = std::chrono::steady_clock::now();
    const bool tells = session_.document().progress.running || (!facts_.notice.empty() && !facts_.notice_is_error);
    if (settled() && !(tells && now - last_frame_ > std::chrono::milliseconds(300))) return false;
    last_frame_ = now;
    return true;
}

bool App::settled() const {
    return frames_wanted_ == 0 && !built_.pending && !session_changed_ && !facts_.playing && !capture_;
}

}  // namespace kerf::view

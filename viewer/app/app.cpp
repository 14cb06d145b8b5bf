#include "viewer/app/app.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <imgui.h>

#include "core/error.h"
#include "io/text_file.h"
#include "viewer/app/settings.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/timeline.h"
#include "viewer/scene/selection.h"

namespace kerf::view {

namespace {

constexpr double usual_explosion = 0.4;  // of parts that are nothing but surfaces

constexpr double seconds_of_notice = 6;
constexpr float nearby_pixels = 6;  // how far the hand may tremble at a double click

// What the scene depends on.
std::string scene_key(ViewState state) {
    state.camera.reset();
    state.panels = {};
    state.speed = ViewState().speed;
    return to_json(state);
}

std::string unused_picture(const std::string& folder) {
    for (int i = 1;; ++i) {
        const std::string path = fmt::format("{}/kerf-{:03}.png", folder, i);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

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

void App::open_files(const std::vector<std::string>& paths) {
    RunOptions run = options_.run;
    run.input_options.more_files.assign(paths.begin() + 1, paths.end());
    session_.open(paths.front(), run);
    for (auto path = paths.rbegin(); path != paths.rend(); ++path) remember(settings_, *path);
    save_settings(options_.config_folder, settings_);
    const ViewState before = state_;
    // The next step of an analysis is seen in the same colours.
    kept_scale_ = {before.color, is_of_solution(before.color) ? before.color_range : std::nullopt};
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

void App::quit() { quit_ = true; }

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

void App::repair(const InputOptions& options) {
    opened_ = session_.document().path;  // whether it is meshed then is the user's to say
    show_before_repair(false);
    session_.repair(options);
}

void App::undo_repair() {
    show_before_repair(false);
    session_.undo_repair();
    session_changed_ = true;
}

void App::redo_repair() {
    show_before_repair(false);
    session_.redo_repair();
    session_changed_ = true;
}

void App::show_before_repair(bool before) {
    state_.camera = camera_;
    state_.node = 1;
    state_.step = {before ? Stage::before_repair : Stage::input, -1};
    wake();
}

// The key that goes from what was before to what is after.
void App::show_other() {
    if (session_.other_document())
        swap_runs();
    else if (session_.document().unrepaired)
        show_before_repair(state_.node != 1 || state_.step.stage != Stage::before_repair);
}

// Numbers of facets and defects mean others in a repaired surface.
void App::follow_repairs() {
    if (checked_ == session_.document().checked) return;
    const bool is_other = checked_ && session_.document().checked;
    checked_ = session_.document().checked;
    if (is_other && state_.selection.kind != Selection::Kind::place) state_.selection = {};
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
        const auto& cases = document.solution->cases;
        state_.color = !cases.empty() && cases.front().is_mode() ? ColorBy::displacement : ColorBy::von_mises;
        if (kept_scale_.range) {
            state_.color = kept_scale_.color;
            state_.color_range = kept_scale_.range;
        }
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
    follow_repairs();
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
    facts_.marked = built_.legend.marked;
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
    move();
    build_scene();
    update_camera();
    project_scene();
    place_labels();
    probe(panels);
    const Actions actions{*this, *this, *this, *this, *this, *this};
    UiContext context{state_, session_, settings_, facts_, steps_, actions, widgets_, camera_};
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
    return frames_wanted_ == 0 && !built_.pending && !session_changed_ && !facts_.playing && !facts_.moving &&
           !capture_;
}

}  // namespace kerf::view

#include "viewer/driver.h"

#include <chrono>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>
#include <imgui.h>

#include "support/places.h"
#include "viewer/panels/imgui_input.h"

namespace kerf::test {

namespace {

constexpr auto patience = std::chrono::seconds(60);

view::AppOptions app_options(const Driver::Options& options) {
    view::AppOptions app;
    app.shader_folder = test::build_folder() + "/shaders";
    app.kerf_program = test::kerf_program();
    app.config_folder = options.config_folder;
    app.example_folder = options.example_folder;
    app.screenshot_folder = options.screenshot_folder;
    app.auto_run = options.auto_run;
    app.volume = options.volume;
    app.asks_to_save = options.asks_to_save;
    app.run.parts = options.parts;
    app.run.cut.contour = options.contour;
    app.run.remeshing = options.remeshing;
    app.run.workers.count = 2;
    app.frame_seconds = options.frame_seconds;
    return app;
}

}  // namespace

Driver::Driver(const Options& options) : options_(options) {
    ImGuiIO& io = ImGui::GetIO();
    // The clipboard is the test's own.
    static std::string clipboard;
    clipboard.clear();
    io.SetClipboardTextFn = [](void*, const char* text) { clipboard = text; };
    io.GetClipboardTextFn = [](void*) { return clipboard.c_str(); };
    app_ = std::make_unique<view::App>(context_->gl(), app_options(options));
}

view::FrameSize Driver::size() const {
    const auto pixels = [&](int units) {
        return static_cast<int>(std::lround(options_.pixels_per_unit * static_cast<float>(units)));
    };
    return view::frame_size_of_window(pixels(options_.width), pixels(options_.height), options_.width, options_.height,
                                      options_.scale);
}

void Driver::frame(float seconds) {
    ImGuiIO& io = ImGui::GetIO();
    io.DeltaTime = seconds;
    // As ImGui's backend of GLFW sets them before every frame.
    view::put_mouse(mouse_x_ / options_.pixels_per_unit, mouse_y_ / options_.pixels_per_unit);
    io.DisplaySize = {static_cast<float>(options_.width), static_cast<float>(options_.height)};
    io.DisplayFramebufferScale = {options_.pixels_per_unit, options_.pixels_per_unit};
    app_->frame(size(), panels_);
}

void Driver::frames(int count) {
    for (int i = 0; i < count; ++i) frame();
}

void Driver::await(const std::string& what, const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited in vain for " + what);
        // A run under way needs the processor more than frames do.
        app_->wait(document().progress.running ? 0.1 : 0.01);
        app_->wake();
        frame();
    }
}

void Driver::settle() {
    app_->wake();
    const auto end = std::chrono::steady_clock::now() + patience;
    do {
        frame();
        if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the picture does not settle");
    } while (!app_->settled());
}

void Driver::open_files(const std::vector<std::string>& paths) {
    app_->open_files(paths);
    await("the run of " + paths.front(), [&] {
        const view::Document& d = document();
        if (!d.error.empty()) return true;
        if (d.kind == view::Document::Kind::surface && (!d.checked || app_->session().busy())) return false;
        // The trace of a run comes behind it.
        if (d.kind == view::Document::Kind::run && !d.progress.running && app_->session().busy()) return false;
        const bool needs_run = d.kind == view::Document::Kind::surface && options_.auto_run && !d.has_problems();
        const bool has_run = d.trace || !d.progress.message.empty();
        return !app_->session().pending() && (!needs_run || (has_run && !app_->session().busy()));
    });
    settle();
}

void Driver::move_to_screen(float pixels_per_unit, float scale) {
    options_.pixels_per_unit = pixels_per_unit;
    options_.scale = scale;
    app_->wake();
    frames(2);
}

void Driver::move_to(float x, float y) {
    mouse_x_ = x;
    mouse_y_ = y;
    frame();
}

void Driver::press(int button) {
    view::put_mouse_button(button, true);
    frame();
}

void Driver::release(int button) {
    view::put_mouse_button(button, false);
    frame();
}

// Two clicks at one place must not become a double click: the time between them is longer than that.
void Driver::click_at(float x, float y, int button) {
    move_to(x, y);
    press(button);
    release(button);
    frame(1);
}

void Driver::drag(float from_x, float from_y, float to_x, float to_y, int button) {
    move_to(from_x, from_y);
    press(button);
    constexpr int steps = 5;
    for (int i = 1; i <= steps; ++i) {
        const float s = static_cast<float>(i) / steps;
        move_to(from_x + s * (to_x - from_x), from_y + s * (to_y - from_y));
    }
    release(button);
    frames(2);
}

void Driver::wheel(float x, float y, float notches) {
    move_to(x, y);
    view::put_mouse_wheel(notches);
    frame();
    view::put_mouse_wheel(0);
    frame();
}

view::ItemRect Driver::item(const std::string& label) {
    frames(2);
    const auto found = app_->widgets().find(label);
    if (found) return *found;
    std::string all;
    for (const auto& [name, rect] : app_->widgets().items()) all += "'" + name + "' ";
    throw std::runtime_error(fmt::format("there is no '{}', but {}", label, all));
}

view::ItemRect Driver::item_in_sight(const std::string& label) {
    view::ItemRect rect = item(label);
    for (int i = 0; i < 200 && !rect.visible; ++i) {
        // The wheel scrolls the panel that the item belongs to; its column is where the item would be.
        const float middle = static_cast<float>(size().height) / 2;
        wheel((rect.left + rect.right) / 2, middle, rect.bottom > middle ? -1.f : 1.f);
        rect = item(label);
    }
    if (!rect.visible || !rect.enabled)
        throw std::runtime_error(fmt::format("'{}' is {}", label, rect.visible ? "disabled" : "not to be seen"));
    return rect;
}

bool Driver::offers(const std::string& label) const {
    const std::optional<view::ItemRect> found = app_->widgets().find(label);
    return found && found->enabled;
}

void Driver::click(const std::string& label) {
    const view::ItemRect rect = item_in_sight(label);
    click_at((rect.left + rect.right) / 2, (rect.top + rect.bottom) / 2);
}

void Driver::drag_over(const std::string& label, float from, float to) {
    const view::ItemRect rect = item_in_sight(label);
    const float width = rect.right - rect.left, y = (rect.top + rect.bottom) / 2;
    drag(rect.left + from * width, y, rect.left + to * width, y);
}

void Driver::key(int key, bool control, bool shift) {
    app_->press({.key = key, .control = control, .shift = shift});
    view::put_key(key, true, control, shift);
    frame();
    view::put_key(key, false, false, false);
    frames(2);
}

void Driver::keys_in_one_frame(const std::vector<view::KeyEvent>& keys) {
    for (const view::KeyEvent& event : keys) app_->press(event);
    frames(3);
}

void Driver::type(const std::string& text) {
    for (const char c : text) {
        ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(c));
        frame();
    }
    frames(2);
}

void Driver::drop(const std::string& path) {
    app_->open_files({path});
    frames(2);
}

view::Image Driver::picture() {
    settle();
    return app_->picture();
}

view::DrawnLayer Driver::drawn(view::LayerKind kind, std::optional<NodeId> owner) {
    view::DrawnLayer sum;
    app_->paint();
    for (const view::DrawnLayer& layer : app_->renderer().drawn())
        if (layer.kind == kind && owner.value_or(layer.owner) == layer.owner) {
            sum.triangles += layer.triangles;
            sum.segments += layer.segments;
            sum.points += layer.points;
        }
    return sum;
}

}  // namespace kerf::test

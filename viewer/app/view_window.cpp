#include "viewer/app/view_window.h"

#include <cmath>

#include "base/core/error.h"
#include "viewer/app/interruption.h"
#include "viewer/app/settings.h"
#include "viewer/render/window.h"

namespace kerf::view {

namespace {

// The seconds to sleep for events: changes that play, run or are being read are looked at in between.
double seconds_to_wait(App& app) {
    if (app.facts().playing || app.session().busy() || app.session().document().progress.running) return 0.05;
    return app.settled() ? 0.5 : 0;
}

std::string title_of(const Document& document) { return document.title.empty() ? "Kerf" : document.title + " - Kerf"; }

int at_scale_1(int pixels, double scale) { return static_cast<int>(std::lround(pixels / scale)); }

// Applies the options that need the document, and returns whether the document could tell them.
bool apply_when_known(App& app, const ViewCommand& command) {
    try {
        const Document& document = app.session().document();
        const Rectangle scene = app.scene_area();
        if (document.box.isEmpty() || scene.height < 1) return false;
        apply_document(command, document, static_cast<double>(scene.width / scene.height), app.state());
        return true;
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

void view_in_window(const ViewCommand& command, const AppOptions& options) {
    const ImGuiOwner imgui;
    const WindowSize last = load_settings(options.config_folder).window;
    Window window("Kerf", at_scale_1(last.width, last.scale), at_scale_1(last.height, last.scale));
    App app(window.gl(), options);
    if (!command.input.empty()) app.open_files(command.files());
    const Theme theme = app.state().theme;
    app.show(command.state, command.chosen);
    app.state().theme = command.theme.value_or(theme);
    bool is_applied = !depends_on_document(command);
    std::string title;
    while (!window.should_close() && !app.wants_to_quit() && !was_interrupted()) {
        if (window.take_events(seconds_to_wait(app))) app.wake();
        if (const std::vector<std::string> dropped = window.take_dropped_files(); !dropped.empty())
            app.open_files(dropped);
        for (const KeyEvent& event : window.take_key_events()) app.press(event);
        if (!is_applied) is_applied = apply_when_known(app, command);
        if (!app.wants_frame()) continue;
        window.begin_frame();
        app.frame(window.frame_size(), true);
        app.paint();
        app.renderer().present();
        window.swap();
        if (std::string now = title_of(app.session().document()); title != now)
            window.set_title(title = std::move(now));
    }
}

}  // namespace kerf::view

// kerf-view: the viewer. `kerf view` and `kerf screenshot` start it; it lies beside kerf. The window draws on demand:
// its loop sleeps until an event comes, wakes twenty times a second while something plays, runs or is being read, and
// draws a frame when the App wants one. Options of the command line that need the document are tried in every turn
// until the document knows what they name; one that it never knows is passed over in silence.
#include <cmath>
#include <exception>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/out_of_memory.h"
#include "files/io/program_finder.h"
#include "files/io/standard_streams.h"
#include "viewer/app/interruption.h"
#include "viewer/app/screenshot.h"
#include "viewer/app/settings.h"
#include "viewer/render/window.h"

namespace kerf::view {

namespace {

// The tree that is installed, with kerf in its bin; or the clone, with kerf in its build folder.
std::filesystem::path tree_of(const std::string& kerf_program) {
    return std::filesystem::path(kerf_program).parent_path().parent_path();
}

AppOptions options_beside_this_program() {
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    AppOptions options;
    options.kerf_program = look_for_program("kerf").path;
    options.shader_folder = (folder / "shaders").string();
    if (!std::filesystem::exists(options.shader_folder))
        options.shader_folder = (tree_of(options.kerf_program) / "share" / "kerf" / "shaders").string();
    return options;
}

std::string folder_of_examples(const std::filesystem::path& tree) {
    const std::filesystem::path installed = tree / "share" / "kerf" / "examples";
    std::error_code ignored;
    return (std::filesystem::exists(installed, ignored) ? installed : tree / "assets").string();
}

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
        apply_document(command, document, scene.width / scene.height, app.state());
        return true;
    } catch (const Error&) {
        return false;
    }
}

// Shows the viewer until the user closes it. Throws Error(io) without a display.
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
    while (!app.desk().wants_to_quit() && !was_interrupted()) {
        if (window.take_events(seconds_to_wait(app))) app.wake();
        if (window.take_close()) app.desk().quit();
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

int run(int argc, const char* const* argv) {
    const ViewCommand command = parse_view_command(argc, argv);
    if (!command.print.empty()) {
        if (command.exit_code == 0)
            print_data(command.print);
        else
            tell(command.print);
        return command.exit_code;
    }
    AppOptions options = options_beside_this_program();
    options.run = command.run;
    options.auto_run = command.auto_run;
    watch_for_interruption();
    if (command.screenshot) {
        take_screenshot(command, options);
    } else {
        options.asks_to_save = true;
        options.config_folder = user_config_folder();
        options.example_folder = folder_of_examples(tree_of(options.kerf_program));
        view_in_window(command, options);
    }
    return 0;
}

}  // namespace

}  // namespace kerf::view

int main(int argc, char** argv) {
    kerf::prepare_standard_streams();
    try {
        return kerf::view::run(argc, argv);
    } catch (const kerf::Error& error) {
        kerf::tell(fmt::format("kerf: {}\n", error.what()));
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        if (kerf::is_out_of_memory(error)) {
            kerf::tell("kerf: out of memory.\n");
            return static_cast<int>(kerf::ErrorCode::memory);
        }
        kerf::tell(fmt::format("kerf: internal error: {}\n", error.what()));
        return static_cast<int>(kerf::ErrorCode::internal);
    }
}

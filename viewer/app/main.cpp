// kerf-view: the viewer. `kerf view` and `kerf screenshot` start it; it lies beside kerf.
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
#include "viewer/app/view_window.h"

namespace kerf::view {

namespace {

AppOptions options_beside_this_program() {
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    AppOptions options;
    options.kerf_program = look_for_program("kerf").path;
    options.shader_folder = (folder / "shaders").string();
    if (!std::filesystem::exists(options.shader_folder))
        options.shader_folder = (folder.parent_path() / "share" / "kerf" / "shaders").string();
    return options;
}

// In a clone the program lies in build/, and assets/ beside it.
std::string folder_of_examples() {
    const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path().parent_path();
    const std::filesystem::path installed = folder / "share" / "kerf" / "examples";
    std::error_code ignored;
    return (std::filesystem::exists(installed, ignored) ? installed : folder / "assets").string();
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
        options.config_folder = user_config_folder();
        options.example_folder = folder_of_examples();
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

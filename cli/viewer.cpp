#include "cli/viewer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "core/error.h"

namespace kerf {

bool is_viewer_command(const std::string& command) {
    return std::find(std::begin(viewer_commands), std::end(viewer_commands), command) != std::end(viewer_commands);
}

void become_viewer(char** argv) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "kerf-view";
    ::execv(program.c_str(), argv);
    const int reason = errno;
    throw Error(ErrorCode::usage,
                fmt::format("{} could not be started: {}. The viewer is a program of its own beside kerf; build it "
                            "with KERF_VIEWER=ON, which needs libglfw3-dev, libimgui-dev and libosmesa6-dev, or open "
                            "the run folder's mesh.pvtu in ParaView.",
                            program.string(), std::strerror(reason)));
}

}  // namespace kerf

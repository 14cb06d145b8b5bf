#include "cli/other_programs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

#include "core/error.h"

namespace kerf {

const OtherProgram* find_other_program(const std::string& command) {
    const auto found = std::find_if(std::begin(other_programs), std::end(other_programs),
                                    [&](const OtherProgram& other) { return command == other.command; });
    return found == std::end(other_programs) ? nullptr : found;
}

void become(const OtherProgram& other, char** argv) {
    const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / other.program;
    ::execv(program.c_str(), argv);
    const int reason = errno;
    throw Error(ErrorCode::usage,
                fmt::format("{} could not be started: {}. {}", program.string(), std::strerror(reason), other.remedy));
}

}  // namespace kerf

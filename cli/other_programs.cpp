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

std::string program_beside_this(const std::string& name) {
    return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
}

const OtherProgram* find_other_program(const std::string& command) {
    const auto found = std::find_if(std::begin(other_programs), std::end(other_programs),
                                    [&](const OtherProgram& other) { return command == other.command; });
    return found == std::end(other_programs) ? nullptr : found;
}

void become(const OtherProgram& other, char** argv) {
    const std::string program = program_beside_this(other.program);
    ::execv(program.c_str(), argv);
    const int reason = errno;
    throw Error(ErrorCode::usage,
                fmt::format("{} could not be started: {}. {}", program, std::strerror(reason), other.remedy));
}

}  // namespace kerf

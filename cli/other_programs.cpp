#include "cli/other_programs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/program_finder.h"
#include "fill/volume/child_process.h"

namespace kerf {

const OtherProgram* find_other_program(const std::string& command) {
    const auto found = std::find_if(std::begin(other_programs), std::end(other_programs),
                                    [&](const OtherProgram& other) { return command == other.command; });
    return found == std::end(other_programs) ? nullptr : found;
}

std::string output_of_other_programs(const std::vector<std::string>& arguments) {
    constexpr double patience_seconds = 60;
    std::set<std::string> programs;
    for (const OtherProgram& other : other_programs)
        if (const ProgramSearch search = look_for_program(other.program); search.found) programs.insert(search.path);
    std::string output;
    for (const std::string& program : programs) {
        ChildPool pool;
        pool.start(0, program, arguments, {}, patience_seconds);
        const ChildResult result = pool.wait_any()->result;
        if (result.exit_code != 0)
            throw Error(ErrorCode::internal,
                        fmt::format("{} {} has failed: {}", program, fmt::join(arguments, " "), result.log));
        output.append(result.output.begin(), result.output.end());
    }
    return output;
}

void become(const OtherProgram& other, char** argv) {
    const std::string program = look_for_program(other.program).path;
    ::execv(program.c_str(), argv);
    const int reason = errno;
    throw Error(ErrorCode::usage,
                fmt::format("{} could not be started: {}. {}", program, std::strerror(reason), other.advice));
}

}  // namespace kerf

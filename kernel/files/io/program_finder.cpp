#include "files/io/program_finder.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

// The folder of the shared library that has this function, if it is one.
fs::path folder_of_library() {
    Dl_info info{};
    if (::dladdr(reinterpret_cast<const void*>(&look_for_program), &info) == 0 || !info.dli_fname) return {};
    const fs::path file = info.dli_fname;
    if (!file.has_parent_path()) return {};  // a program by the name that a shell has looked for
    std::error_code error;
    const fs::path whole = fs::canonical(file, error);
    return error ? fs::path() : whole.parent_path();
}

fs::path folder_of_program() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// The folders of a package of Python that may hold the programs: in a wheel, in a build folder, and in an installed
// tree.
std::vector<fs::path> folders_of_package(const fs::path& package) {
    std::error_code error;
    if (package.empty() || !fs::exists(package / "__init__.py", error)) return {};
    const fs::path tree = (package / "../../../..").lexically_normal();
    return {package / "bin", package.parent_path().parent_path(), tree / "bin", tree / "libexec/kerf"};
}

// The folder of a file and those that an installed tree may have with it: users call what is in bin, and other programs
// may lie in libexec/kerf.
std::vector<fs::path> folders_with(const fs::path& own) {
    if (own.empty()) return {};
    const fs::path tree = own.parent_path();
    if (own.filename() == "kerf" && tree.filename() == "libexec") return {own, tree.parent_path() / "bin"};
    return {own, tree / "bin", tree / "libexec/kerf"};
}

std::vector<fs::path> folders_with_programs(const std::string& folder) {
    std::vector<fs::path> folders;
    if (!folder.empty()) folders.emplace_back(folder);
    if (const char* named = std::getenv(programs_variable); named && *named != 0) folders.emplace_back(named);
    for (const fs::path& each : folders_of_package(folder_of_library())) folders.push_back(each);
    for (const fs::path& own : {folder_of_library(), folder_of_program()})
        for (const fs::path& each : folders_with(own)) folders.push_back(each);
    return folders;
}

}  // namespace

ProgramSearch look_for_program(const std::string& name, const std::string& folder) {
    ProgramSearch search;
    for (const fs::path& place : folders_with_programs(folder)) {
        const std::string path = (place / name).string();
        if (std::find(search.looked_at.begin(), search.looked_at.end(), path) != search.looked_at.end()) continue;
        search.looked_at.push_back(path);
        std::error_code ignored;
        search.found = fs::is_regular_file(path, ignored);
        if (search.found) break;
    }
    if (!search.looked_at.empty()) search.path = search.found ? search.looked_at.back() : search.looked_at.front();
    return search;
}

std::string find_kerf_program(const std::string& name, const std::string& folder) {
    ProgramSearch search = look_for_program(name, folder);
    if (!search.found)
        throw Error(
            ErrorCode::io,
            fmt::format("The program {} is at none of these places: {}. Put it there, or name its folder in the "
                        "environment variable {}.",
                        name, fmt::join(search.looked_at, ", "), programs_variable));
    return std::move(search.path);
}

}  // namespace kerf

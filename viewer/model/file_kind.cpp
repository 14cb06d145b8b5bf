#include "viewer/model/file_kind.h"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"

namespace kerf::view {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view partial_ending = ".kerf-partial";

bool begins_with_event(const std::string& path) {
    constexpr std::size_t limit = 1 << 16;  // the first event is short
    std::ifstream file(path, std::ios::binary);
    if (file.peek() != '{') return false;
    std::string line(limit, '\0');
    file.read(line.data(), limit);
    line.resize(file.gcount());
    const nlohmann::json json = parse_json_or_null(line.substr(0, line.find('\n')));
    return json.is_object() && json.contains("event");
}

bool begins_like_trace(const std::string& path) {
    char begin[8] = {};
    std::ifstream(path, std::ios::binary).read(begin, sizeof begin);
    return std::string_view(begin, sizeof begin) == "kerftrac";
}

}  // namespace

bool exists(const std::string& path) {
    std::error_code ignored;
    return !path.empty() && fs::exists(path, ignored);
}

std::string absolute_path(const std::string& path) {
    const fs::path normal = fs::absolute(path).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

OpenedPath tell_kind(const std::string& path) {
    const std::string full = absolute_path(path);
    const std::string folder =
        full.ends_with(partial_ending) ? full.substr(0, full.size() - partial_ending.size()) : full;
    const std::string partial = folder + std::string(partial_ending);
    std::error_code ignored;
    const bool is_file = exists(full) && !fs::is_directory(full, ignored);
    if (!is_file) {
        // A run that is under way is of more interest than the one that it replaces, but only to who asks for it.
        const bool asks_for_partial = full != folder;
        if (!asks_for_partial && exists(folder + "/report.json")) return {OpenedPath::Kind::run, folder, ""};
        if (exists(partial + "/work/run.json")) return {OpenedPath::Kind::partial_run, folder, partial};
        for (const char* report : {"report.json", "solution/report.json"})
            if (exists(folder + "/" + report)) return {OpenedPath::Kind::run, folder, ""};
        if (exists(full))
            throw Error(ErrorCode::io, fmt::format("{} is a folder without report.json, so it is no finished run. Open "
                                                   "the folder that kerf mesh -o has written, or a surface file.",
                                                   path));
        return {};
    }
    if (!fs::is_regular_file(full, ignored)) return {};  // a pipe may wait for ever: who reads a surface refuses it
    if (begins_like_trace(full)) return {OpenedPath::Kind::trace, "", ""};
    if (begins_with_event(full)) return {OpenedPath::Kind::events, "", ""};
    return {};
}

}  // namespace kerf::view

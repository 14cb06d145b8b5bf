#include "support/surroundings.h"

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

namespace kerf::test {

namespace fs = std::filesystem;

namespace {

const std::set<std::string> output_options = {"-o",       "--output", "--report",    "--trace",
                                              "--events", "--resume", "--offenders", "--picture"};

// Behind all links, as far as it exists.
std::string normal(const std::string& path) {
    std::error_code ignored;
    const fs::path clean = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
    return (clean.has_filename() ? clean : clean.parent_path()).string();
}

// What is written by who is given `path`: a run that goes on is named by its partial folder, too.
std::string output_of(const std::string& path) {
    constexpr std::string_view partial = ".kerf-partial";
    std::string output = normal(path);
    if (output.ends_with(partial)) output.resize(output.size() - partial.size());
    return output;
}

bool names_output(const std::vector<std::string>& arguments) {
    return std::find(arguments.begin(), arguments.end(), "-o") != arguments.end();
}

}  // namespace

Surroundings::Surroundings(const std::vector<std::string>& arguments) {
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        std::error_code ignored;
        const bool is_run_to_export = i == 1 && arguments[0] == "export" && !names_output(arguments);
        const bool is_output = is_run_to_export || (i > 0 && output_options.contains(arguments[i - 1]));
        if (argument.empty() || argument.starts_with("/dev/") || argument.starts_with("/proc/")) continue;
        if (is_output) {
            outputs_.push_back(output_of(argument));
            if (fs::is_symlink(argument, ignored) && !fs::exists(argument, ignored))
                outputs_.push_back(normal((fs::path(argument).parent_path() / fs::read_symlink(argument)).string()));
        }
        if (!is_output && !fs::exists(argument, ignored)) continue;
        const std::string folder = fs::path(normal(argument)).parent_path().string();
        if (folder.size() > 1 && folder != fs::temp_directory_path()) folders_.insert(folder);
    }
    before_ = snapshot();
}

bool Surroundings::is_output(const std::string& path) const {
    return std::any_of(outputs_.begin(), outputs_.end(), [&](const std::string& output) {
        if (!path.starts_with(output)) return false;
        const std::string rest = path.substr(output.size());
        return rest.empty() || rest.front() == '/' || rest.starts_with(".failed") || rest.starts_with(".kerf-");
    });
}

Surroundings::Files Surroundings::snapshot() const {
    Files files;
    for (const std::string& folder : folders_) {
        std::error_code error;
        for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
             entry.increment(error)) {
            const std::string path = entry->path().string();
            struct stat status {};
            if (is_output(path)) {
                entry.disable_recursion_pending();
                continue;
            }
            if (::lstat(path.c_str(), &status) != 0) continue;
            const bool is_folder = S_ISDIR(status.st_mode);  // outputs may be put into it
            files[path] = is_folder ? "folder"
                                    : fmt::format("{} {} {}.{}", status.st_ino, status.st_size, status.st_mtim.tv_sec,
                                                  status.st_mtim.tv_nsec);
        }
    }
    return files;
}

std::string Surroundings::changes() const {
    const Files now = snapshot();
    std::string text;
    for (const auto& [path, state] : before_) {
        const auto found = now.find(path);
        if (found == now.end())
            text += path + " was removed\n";
        else if (found->second != state)
            text += path + " was changed\n";
    }
    for (const auto& [path, state] : now)
        if (!before_.contains(path)) text += path + " was created\n";
    return text;
}

}  // namespace kerf::test

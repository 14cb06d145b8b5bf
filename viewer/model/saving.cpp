// A mesh is written by kerf merge where its format has a file of the whole mesh, and by kerf export where it has a
// folder. The table of formats is the exporter's own, so that a new format is here, too.
#include "viewer/model/saving.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/shell_word.h"
#include "files/io/run_folder.h"
#include "viewer/model/file_kind.h"
#include "viewer/model/inside/run_process.h"
#include "viewer/model/timeline.h"

namespace kerf::view {

namespace fs = std::filesystem;

bool has_mesh(const Document& document) {
    return document.kind != Document::Kind::none && !document.progress.running && !document.folder.empty() &&
           has_cells(document, root_node);
}

std::string folder_of(const Document& document) {
    if (!document.saved_as.empty()) return document.saved_as;
    return document.solution ? absolute_path(document.path) : document.folder;
}

std::string unused_run_folder(const Document& document) {
    std::error_code ignored;
    const std::string& input = document.options.input.empty() ? document.path : document.options.input;
    const std::string name = (fs::current_path(ignored) / fs::path(input).stem()).string() + "_run";
    for (int number = 1;; ++number) {
        const std::string path = number == 1 ? name : fmt::format("{}_{}", name, number);
        std::vector<std::string> places = RunFolder::folders_of(path);
        places.push_back(path + ".trace");
        const auto is_there = [&](const std::string& place) { return fs::exists(place, ignored); };
        if (std::none_of(places.begin(), places.end(), is_there)) return path;
    }
}

std::string with_ending(const std::string& path, const Format& format) {
    return fs::path(path).replace_extension(format.ending ? format.ending : "").string();
}

std::vector<std::string> arguments_of_mesh(const std::string& folder, const MeshFile& file) {
    std::vector<std::string> arguments = {file.format->ending ? "merge" : "export", folder, "--output=" + file.path};
    if (!file.format->ending) arguments.push_back(fmt::format("--format={}", file.format->name));
    if (file.order > 0) arguments.push_back(fmt::format("--order={}", file.order));
    arguments.emplace_back("--quiet");
    return arguments;
}

std::vector<std::string> arguments_of_page(const std::string& folder, const std::string& path) {
    return {"report", folder, "--output=" + path, "--quiet"};
}

std::vector<std::string> arguments_of_run(const Document& document, const std::string& folder) {
    RunRequest options = document.options;
    options.input = absolute_path(options.input);
    options.output = folder;
    return command_line_of(options, options.volume);
}

std::vector<std::string> arguments_of_surface(const Document& document, const std::string& path) {
    RunRequest options;
    options.input = absolute_path(document.path);
    options.input_options = document.options.input_options;
    options.output = path;
    std::vector<std::string> arguments = command_line_of(options, true);
    arguments.front() = "repair";
    return arguments;
}

std::string command_text(const std::vector<std::string>& arguments) {
    std::string text = "kerf";
    for (const std::string& argument : arguments) text += " " + shell_word(argument);
    return text;
}

}  // namespace kerf::view

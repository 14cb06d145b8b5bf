// A saved run is a JSON file in the partial folder of a run: the input with its hash, and all options as texts of the
// table (run/request/run_request.h). It is written durably before the work and removed when a run has ended well, so
// that its existence says that parts may be missing. Options of the host and of the caller, workers and events, are not
// saved. A file that cannot be read counts as absent where only reuse is at stake (is_same_run(),
// interrupted_part_count()), and is an error where a user asks to continue.
#include "run/request/saved_run.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/durable_file.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"
#include "files/io/path_text.h"
#include "files/io/run_folder.h"
#include "files/io/run_manifest.h"

namespace kerf {

namespace {

RunRequest load_saved_run(const std::string& file) {
    RunRequest options;
    try {
        const auto json = parse_json(read_file(file));
        options.input = path_of_text(json.at("input").get<std::string>());
        options.input_hash = json.at("input_hash").get<std::string>();
        std::vector<OptionText> texts;
        for (const auto& [name, text] : json.at("options").items())
            texts.push_back({name, path_of_text(text.get<std::string>())});
        set_options(options, texts, file);
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorCode::io,
                    fmt::format("{} is damaged. Run kerf mesh with the input and the options again: what "
                                "is finished is found there, too.",
                                file));
    }
    return options;
}

// As differences_of_runs(); nothing for a file that cannot be read.
std::optional<std::string> find_differences(const std::string& saved_run_file, const RunRequest& options,
                                            const std::string& input_hash) {
    try {
        const RunRequest saved = load_saved_run(saved_run_file);
        if (saved.input_hash != input_hash) return "the input";
        const std::vector<OptionText> one = option_texts(saved, true), other = option_texts(options, true);
        std::string names;
        for (std::size_t i = 0; i < one.size(); ++i)
            if (one[i].text != other[i].text) names += (names.empty() ? "" : ", ") + one[i].name;
        return names;
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

void save_run(const std::string& path, const RunRequest& options, const std::string& input_hash) {
    RunRequest saved = options;
    saved.workers.count = 0;            // the host that continues may have other cores
    saved.outputs.events_file.clear();  // the caller that continues names its own
    for (std::string* file : {&saved.outputs.report_file, &saved.outputs.trace_file})
        if (!file->empty()) *file = std::filesystem::absolute(*file).string();
    nlohmann::ordered_json json = {{"input", path_text(std::filesystem::absolute(options.input).string())},
                                   {"input_hash", input_hash}};
    for (const OptionText& option : option_texts(saved, false)) json["options"][option.name] = path_text(option.text);
    write_durable_file(path, json_text(json, 2) + "\n");
}

bool is_complete_run(const std::string& folder) {
    const std::string output = RunFolder::result_of(folder);
    std::error_code ignored;
    return !std::filesystem::exists(RunFolder::saved_run_file(output), ignored) && inspect_run_folder(output).is_valid;
}

RunRequest load_interrupted_run(const std::string& folder) {
    const std::string output = RunFolder::result_of(folder);
    const std::string file = RunFolder::saved_run_file(output);
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored))
        throw Error(ErrorCode::io, fmt::format("No interrupted run waits for {}: {} does not exist. Start one with "
                                               "kerf mesh INPUT -o {}.",
                                               output, file, output));
    RunRequest options = load_saved_run(file);
    options.output = std::filesystem::absolute(output).string();
    return options;
}

void refuse_changed_input(const RunRequest& options, const std::string& input_hash) {
    if (options.input_hash.empty() || options.input_hash == input_hash) return;
    throw Error(ErrorCode::io,
                fmt::format("{} is not the file that the interrupted run has read: its bytes are others. "
                            "Put that back to continue, or start anew: kerf mesh {} -o {}.",
                            options.input, options.input, options.output));
}

bool is_same_run(const std::string& saved_run_file, const RunRequest& options, const std::string& input_hash) {
    const std::optional<std::string> differences = find_differences(saved_run_file, options, input_hash);
    return differences && differences->empty();
}

std::string differences_of_runs(const std::string& saved_run_file, const RunRequest& options,
                                const std::string& input_hash) {
    return find_differences(saved_run_file, options, input_hash).value_or("");
}

std::int32_t interrupted_part_count(const std::string& output, const std::string& input_hash) {
    try {
        const RunRequest saved = load_interrupted_run(output);
        return saved.input_hash == input_hash ? saved.parts : 0;
    } catch (const Error&) {
        return 0;
    }
}

}  // namespace kerf

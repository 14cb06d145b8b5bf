// check_files() refuses every path by which a run would destroy its own input or another of its outputs, before any
// work. A run that is continued has its output folder already, which is told by `input_hash`.
#include "run/request/run_request.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/run_folder.h"

namespace kerf {

std::vector<NamedPath> OutputOptions::files() const {
    return {{"--trace", trace_file, output_kind::trace},
            {"--events", events_file, output_kind::events},
            {"--report", report_file, output_kind::report}};
}

bool names_output(const std::string& option) {
    const std::vector<NamedPath> outputs = OutputOptions().files();
    return std::any_of(outputs.begin(), outputs.end(),
                       [&](const NamedPath& output) { return output.option == "--" + option; });
}

// Checks all that can be known of the files before any work.
void RunRequest::check_files() const {
    const std::vector<std::string> folders =
        dry_run || output.empty() ? std::vector<std::string>() : RunFolder::folders_of(output);
    const auto is_in_the_way = [&](const std::string& file) {
        return std::any_of(folders.begin(), folders.end(),
                           [&](const std::string& folder) { return lies_inside(file, folder); });
    };
    if (!folders.empty() && input_hash.empty()) refuse_file_name("--output", output);  // a resumed run has begun there
    if (is_in_the_way(input))
        throw Error(ErrorCode::io,
                    fmt::format("The input {} lies in the output folder {}, which is replaced as a whole "
                                "when the run ends. Choose another output folder.",
                                input, output));
    for (const auto& [option, file, kind] : outputs.files()) {
        if (file.empty() || file.starts_with("fd:")) continue;
        if (is_in_the_way(file))
            throw Error(ErrorCode::usage, fmt::format("{} is {}, which lies in the output folder {}. That is replaced "
                                                      "as a whole when the run ends, so choose a place outside of it.",
                                                      option, file, output));
        refuse_to_overwrite(input, option, file);
        refuse_to_overwrite(sizes.field_file, option, file);
        require_writable(option, file, kind);
    }
    refuse_same_outputs(outputs.files());
}

}  // namespace kerf

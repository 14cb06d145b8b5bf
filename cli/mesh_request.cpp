// The request of a run, settled from command line, config file and interrupted run. The command line wins over a config
// file, so that an entry is applied only where its option was not given. A config file may come from anybody and must
// not write anything but a run: options that name files to be written are refused in it. A resumed run takes its
// options from the interrupted one; options of the line may change only those that do not shape the parts that are
// finished. An output with the ending of a merged format is one file: the run goes into a folder beside it
// (run_folder_beside()) and is merged at the end, and options whose result that file cannot hold are refused.
#include "cli/mesh_request.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/error.h"
#include "files/export/format.h"
#include "files/export/merged_file.h"
#include "files/io/output_file.h"
#include "help/nearest.h"
#include "run/request/config_file.h"
#include "run/request/saved_run.h"

namespace kerf {

namespace {

// The options that a config file may set. It may come from anybody, and write nothing but a run.
std::vector<OptionField> config_fields(MeshRequest& request) {
    std::vector<OptionField> fields = option_fields(request.options);
    std::erase_if(fields, [](const OptionField& field) { return names_output(field.name); });
    for (OptionField& field : program_fields(request)) fields.push_back(std::move(field));
    return fields;
}

bool is_given(const CLI::App& command, const std::string& option) {
    return command.get_option("--" + option)->count() > 0;
}

// Sets the options of the config file that the command line has not given.
void apply_config(const CLI::App& command, MeshRequest& request) {
    const std::vector<OptionField> fields = config_fields(request);
    std::vector<std::string> names;
    for (const OptionField& field : fields) names.push_back(field.name);
    for (const ConfigEntry& entry : read_config(request.config_file)) {
        if (names_output(entry.name))
            throw Error(ErrorCode::usage,
                        fmt::format("{}: '{}' names a file to be written, which only the command line may: --{} {}.",
                                    entry.place, entry.name, entry.name, entry.text));
        if (std::find(names.begin(), names.end(), entry.name) == names.end())
            throw Error(ErrorCode::usage,
                        fmt::format("{}: '{}' is not an option.{} kerf mesh --print-config lists them.", entry.place,
                                    entry.name, did_you_mean(entry.name, names)));
        if (!is_given(command, entry.name)) set_option(fields, entry);
    }
}

// The usual output: part-mesh for parts/part.stl.gz. Cuts have another name, so that they do not replace a mesh.
std::string usual_output(const RunRequest& options) {
    std::filesystem::path name = std::filesystem::path(options.input).filename();
    if (name.extension() == ".gz" || name.extension() == ".zst") name = name.stem();
    return name.stem().string() + (options.volume ? "-mesh" : "-cut");
}

// Refuses options whose result a run folder holds beside the mesh: with one file it would be lost.
void refuse_what_no_file_holds(const RunRequest& options, const std::string& file, const Format& format) {
    const auto refuse = [&](const std::string& why) {
        throw Error(ErrorCode::usage,
                    fmt::format("--output is {}, a file of one mesh, but {}. Name a folder instead: -o {}.", file, why,
                                std::filesystem::path(file).stem().string()));
    };
    if (!options.volume) refuse("kerf decompose writes the surface of every part");
    if (options.outputs.stl) refuse("--stl writes the surface of every part");
    if (options.outputs.reference) refuse("--reference writes a comparison, too");
    if (!options.outputs.fields.empty()) refuse("--fields are those of the files of parts");
    if (!options.outputs.patch_types.empty()) refuse("--patch-type is for a case of OpenFOAM");
    if (options.outputs.split_regions) refuse("--split-regions is for a case of OpenFOAM");
    if (!options.outputs.formats.empty() && options.outputs.formats != format.name)
        refuse(fmt::format("--format {} asks for other files", options.outputs.formats));
}

// A name that looks like one of a file would become that of a folder.
void refuse_unknown_ending(const std::string& output) {
    std::vector<std::string> endings;
    for (const Format* format : formats())
        if (format->ending) endings.emplace_back(format->ending);
    const std::string ending = std::filesystem::path(output).extension().string();
    refuse_file_name(
        "--output", output,
        fmt::format("{} Files of one mesh end with {}.", did_you_mean(ending, endings), fmt::join(endings, " ")));
}

// Chooses the places of the result. A mesh in one file is that of a run in a folder beside it.
void settle_output(MeshRequest& request) {
    RunRequest& options = request.options;
    if (options.dry_run) return;
    request.has_usual_output = options.output.empty();
    if (request.has_usual_output) options.output = usual_output(options);
    const Format* format = find_merged_format(options.output);
    if (!format) return refuse_unknown_ending(options.output);
    refuse_what_no_file_holds(options, options.output, *format);
    options.outputs.formats.clear();
    request.merged_file = options.output;
    options.output = run_folder_beside(request.merged_file);
}

// Takes the interrupted run's options, and those of this command line that change nothing of the result.
void resume_run(const CLI::App& command, MeshRequest& request) {
    std::error_code ignored;
    if (find_merged_format(request.resume) && !std::filesystem::is_directory(request.resume, ignored))
        request.resume = run_folder_beside(request.resume);
    RunRequest options = load_interrupted_run(request.resume);
    const std::vector<OptionField> saved = option_fields(options), given = option_fields(request.options);
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (!is_given(command, given[i].name)) continue;
        if (given[i].shapes_parts)
            throw Error(ErrorCode::usage,
                        fmt::format("--{} would change the parts that are finished. Leave it out with --resume, or "
                                    "start anew: kerf mesh {} -o {}.",
                                    given[i].name, options.input, options.output));
        saved[i].set_text(given[i].text());
    }
    options.dry_run = request.options.dry_run;
    request.merged_file = merged_file_of(options.output);
    if (const Format* format = find_merged_format(request.merged_file))
        refuse_what_no_file_holds(request.options, request.merged_file, *format);
    request.options = options;
}

}  // namespace

std::vector<OptionField> program_fields(MeshRequest& request) {
    return {
        {"output", "o", option_group::output, "DIR|FILE",
         "Folder of the result; an older run there is replaced. Of kerf mesh a file, too, whose ending is that of a "
         "format of kerf merge: one mesh. Default: named like the input, in this folder.",
         &request.options.output},
        {"quiet", "q", option_group::output, "", "Print nothing but errors.", &request.quiet},
        {"verbose", "v", option_group::output, "",
         "Print all that is known of the result, and the tree of cuts with every node of it.", &request.verbose}};
}

std::string config_text(MeshRequest& request) { return to_config(config_fields(request)); }

void settle_request(const CLI::App& command, MeshRequest& request) {
    if (!request.config_file.empty()) apply_config(command, request);
    const bool is_new = request.resume.empty();
    take_inputs(request.inputs, request.options.input, request.options.input_options);
    if (is_new && !request.print_config && request.options.input.empty()) throw CLI::RequiredError("input");
    if (!is_new) resume_run(command, request);
    const std::int32_t parts = request.options.parts;
    if (is_given(command, "parts") && parts < 1)
        throw Error(ErrorCode::usage, fmt::format("--parts is {}, but a mesh has 1 or more parts.", parts));
    if (is_new && !request.print_config) settle_output(request);
}

}  // namespace kerf

// kerf remesh: a surface worth meshing, as a file.
#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "cli/progress.h"
#include "help/program_help.h"
#include "io/standard_streams.h"
#include "prepare/remeshed_file.h"
#include "report/report.h"

namespace kerf {

namespace {

struct RemeshRequest {
    RunOptions options;
    std::string output;
    bool quiet = false;
};

// Options that say what the surface is, how fine, and how far it may be off.
bool shapes_surface(const std::string& name) {
    InputOptions of_input;
    SizeOptions of_sizes;
    const auto is_named = [&](const OptionField& field) { return field.name == name; };
    const std::vector<OptionField> input = input_option_fields(of_input), sizes = size_option_fields(of_sizes);
    return name == "deviation" || std::any_of(input.begin(), input.end(), is_named) ||
           std::any_of(sizes.begin(), sizes.end(), is_named);
}

int remesh_and_tell(const RemeshRequest& request) {
    RemeshedFile written;
    {
        ProgressLine progress(request.quiet, nullptr);
        written = remesh_file(request.options, request.output, &progress);
    }
    if (request.quiet) return 0;
    tell(fmt::format("kerf: {}: {} facets, {}\n", request.output, written.facets, remeshing_text(written.done)));
    if (written.found_size) tell(fmt::format("kerf: cells {}\n", found_size_text(*written.found_size)));
    return 0;
}

}  // namespace

void add_remesh_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<RemeshRequest>();
    CLI::App* command = kerf.add_subcommand("remesh", "Make a surface worth meshing, within a bound of the input.");
    command->add_option("input", request->options.input, "Closed surface, as for kerf mesh.")
        ->required()
        ->type_name("INPUT");
    command->option_defaults()->group(option_group::output);
    command->add_option("-o,--output", request->output, "Surface, .obj (with patches) or .stl.")
        ->required()
        ->type_name("FILE");
    for (const OptionField& field : option_fields(request->options))
        if (shapes_surface(field.name)) add_option_field(*command, field);
    heed_unit(*command, request->options.input_options);
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but errors.");
    put_help_last(*command, option_group::output,
                  {"output", "size", "deviation", "size-on", "chord-error", "feature-angle", "quiet"});
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return remesh_and_tell(*request); }); });
}

}  // namespace kerf

// kerf remesh and kerf wrap: a surface worth meshing, made of one that could be meshed (remesh) or of any other (wrap),
// as a file.
#include <algorithm>
#include <chrono>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "base/core/number_text.h"
#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "cli/progress.h"
#include "files/io/standard_streams.h"
#include "help/program_help.h"
#include "run/prepare/remeshed_file.h"
#include "run/report/report.h"

namespace kerf {

namespace {

struct RemeshRequest {
    RunRequest options;
    std::string output;
    bool only_bad = false;
    bool quiet = false;
};

// Whether an option says how the surface is read, how fine it is to be, or how far it may be off.
bool shapes_surface(const std::string& name) {
    InputOptions of_input;
    SizeOptions of_sizes;
    const auto is_named = [&](const OptionField& field) { return field.name == name; };
    const std::vector<OptionField> input = input_option_fields(of_input), sizes = size_option_fields(of_sizes);
    return name == "deviation" || std::any_of(input.begin(), input.end(), is_named) ||
           std::any_of(sizes.begin(), sizes.end(), is_named);
}

int remesh_and_tell(const RemeshRequest& request) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    const Remeshing how = request.only_bad ? Remeshing::where_needed : Remeshing::always;
    RemeshedFile written;
    {
        ProgressLine progress(request.quiet, nullptr);
        written = remesh_file(request.options, request.output, &progress, how);
    }
    if (request.quiet) return 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const double rate = static_cast<double>(written.facets) / seconds;
    if (written.wrapped) tell(fmt::format("kerf: wrapped: {}\n", to_text(*written.wrapped)));
    for (const std::string& note : written.notes) tell(fmt::format("kerf: {}\n", note));
    tell(fmt::format("kerf: {}: {} facets, {}\n", request.output, grouped(written.facets),
                     written.done ? remeshing_text(*written.done) : "as they were: too few are bad to spoil cells"));
    tell(fmt::format("kerf: {:.2f} s, {} facets/s\n", seconds, short_number(rate)));
    if (written.found_size) tell(fmt::format("kerf: cells {}\n", found_size_text(*written.found_size)));
    return 0;
}

void add_surface_command(CLI::App& kerf, int& exit_code, bool is_wrap) {
    const auto request = std::make_shared<RemeshRequest>();
    request->options.input_options.wrap = is_wrap;
    CLI::App* command =
        is_wrap ? kerf.add_subcommand("wrap", "Put a closed surface around any other, and say how far it is from it.")
                : kerf.add_subcommand("remesh", "Make a surface worth meshing, within a bound of the input.");
    command
        ->add_option("input", request->options.input,
                     is_wrap ? "Surface, whatever it is." : "Closed surface, as for kerf mesh.")
        ->required()
        ->type_name("INPUT");
    command->option_defaults()->group(option_group::output);
    add_surface_output(*command, request->output);
    for (const OptionField& field : option_fields(request->options))
        if (shapes_surface(field.name)) add_option_field(*command, field);
    if (!is_wrap)
        command
            ->add_flag(
                "--only-bad", request->only_bad,
                "Change nothing unless more than one in a thousand facets is bad, with an angle below 10 degrees: "
                "then those and their surroundings, or all if they are many or a size is given, as kerf mesh "
                "does by itself.")
            ->group(option_group::input);
    heed_unit(*command, request->options.input_options);
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but errors.");
    std::vector<std::string> common = {"output",      "size",          "deviation", "size-on",
                                       "chord-error", "feature-angle", "quiet"};
    if (is_wrap) common.insert(common.end(), {"gap", "offset"});
    put_help_last(*command, option_group::output, common);
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return remesh_and_tell(*request); }); });
}

}  // namespace

void add_remesh_command(CLI::App& kerf, int& exit_code) { add_surface_command(kerf, exit_code, false); }
void add_wrap_command(CLI::App& kerf, int& exit_code) { add_surface_command(kerf, exit_code, true); }

}  // namespace kerf

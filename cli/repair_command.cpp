// kerf repair: a surface with all repairs that were asked for, and a report of each.
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "cli/progress.h"
#include "files/io/standard_streams.h"
#include "help/program_help.h"
#include "run/prepare/repaired_file.h"
#include "run/report/repair_json.h"
#include "run/report/repair_text.h"

namespace kerf {

namespace {

struct RepairRequest {
    std::vector<std::string> files;
    std::string path, output;  // the first of the files
    InputOptions options;
    bool json = false, quiet = false;
};

int repair_and_tell(const RepairRequest& request) {
    RepairedFile repaired;
    {
        ProgressLine progress(request.quiet, nullptr);
        repaired = repair_file(request.path, request.options, request.output, &progress);
    }
    if (request.json)
        print_data(to_json(repaired));
    else if (!request.quiet)
        tell(to_text(repaired));
    return repaired.exit_code();
}

}  // namespace

void add_repair_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<RepairRequest>();
    request->options.repairs.plan = "full";
    CLI::App* command = kerf.add_subcommand("repair", "Repair a surface, and say each step.");
    command->add_option("input", request->files, "Surface files, a body each if there are several.")
        ->required()
        ->type_name("INPUT");
    command->option_defaults()->group(option_group::output);
    add_surface_output(*command, request->output);
    add_input_options(*command, request->options);
    command->get_option("--repair")
        ->description(
            "What is done: exact (points move only to part what touches), near (within a bound), full (crossings, "
            "too), or steps by name, as weld,stitch,holes=200. Default full.");
    command->add_flag("--json", request->json, "Print what was done as JSON.");
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but errors.");
    put_help_last(*command, option_group::output, {"output", "repair", "cap", "thicken", "json", "quiet"});
    command->callback([=, &exit_code] {
        take_inputs(request->files, request->path, request->options);
        exit_code = run_on_first_rank([&] { return repair_and_tell(*request); });
    });
}

}  // namespace kerf

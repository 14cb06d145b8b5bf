// kerf repair: what can be mended of a surface is, and is said.
#include <memory>

#include <fmt/format.h>

#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "help/program_help.h"
#include "io/standard_streams.h"
#include "prepare/repaired_file.h"

namespace kerf {

namespace {

struct RepairRequest {
    std::string input, output;
    InputOptions options;
    bool quiet = false;
};

int repair_and_tell(const RepairRequest& request) {
    const RepairedFile repaired = repair_file(request.input, request.options, request.output);
    const CheckedSoup& checked = repaired.checked;
    const bool is_clean = checked.diagnosis.clean();
    if (!request.quiet) {
        tell(to_text(checked.ladder));
        tell(fmt::format("kerf: {}: {} facets. {}\n", request.output, checked.soup.facets.size(),
                         is_clean ? "It can be meshed." : checked.diagnosis.summary(checked.soup)));
    }
    return is_clean ? 0 : static_cast<int>(ErrorCode::input);
}

}  // namespace

void add_repair_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<RepairRequest>();
    request->options.repair = "full";
    CLI::App* command = kerf.add_subcommand("repair", "Repair a surface, and say each step.");
    command->add_option("input", request->input, "Surface file.")->required()->type_name("INPUT");
    command->option_defaults()->group(option_group::output);
    command->add_option("-o,--output", request->output, "Surface, .obj (with patches) or .stl.")
        ->required()
        ->type_name("FILE");
    add_input_options(*command, request->options);
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but errors.");
    put_help_last(*command, option_group::output, {"output", "repair", "quiet"});
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return repair_and_tell(*request); }); });
}

}  // namespace kerf

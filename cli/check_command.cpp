// kerf check: the defects of a surface, or its patches or regions.
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/option_flags.h"
#include "files/io/offenders_writer.h"
#include "files/io/output_file.h"
#include "files/io/standard_streams.h"
#include "help/program_help.h"
#include "run/report/file_diagnosis.h"

namespace kerf {

namespace {

struct CheckRequest {
    std::vector<std::string> files;
    std::string path;  // the first of the files
    InputOptions options;
    double needle_angle_deg = 1;
    bool json = false;
    bool list_patches = false, list_regions = false;  // printed in place of the diagnosis
    std::string offenders_file;                       // empty: none
};

int print_patches(FileDiagnosis found, const InputOptions& options) {
    const std::vector<PatchSummary> patches = patches_of_run(std::move(found), options);
    std::vector<std::string> names;
    for (const PatchSummary& patch : patches) names.push_back(patch.name);
    const std::string spellings = spellings_text(names);
    print_data(to_text(patches) + (spellings.empty() ? "" : "\n" + spellings));
    return 0;
}

int check_surface(const CheckRequest& request) {
    refuse_to_overwrite(request.path, "--offenders", request.offenders_file);
    require_writable("--offenders", request.offenders_file, output_kind::vtu);
    FileDiagnosis found = diagnose_file(request.path, request.options, request.needle_angle_deg);
    if (request.list_regions) {
        print_data(tables_of_regions(found));
        return 0;
    }
    if (request.list_patches && !found.refused) return print_patches(std::move(found), request.options);
    const Diagnosis& diagnosis = found.checked.diagnosis;
    if (!found.refused && !diagnosis.clean()) found.remedy = find_remedy(request.path, request.options, found.checked);
    if (!request.offenders_file.empty() && !found.refused)
        write_offenders(request.offenders_file, found.checked.soup, diagnosis);
    if (request.json)
        print_data(to_json(found));
    else if (diagnosis.defects.size() > 1)
        print_data(to_text(found) + "--json lists all, --offenders FILE.vtu shows them in ParaView.\n");
    else
        print_data(to_text(found));
    return found.exit_code();
}

}  // namespace

void add_check_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<CheckRequest>();
    CLI::App* command = kerf.add_subcommand("check", "Diagnose a surface without meshing it.");
    command->add_option("input", request->files, "Surface files, a region each if there are several.")
        ->required()
        ->type_name("INPUT");
    add_input_options(*command, request->options);
    command->option_defaults()->group(option_group::output);
    command->add_flag("--json", request->json, "Print every defect as JSON.");
    command->add_flag("--list-patches", request->list_patches,
                      "Print patches, and how formats spell them; no diagnosis.");
    command->add_flag("--list-regions", request->list_regions,
                      "Print regions and their walls as tables; no diagnosis.");
    command->add_option("--offenders", request->offenders_file, "Write the offending facets, edges and places as VTU.")
        ->type_name("FILE");
    for (const char* name : {"--json", "--offenders"})
        for (const char* list : {"--list-patches", "--list-regions"})
            command->get_option(list)->excludes(command->get_option(name));
    command->get_option("--list-regions")->excludes(command->get_option("--list-patches"));
    add_option_field(*command, {"needle-angle", "", option_group::output, "DEG",
                                "Degrees below which a facet is a needle. Default 1.", &request->needle_angle_deg, true,
                                needle_angle_range});
    put_help_last(
        *command, option_group::output,
        {"json", "list-patches", "list-regions", "offenders", "weld", "fill-holes", "keep-largest", "feature-angle"});
    command->callback([=, &exit_code] {
        take_inputs(request->files, request->path, request->options);
        exit_code = run_on_first_rank([&] { return check_surface(*request); });
    });
}

}  // namespace kerf

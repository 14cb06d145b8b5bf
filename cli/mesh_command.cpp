// kerf mesh and kerf decompose: their options.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "cli/mesh_request.h"
#include "cli/mesh_run.h"
#include "cli/option_flags.h"
#include "help/program_help.h"
#include "run/request/saved_run.h"

namespace kerf {

namespace {

int run_request(const CLI::App& command, MeshRequest& request) {
    if (!request.resume.empty() && is_complete_run(request.resume))
        return tell_answer({0, fmt::format("kerf: {} is complete: nothing waits to be done.\n", request.resume)});
    settle_request(command, request);
    if (request.print_config) return tell_answer({0, config_text(request)});
    return mesh_on_ranks(request);
}

CLI::App* add_command(CLI::App& kerf, const char* name, const char* text, const std::shared_ptr<MeshRequest>& request,
                      int& exit_code) {
    CLI::App* command = kerf.add_subcommand(name, text);
    command
        ->add_option("input", request->inputs,
                     "Closed surfaces, a region each if there are several: STL, OBJ, PLY, OFF, .msh, .vtu, .vtp, .vtk, "
                     ".mesh, .smesh or .poly, CAD file: STEP, IGES, BREP, "
                     "or 3MF; also as .gz or .zst.")
        ->type_name("INPUT");
    add_run_options(*command, request->options);
    for (const OptionField& field : program_fields(*request)) add_option_field(*command, field);
    command->option_defaults()->group(option_group::running);
    command->add_flag("--print-config", request->print_config, "Print the options as a config file and end.");
    command
        ->add_option("--config", request->config_file,
                     "Read options from a TOML file, but for those of files to be written; the command line wins.")
        ->type_name("FILE");
    command->callback([=, &exit_code] { exit_code = run_request(*command, *request); });
    return command;
}

}  // namespace

void add_mesh_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<MeshRequest>();
    CLI::App* command =
        add_command(kerf, "mesh", "Decompose, mesh every part, verify, write, report.", request, exit_code);
    CLI::Option* resume =
        command
            ->add_option("--resume", request->resume,
                         "Finish the run into this folder, or DIR.kerf-partial, that was interrupted, "
                         "with its options.")
            ->type_name("DIR");
    for (const char* name : {"input", "--output", "--config"}) resume->excludes(command->get_option(name));
    command->add_flag("--dry-run", request->options.dry_run,
                      "Cut, print what every part will take, and end; write nothing.");
    put_help_last(*command, option_group::running,
                  {"output", "parts", "size", "cells", "fineness", "surface", "feature-angle", "format", "workers",
                   "memory", "resume", "dry-run", "quiet", "verbose"});
}

void add_decompose_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<MeshRequest>();
    request->options.volume = false;
    CLI::App* command = add_command(
        kerf, "decompose", "The same, up to the closed surfaces of the parts; print the tree.", request, exit_code);
    put_help_last(*command, option_group::running,
                  {"output", "parts", "size", "surface", "feature-angle", "stl", "workers", "trace", "config", "quiet",
                   "verbose"});
}

}  // namespace kerf

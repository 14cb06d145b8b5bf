// kerf verify: a finished run, checked again from its files.
#include <memory>

#include <CLI/CLI.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "files/io/standard_streams.h"
#include "run/run/verify_folder.h"

namespace kerf {

namespace {

struct VerifyRequest {
    std::string folder;
    VerifyOptions options;
    bool json = false;
    bool quiet = false;  // nothing where every law holds
};

int verify_run(const VerifyRequest& request) {
    const FolderVerification found = verify_folder(request.folder, request.options);
    if (request.json)
        print_data(to_json(found, request.folder, request.options));
    else if (!request.quiet || found.exit_code() != 0)
        print_data(to_text(found, request.folder, request.options));
    return found.exit_code();
}

}  // namespace

void add_verify_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<VerifyRequest>();
    CLI::App* command = kerf.add_subcommand("verify", "Check every law of a finished run again, from its files.");
    command->add_option("folder", request->folder, "Folder of the run, or of a solution on it.")
        ->required()
        ->type_name("DIR");
    command
        ->add_option("--input", request->options.input, "Where the surface is now. Default: where the run has read it.")
        ->type_name("FILE");
    command
        ->add_flag("--without-input", request->options.without_input,
                   "The laws of the mesh are enough: the surface is not there any more.")
        ->excludes("--input");
    command->add_flag("--json", request->json, "Print what was found as JSON.");
    command->add_flag("-q,--quiet", request->quiet, "Print nothing but laws that do not hold.");
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return verify_run(*request); }); });
}

}  // namespace kerf

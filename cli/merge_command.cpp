// kerf merge: a finished run as one mesh.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "export/merged_file.h"
#include "help/usage_error.h"
#include "io/standard_streams.h"

namespace kerf {

namespace {

int merge_and_tell(const MergeRequest& request) {
    const MergedFile merged = merge_run(request);
    tell(fmt::format("kerf: {}: {} vertices, {} tetrahedra, {:.1f} MB\n", request.output, merged.vertices, merged.tets,
                     static_cast<double>(merged.bytes) * 1e-6));
    return 0;
}

}  // namespace

void add_merge_command(CLI::App& kerf, int& exit_code) {
    const auto request = std::make_shared<MergeRequest>();
    CLI::App* command = kerf.add_subcommand("merge", "Write a finished run as one mesh.");
    command->add_option("folder", request->folder, "Folder of the run, or of a solution, with its values.")
        ->required()
        ->type_name("DIR");
    command->add_option("-o,--output", request->output, "File, whose ending chooses the format.")
        ->required()
        ->type_name("FILE");
    command->add_option("--msh-version", request->options.msh_version, "Of Gmsh's files: 4.1 or 2.2.")
        ->type_name("V")
        ->check(one_of("4.1,2.2"));
    command->add_flag("--msh-ascii", request->msh_ascii, "Write them as text instead of binary.");
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return merge_and_tell(*request); }); });
}

}  // namespace kerf

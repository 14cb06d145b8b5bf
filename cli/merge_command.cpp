// kerf merge: a finished run as one mesh.
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/answer.h"
#include "cli/commands.h"
#include "files/export/merged_file.h"
#include "files/io/json.h"
#include "files/io/path_text.h"
#include "files/io/standard_streams.h"
#include "help/number_option.h"
#include "help/usage_error.h"

namespace kerf {

namespace {

struct MergeLine {
    MergeRequest request;
    bool json = false, quiet = false;
};

int merge_and_tell(const MergeLine& line) {
    const MergedFile merged = merge_run(line.request);
    if (line.json) {
        const nlohmann::ordered_json json = {{"output", path_text(line.request.output)},
                                             {"vertices", merged.vertices},
                                             {"nodes", merged.nodes},
                                             {"tets", merged.tets},
                                             {"bytes", merged.bytes}};
        print_data(json_text(json, 2) + "\n");
    } else if (!line.quiet) {
        const std::string nodes = merged.nodes > merged.vertices ? fmt::format(" of {} nodes", merged.nodes) : "";
        tell(fmt::format("kerf: {}: {} vertices{}, {} tetrahedra, {:.1f} MB\n", line.request.output, merged.vertices,
                         nodes, merged.tets, merged.bytes * 1e-6));
        if (!merged.left_out.empty()) tell(fmt::format("kerf: note: {}\n", merged.left_out));
    }
    return 0;
}

}  // namespace

void add_merge_command(CLI::App& kerf, int& exit_code) {
    const auto line = std::make_shared<MergeLine>();
    MergeRequest& request = line->request;
    CLI::App* command = kerf.add_subcommand("merge", "Write a finished run as one mesh.");
    command->add_option("folder", request.folder, "Folder of the run, or of a solution, with its values.")
        ->required()
        ->type_name("DIR");
    command->add_option("-o,--output", request.output, "File, whose ending chooses the format.")
        ->required()
        ->type_name("FILE");
    command->add_option("--msh-version", request.options.msh_version, "Of Gmsh's files: 4.1 or 2.2.")
        ->type_name("V")
        ->check(one_of("4.1,2.2"));
    command->add_flag("--msh-ascii", request.msh_ascii, "Write them as text instead of binary.");
    add_number(*command, "--order", request.order, {"1 or 2", 1, 2},
               "Of the cells: 2 has a node on each edge. Default: that of the run.")
        ->type_name("N");
    command->add_flag("--json", line->json, "Print what was written as JSON.");
    command->add_flag("-q,--quiet", line->quiet, "Print nothing but errors.");
    command->callback([=, &exit_code] { exit_code = run_on_first_rank([&] { return merge_and_tell(*line); }); });
}

}  // namespace kerf

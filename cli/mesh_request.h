// The request that the command line of kerf mesh and kerf decompose makes.
#pragma once

#include <string>
#include <vector>

#include "run/request/run_request.h"

namespace CLI {
class App;
}

namespace kerf {

struct MeshRequest {
    RunRequest options;
    std::vector<std::string> inputs;  ///< input files; those behind the first one become InputOptions::more_files
    bool quiet = false;
    bool verbose = false;       ///< print every node of the tree of cuts, and all that is known of the result
    bool print_config = false;  ///< print the effective options and end
    std::string config_file;    ///< options that the command line does not give; empty: none
    std::string resume;         ///< output folder of an interrupted run that is to be continued; empty: a new run

    // Members that settle_request() sets:
    bool has_usual_output = false;  ///< options.output was not given, and is named by the input
    std::string
        merged_file;  ///< the file into which the run in options.output is merged when it is done; empty: the run stays
};

/// Returns the options of the program itself: output, quiet and verbose.
std::vector<OptionField> program_fields(MeshRequest& request);

/// Returns the request in the form of a config file.
std::string config_text(MeshRequest& request);

/// Completes the request by the config file or the interrupted run, over which the options given to `command` win, and
/// chooses the places of the result. Throws CLI::ParseError if the input is missing, and Error. Changes no files.
void settle_request(const CLI::App& command, MeshRequest& request);

}  // namespace kerf

// What the command line of kerf mesh and kerf decompose asks for.
#pragma once

#include <string>
#include <vector>

#include "request/options.h"

namespace CLI {
class App;
}

namespace kerf {

struct MeshRequest {
    RunOptions options;
    std::vector<std::string> inputs;  ///< files; those behind the first one become InputOptions::more_files
    bool quiet = false;
    bool verbose = false;       ///< print every node of the tree of cuts, and all that is known of the result
    bool print_config = false;  ///< print the effective options and end
    std::string config_file;    ///< options that the command line does not give; empty: none
    std::string resume;         ///< output folder of an interrupted run that is to be continued; empty: a new run

    // Settled by settle_request():
    bool has_usual_output = false;  ///< options.output was not given
    std::string merged_file;        ///< into which the run in options.output is merged when it is done; empty: it stays
};

/// The options of the program itself: output, quiet and verbose.
std::vector<OptionField> program_fields(MeshRequest& request);

/// The request in the form of a config file.
std::string config_text(MeshRequest& request);

/// Adds what the config file or the interrupted run says to what the options of `command` have said, and chooses the
/// places of the result. Throws CLI::ParseError if the input is missing, and Error. Changes no files.
void settle_request(const CLI::App& command, MeshRequest& request);

}  // namespace kerf

// The command line: what the user asked for.
#pragma once

#include <string>
#include <vector>

#include "cli/check.h"
#include "cli/export.h"
#include "cli/merge.h"
#include "cli/quality.h"
#include "request/options.h"
#include "run/verify_folder.h"

namespace kerf {

enum class Command { none, mesh, decompose, check, verify, export_formats, merge, quality, remesh };

struct CommandLine {
    Command command = Command::none;
    RunOptions options;
    bool quiet = false;
    bool verbose = false;           ///< print every node of the tree of cuts, and all that is known of the result
    std::string resume;             ///< output folder of an interrupted run that is to be continued; empty: a new run
    bool has_usual_output = false;  ///< options.output was not given
    std::string merged_file;        ///< into which the run in options.output is merged when it is done; empty: it stays
    CheckRequest check;
    ExportRequest export_request;
    MergeRequest merge;
    VerifyOptions verify;
    QualityRequest quality;
    std::string remeshed_file;  ///< of kerf remesh
    bool print_config = false;  ///< print the effective options and end
    std::string config_file;    ///< options that the command line does not give
    std::string config;         ///< them, in the form of a config file
    bool finished = false;      ///< help or version was asked for, or the usage was wrong: end with exit_code
    int exit_code = 0;
    std::string output;  ///< to print to standard output (exit_code 0) or standard error
};

/// Throws Error for an interrupted run that cannot be read. Parses within milliseconds; reads what --config and
/// --resume name, and changes nothing.
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace kerf

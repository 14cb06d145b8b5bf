// The request of a run, and the one table of its options.
#pragma once

#include <string>
#include <vector>

#include "base/core/user_number.h"
#include "cut/decompose/decomposition.h"
#include "files/io/output_file.h"
#include "fill/volume/mesher.h"
#include "run/request/input_options.h"
#include "run/request/inside/option_field.h"
#include "surface/size/size_options.h"

namespace kerf {

/// Whether the surface is remeshed within a bound before all else (run/prepare/remeshing.h).
enum class Remeshing {
    where_needed,  ///< CAD files, whose facets nobody chose, and others where slivers would spoil the cells
    never,
    always
};

/// The places of nodes on edges of the surface, of order 2.
enum class Curving {
    automatic,  ///< on the surface that the facets approximate, where it is known
    straight    ///< in the middle of the edges
};

/// The workers of a run, and their limits.
struct WorkerOptions {
    std::int32_t count = 0;        ///< processes of each rank; 0: its share of the processors
    double timeout_seconds = 600;  ///< limit of one attempt at one part; 0: none
    std::int64_t memory_mb = 0;    ///< address space of one worker; 0: unlimited
    std::int32_t attempts = 10;    ///< most attempts at one part (fill/volume/retries.h)
    std::string program = {};      ///< path of kerf-worker; empty: the one that find_kerf_program() finds
};

/// The files of a run beside its input and folder, and the content of its folder.
struct OutputOptions {
    std::string report_file;  ///< a copy of the report; empty: only DIR/report.json
    std::string trace_file;   ///< all cuts with their stages (run/run/trace.h); empty: none. Not inside of the folder
    std::string events_file;  ///< path of an EventLog that the caller gives to the run; empty: none
    std::string formats;      ///< names of files/export/format.h with commas between; empty: vtu
    std::string fields;       ///< qualities of cells in vtu files (parse_cell_fields()); empty: min-dihedral
    std::vector<std::string> patch_types;  ///< see parse_patch_types(); for formats that have such types
    bool split_regions = false;            ///< OpenFOAM's case has one mesh for each region
    bool reference = false;                ///< the whole is meshed in one piece as well, and compared
    bool stl = false;                      ///< the surfaces of the parts are written as STL as well

    /// Returns the files beside the folder with their options; paths may be empty.
    std::vector<NamedPath> files() const;
};

/// A run as a user asks for it: a row of the table, or the program that calls, sets each value. Texts are as they were
/// given, lengths may be percentages, and 0 or an empty text leaves a choice to the run, which makes it in two steps:
/// RunChoices has all that follows from the request alone, RunPlan (run/run/plan.h) all that follows from the surface,
/// too.
struct RunRequest {
    std::string input;
    std::string input_hash;  ///< hash of the input that a continued run has read; empty: any
    std::string output;
    std::int32_t parts = 0;  ///< K; 0: see choose_parts()
    FacetPolicy facets = FacetPolicy::split;
    CutChoices cut;
    MesherChoices mesher;
    SizeOptions sizes;
    InputOptions input_options;  ///< options of the surface before all else
    Remeshing remeshing = Remeshing::where_needed;
    Length deviation;  ///< largest distance of a remeshed surface from the input; 0: usual_deviation()
    WorkerOptions workers;
    OutputOptions outputs;
    bool volume = true;            ///< false: stop at the closed surfaces of the parts
    std::int32_t least_parts = 1;  ///< where K follows: one for each rank that takes whole parts later
    bool dry_run = false;          ///< the run stops at the plan, and writes nothing
    bool transient = false;  ///< the listener gets the parts (RunListener::on_meshes()), and `output` is a folder that
                             ///< its owner removes: nothing is written for others, or to outlive a power cut
    std::int32_t order = 1;  ///< order of the cells: 1, or 2 with a node on each edge
    Curving curving = Curving::automatic;

    /// Whether edges of the surface may be curved.
    bool has_curved_edges() const { return order == 2 && curving == Curving::automatic; }
    /// Whether the run meshes its parts.
    bool fills_parts() const { return volume && !dry_run; }
    /// Checks the paths as choices_of() does, for callers that write one of the files before the run. Throws
    /// Error(usage) or Error(io) for input and outputs that are in each other's way.
    void check_files() const;
};

/// Whether an option, such as "trace", names one of these files.
bool names_output(const std::string& option);

/// The range of RunRequest::deviation. remesh_where_asked() also refuses shares of the diagonal that are too large or
/// small.
inline constexpr NumberRange deviation_range = {"a length in units of the input, or with % of its diagonal, or 0", 0,
                                                std::numeric_limits<double>::infinity(), true, true};

/// Returns the fields of the options of the input.
std::vector<OptionField> input_option_fields(InputOptions& options);

/// Returns the fields of the options of sizes.
std::vector<OptionField> size_option_fields(SizeOptions& options);

/// Returns the table of all options: command line, config file, report and viewer show them in this order.
std::vector<OptionField> option_fields(RunRequest& request);

/// Returns the values of the table, or only those that shape the parts.
std::vector<OptionText> option_texts(RunRequest request, bool shapes_parts_only);
/// Sets options to values from option_texts(). Throws Error(usage) for a name or value that this version does not know,
/// naming `source`.
void set_options(RunRequest& request, const std::vector<OptionText>& texts, const std::string& source);

}  // namespace kerf

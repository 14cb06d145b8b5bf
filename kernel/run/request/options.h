// All options of a run, and the one table of them.
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

/// The options of a run.
struct RunOptions {
    std::string input;
    std::string input_hash;  ///< hash of the input that a continued run has read; empty: any
    std::string output;
    std::string worker_program;  ///< path of kerf-worker; empty: the one that find_kerf_program() finds
    DecomposeOptions decompose = {
        .parts = 0, .facets = FacetPolicy::split, .cut = {}};  ///< parts 0: see choose_parts()
    MesherOptions mesher;
    SizeOptions sizes;           ///< sizes of tetrahedra, see with_sizes()
    InputOptions input_options;  ///< options of the surface before all else
    Remeshing remeshing = Remeshing::where_needed;
    Length deviation;              ///< largest distance of a remeshed surface from the input; 0: usual_deviation()
    std::int32_t workers = 0;      ///< processes of each rank; 0: its share of the processors
    double timeout_seconds = 600;  ///< limit of one attempt at one part; 0: none
    std::int64_t memory_mb = 0;    ///< address space of one worker; 0: unlimited
    std::int32_t attempts = 10;    ///< most attempts at one part (fill/volume/retries.h)
    std::string report_file;       ///< a copy of the report; empty: only DIR/report.json
    std::string trace_file;   ///< all cuts with their stages (run/run/trace.h); empty: none. Not inside of `output`
    std::string events_file;  ///< path of an EventLog that the caller gives to the run; empty: none
    std::string formats;      ///< names of files/export/format.h with commas between; empty: vtu
    std::string fields;       ///< qualities of cells in vtu files (parse_cell_fields()); empty: min-dihedral
    std::vector<std::string> patch_types;  ///< see parse_patch_types(); for formats that have such types
    bool reference = false;                ///< the whole is meshed in one piece as well, and compared
    bool stl = false;                      ///< the surfaces of the parts are written as STL as well
    bool volume = true;                    ///< false: stop at the closed surfaces of the parts
    std::int32_t least_parts = 1;          ///< where K follows: one for each rank that takes whole parts later
    bool dry_run = false;                  ///< the run stops at the plan, and writes nothing
    bool split_regions = false;            ///< OpenFOAM's case has one mesh for each region
    bool transient = false;  ///< the listener gets the parts (RunListener::on_meshes()), and `output` is a folder that
                             ///< its owner removes: nothing is written for others, or to outlive a power cut
    std::int32_t order = 1;  ///< order of the cells: 1, or 2 with a node on each edge
    Curving curving = Curving::automatic;

    /// Whether edges of the surface may be curved.
    bool has_curved_edges() const { return order == 2 && curving == Curving::automatic; }
    /// Checks the paths as resolved() does, for callers that write one of the files before the run. Throws Error(usage)
    /// or Error(io) for input and outputs that are in each other's way.
    void check_files() const;
    /// Returns the files beside its folder that the run writes, with their options; paths may be empty.
    std::vector<NamedPath> output_files() const;
};

/// Whether an option, such as "trace", names one of these files.
bool names_output(const std::string& option);

/// Returns the options, all of them checked, with the values that follow from others, K excepted. Throws Error(usage)
/// naming option, value and range, Error(io) for a file that could not be written or would be lost.
RunOptions resolved(RunOptions options, int cores_of_rank = 1);
/// Returns resolved options with lengths in place of percentages of this diagonal, and with the values that follow from
/// these. Throws Error(usage) as resolved() does.
RunOptions with_lengths(RunOptions options, double diagonal);
/// Returns options by which cuts, forecasts and the mesher obey this field. Options of resolved() obey the sizes that
/// `sizes` has for all places alike.
RunOptions with_sizes(RunOptions options, const SizeField& field);

/// Returns resolved options with this edge length everywhere in place of RunOptions::sizes.cells and of the fineness;
/// 0: none.
RunOptions with_size(RunOptions options, double size);

/// Returns the options with the demands of their fineness on cells beside facets that are kept, where no size is given:
/// fine, cells grow from the edges of the surface by SizeOptions::usual_growth, if no growth is given; coarse, the
/// bound of the radius-edge ratio is weaker, 2 in place of the usual one.
RunOptions with_fineness_at_kept_facets(RunOptions options);

/// The range of RunOptions::deviation. remesh_where_asked() also refuses shares of the diagonal that are too large or
/// small.
inline constexpr NumberRange deviation_range = {"a length in units of the input, or with % of its diagonal, or 0", 0,
                                                std::numeric_limits<double>::infinity(), true, true};

/// Returns the fields of the options of the input.
std::vector<OptionField> input_option_fields(InputOptions& options);

/// Returns the fields of the options of sizes.
std::vector<OptionField> size_option_fields(SizeOptions& options);

/// Returns the table of all options: command line, config file, report and viewer show them in this order.
std::vector<OptionField> option_fields(RunOptions& options);

/// Returns the values of the table, or only those that shape the parts.
std::vector<OptionText> option_texts(RunOptions options, bool shapes_parts_only);
/// Sets options to values from option_texts(). Throws Error(usage) for a name or value that this version does not know,
/// naming `source`.
void set_options(RunOptions& options, const std::vector<OptionText>& texts, const std::string& source);

}  // namespace kerf

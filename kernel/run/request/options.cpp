// Options are resolved in stages, each a function that returns other options: resolved() checks all and fills in values
// that follow from others, before any file is read; with_lengths() turns percentages into lengths once the diagonal is
// known; with_sizes() hands the size field to cuts, loads and mesher. Sizes that are the same everywhere become a
// constant field of a volume at once, unless they are a percentage.
//
// check_files() refuses every path by which a run would destroy its own input or another of its outputs, before any
// work. A run that is continued has its output folder already, which is told by `input_hash`.
#include "run/request/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/export/format.h"
#include "files/io/run_folder.h"
#include "files/part/vtu_writer.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

constexpr std::int64_t bytes_per_interface_point = 500;
constexpr double coarse_radius_edge = 2;

// Returns the seed of NAME=x,y,z; the name may have any character, and the last = counts.
RegionSeed seed_of(const std::string& text) {
    const std::size_t mark = text.rfind('=');
    RegionSeed seed{text.substr(0, mark), Vec3::Zero()};
    const char *at = text.data() + (mark == std::string::npos ? text.size() : mark + 1), *const end =
                                                                                             text.data() + text.size();
    bool is_point = !seed.name.empty();
    for (int i = 0; i < 3 && is_point; ++i) {
        const auto [stop, error] = std::from_chars(at, end, seed.point[i]);
        is_point =
            error == std::errc() && std::isfinite(seed.point[i]) && (i < 2 ? stop < end && *stop == ',' : stop == end);
        at = stop + (i < 2);
    }
    if (!is_point)
        throw Error(ErrorCode::usage, fmt::format("'{}' is no value of --region. It has the form NAME=x,y,z, such as "
                                                  "cement=0,1.5,-2; coordinates are in units after --scale.",
                                                  text));
    return seed;
}

RunOptions with_constant_size(RunOptions options) {
    options.sizes.max_volume = options.sizes.constant_max_volume();
    const SizeField field(options.sizes.max_volume);
    return with_sizes(std::move(options), field);
}

}  // namespace

void take_inputs(const std::vector<std::string>& files, std::string& input, InputOptions& options) {
    if (files.empty()) return;
    input = files[0];
    options.more_files.insert(options.more_files.begin(), files.begin() + 1, files.end());
}

std::vector<std::string> files_of(const std::string& input, const InputOptions& options) {
    std::vector<std::string> files = {input};
    files.insert(files.end(), options.more_files.begin(), options.more_files.end());
    return files;
}

RepairPlan repair_plan_of(const InputOptions& options) {
    const RepairOptions& asked = options.repairs;
    RepairPlan plan = parse_repair_plan("repair", asked.plan);
    plan.are_walls = !options.regions.empty();
    plan.voids_are_parity = options.voids == Voids::parity;
    if (asked.weld_tolerance.number() > 0) plan.put({RepairKind::merge, asked.weld_tolerance});
    if (asked.keep_largest) plan.put({RepairKind::largest});
    if (asked.fill_hole_edges > 0) plan.put({RepairKind::span, Length(asked.fill_hole_edges)});
    if (asked.cap) plan.put({RepairKind::caps});
    if (asked.thicken.number() > 0) plan.put({RepairKind::thicken, asked.thicken});
    return plan;
}

InputOptions without_repairs(InputOptions options) {
    options.repairs = {};
    options.wrap = false;
    options.wrapping = {};
    return options;
}

std::vector<RegionSeed> seeds_of(const InputOptions& options) {
    std::vector<RegionSeed> seeds;
    for (const std::string& text : options.regions) seeds.push_back(seed_of(text));
    return seeds;
}

RunOptions resolved(RunOptions options, int cores_of_rank) {
    for (const OptionField& field : option_fields(options)) field.check();
    seeds_of(options.input_options);
    if (options.workers == 0) options.workers = std::max(1, cores_of_rank);
    options.decompose.threads = options.workers;  // which have nothing to do yet
    options.sizes.check();
    check_mesher_options(options.mesher);
    if (options.decompose.facets == FacetPolicy::keep && options.decompose.cut.contour == ContourMethod::straight)
        throw Error(ErrorCode::usage, "--contour straight splits facets, and --surface keep forbids it. Drop one.");
    if (options.formats.empty()) options.formats = "vtu";
    const std::vector<const Format*> formats = parse_formats(options.formats);
    for (const Format* format : formats) require_order(*format, options.order);
    if (options.fields.empty()) options.fields = "min-dihedral";
    parse_cell_fields(options.fields);
    parse_patch_types(options.patch_types);
    if (options.split_regions && std::find(formats.begin(), formats.end(), &find_format("openfoam")) == formats.end())
        throw Error(ErrorCode::usage, "--split-regions is for the format openfoam, which --format does not name.");
    options.check_files();
    options.input_options.cad.on_faces = options.has_curved_edges();
    for (std::string& file : options.input_options.more_files) file = std::filesystem::absolute(file).string();
    std::string& field_file = options.sizes.field_file;
    if (!field_file.empty()) field_file = std::filesystem::absolute(field_file).string();
    if (options.memory_mb > 0)
        options.decompose.cut.max_interface_points = (options.memory_mb << 20) / bytes_per_interface_point;
    return options.sizes.size.is_percent() ? options : with_constant_size(std::move(options));
}

RunOptions with_lengths(RunOptions options, double diagonal) {
    const bool has_percentage = options.sizes.size.is_percent();
    options.deviation = options.deviation.of(diagonal);
    options.sizes.resolve_lengths(diagonal);
    options.sizes.check();
    return has_percentage ? with_constant_size(std::move(options)) : options;
}

RunOptions with_size(RunOptions options, double size) {
    options.sizes.cells = 0;
    options.sizes.fineness = Fineness::medium;
    options.sizes.size = size;
    return with_constant_size(std::move(options));
}

RunOptions with_fineness_at_kept_facets(RunOptions options) {
    SizeOptions& sizes = options.sizes;
    double& radius_edge = options.mesher.radius_edge;
    if (!sizes.follow_fineness()) return options;
    if (sizes.fineness == Fineness::fine && sizes.growth == 0) sizes.growth = SizeOptions::usual_growth;
    if (sizes.fineness == Fineness::coarse && radius_edge == MesherOptions().radius_edge)
        radius_edge = coarse_radius_edge;
    return options;
}

// Hands the field to cuts, loads and mesher; loads weigh it as the mesher does.
RunOptions with_sizes(RunOptions options, const SizeField& field) {
    options.decompose.cut.size = options.decompose.cut.load.size = options.mesher.size = field;
    options.decompose.cut.load.volume_weight = find_mesher(options.mesher.name).forecast.volume_weight;
    return options;
}

std::vector<NamedPath> RunOptions::output_files() const {
    return {{"--trace", trace_file, output_kind::trace},
            {"--events", events_file, output_kind::events},
            {"--report", report_file, output_kind::report}};
}

bool names_output(const std::string& option) {
    const std::vector<NamedPath> outputs = RunOptions().output_files();
    return std::any_of(outputs.begin(), outputs.end(),
                       [&](const NamedPath& output) { return output.option == "--" + option; });
}

// Checks all that can be known of the files before any work.
void RunOptions::check_files() const {
    const std::vector<std::string> folders =
        dry_run || output.empty() ? std::vector<std::string>() : RunFolder::folders_of(output);
    const auto is_in_the_way = [&](const std::string& file) {
        return std::any_of(folders.begin(), folders.end(),
                           [&](const std::string& folder) { return lies_inside(file, folder); });
    };
    if (!folders.empty() && input_hash.empty()) refuse_file_name("--output", output);  // a resumed run has begun there
    if (is_in_the_way(input))
        throw Error(ErrorCode::io,
                    fmt::format("The input {} lies in the output folder {}, which is replaced as a whole "
                                "when the run ends. Choose another output folder.",
                                input, output));
    for (const auto& [option, file, kind] : output_files()) {
        if (file.empty() || file.starts_with("fd:")) continue;
        if (is_in_the_way(file))
            throw Error(ErrorCode::usage, fmt::format("{} is {}, which lies in the output folder {}. That is replaced "
                                                      "as a whole when the run ends, so choose a place outside of it.",
                                                      option, file, output));
        refuse_to_overwrite(input, option, file);
        refuse_to_overwrite(sizes.field_file, option, file);
        require_writable(option, file, kind);
    }
    refuse_same_outputs(output_files());
}

}  // namespace kerf

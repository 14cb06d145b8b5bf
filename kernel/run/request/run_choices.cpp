// choices_of() checks all of a request before any file is read: each value by the row of its option, then what options
// forbid each other, then texts by parsing them, then paths.
#include "run/request/run_choices.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "base/core/error.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

constexpr std::int64_t bytes_per_interface_point = 500;

void make_absolute(std::string& file) {
    if (!file.empty()) file = std::filesystem::absolute(file).string();
}

}  // namespace

bool RunChoices::has_format(const char* name) const {
    return std::find(formats.begin(), formats.end(), &find_format(name)) != formats.end();
}

DecomposeOptions RunChoices::decompose_options(const SizeField& size, const RegionSizes& region_sizes) const {
    DecomposeOptions options{request.parts, request.facets, CutOptions(request.cut, size), request.workers.count,
                             region_sizes};
    options.cut.volume_weight = find_mesher(request.mesher.name).forecast.volume_weight;
    if (const std::int64_t memory_mb = request.workers.memory_mb; memory_mb > 0)
        options.cut.max_interface_points = (memory_mb << 20) / bytes_per_interface_point;
    return options;
}

RunChoices choices_of(RunRequest request, int cores_of_rank) {
    for (const OptionField& field : option_fields(request)) field.check();
    RunChoices choices;
    choices.input = request.input_options;
    if (request.workers.count == 0) request.workers.count = std::max(1, cores_of_rank);
    request.sizes.check();
    request.input_options.air.check();
    if (request.sizes.cells > 0 && request.input_options.air.encloses())
        throw Error(ErrorCode::usage,
                    "--cells finds one size for all, but air around a body has fine cells beside it and coarse ones "
                    "elsewhere. Give --box-size, and --size-on for the body, in its place.");
    check_mesher_options(request.mesher);
    if (request.facets == FacetPolicy::keep && request.cut.contour == ContourMethod::straight)
        throw Error(ErrorCode::usage, "--contour straight splits facets, and --surface keep forbids it. Drop one.");
    OutputOptions& outputs = request.outputs;
    if (outputs.formats.empty()) outputs.formats = "vtu";
    choices.formats = parse_formats(outputs.formats);
    for (const Format* format : choices.formats) require_order(*format, request.order);
    if (outputs.fields.empty()) outputs.fields = "min-dihedral";
    choices.fields = parse_cell_fields(outputs.fields);
    choices.patch_types = parse_patch_types(outputs.patch_types);
    if (outputs.split_regions && !choices.has_format("openfoam"))
        throw Error(ErrorCode::usage, "--split-regions is for the format openfoam, which --format does not name.");
    request.check_files();
    request.input_options.cad.on_faces = request.has_curved_edges();
    for (std::string& file : request.input_options.more_files) make_absolute(file);
    make_absolute(request.sizes.field_file);
    choices.input.options = request.input_options;
    choices.request = std::move(request);
    return choices;
}

}  // namespace kerf

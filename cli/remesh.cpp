#include "cli/remesh.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/progress.h"
#include "core/error.h"
#include "io/obj_writer.h"
#include "io/output_file.h"
#include "io/standard_streams.h"
#include "io/stl_writer.h"
#include "prepare/remeshing.h"
#include "report/report.h"

namespace kerf {

namespace {

Input read_and_remesh(const RunOptions& options, bool quiet) {
    ProgressLine progress(quiet, nullptr);
    Input input = read_input(options.input, options.input_options);
    const RunOptions with_units = with_lengths(options, input.diagonal);
    return remesh_where_asked(std::move(input), with_units, &progress);
}

}  // namespace

int remesh_surface(RunOptions options, const std::string& output, bool quiet) {
    const std::string ending = std::filesystem::path(output).extension().string();
    if (ending != ".obj" && ending != ".stl")
        throw Error(ErrorCode::usage, fmt::format("--output is {}, but surfaces are written as .obj or .stl.", output));
    refuse_to_overwrite(options.input, "--output", output);
    require_writable("--output", output);
    options.remeshing = Remeshing::always;
    options.input_options.check();
    options.sizes.check();
    const Input input = read_and_remesh(options, quiet);
    const SurfaceArrays surface = input.surface.arrays();
    if (ending == ".obj")
        write_obj(output, surface.vertices, surface.facets, surface.patch, input.patch_names);
    else
        write_stl(output, surface.vertices, surface.facets);
    if (!quiet)
        tell(fmt::format("kerf: {}: {} facets, {}\n", output, surface.facets.size(), remeshing_text(*input.remeshed)));
    return 0;
}

}  // namespace kerf

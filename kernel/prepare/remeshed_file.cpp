#include "prepare/remeshed_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "io/obj_writer.h"
#include "io/output_file.h"
#include "io/stl_writer.h"

namespace kerf {

RemeshedFile remesh_file(RunOptions options, const std::string& output, StageListener* listener) {
    const std::string ending = std::filesystem::path(output).extension().string();
    if (ending != ".obj" && ending != ".stl")
        throw Error(ErrorCode::usage, fmt::format("--output is {}, but surfaces are written as .obj or .stl.", output));
    refuse_to_overwrite(options.input, "--output", output);
    require_writable("--output", output);
    options.remeshing = Remeshing::always;
    options.input_options.check();
    options.sizes.check();
    Input input = read_input(options.input, options.input_options);
    options = with_lengths(std::move(options), input.diagonal);
    const SizedInput sized = remesh_and_size(std::move(input), options, listener);
    const SurfaceArrays surface = sized.input.complex.arrays();
    if (ending == ".obj")
        write_obj(output, surface.vertices, surface.facets, surface.patch, sized.input.patch_names);
    else
        write_stl(output, surface.vertices, surface.facets);
    return {static_cast<std::int64_t>(surface.facets.size()), *sized.input.remeshed, sized.found};
}

}  // namespace kerf

#include "prepare/remeshed_file.h"

#include <filesystem>

#include <fmt/format.h>

#include "core/error.h"
#include "io/obj_writer.h"
#include "io/output_file.h"
#include "io/stl_writer.h"

namespace kerf {

namespace {

// A closed group of facets for each region, so that a wall is there twice: read as bodies that touch.
void write_regions(const std::string& path, const Complex& complex) {
    const SurfaceArrays all = complex.arrays();
    std::vector<Triangle> facets;
    std::vector<std::int32_t> region_of_facet;
    for (std::int32_t r = 0; r < complex.region_count(); ++r)
        for (std::int32_t f = 0; f < complex.facet_count(); ++f) {
            const auto [front, back] = complex.sides(f);
            const auto& [a, b, c] = all.facets[static_cast<std::size_t>(f)];
            if (front != r && back != r) continue;
            facets.push_back(back == r ? Triangle{a, b, c} : Triangle{a, c, b});
            region_of_facet.push_back(r);
        }
    write_obj(path, all.vertices, facets, region_of_facet,
              {complex.region_names().begin(), complex.region_names().end()});
}

}  // namespace

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
    const std::int32_t regions = input.complex.region_count();
    if (regions > 1 && ending == ".stl")
        throw Error(ErrorCode::usage, fmt::format("{} has {} regions, which an .stl cannot tell apart. Write an .obj.",
                                                  options.input, regions));
    const SizedInput sized = remesh_and_size(std::move(input), options, listener);
    const SurfaceArrays surface = sized.input.complex.arrays();
    if (regions > 1)
        write_regions(output, sized.input.complex);
    else if (ending == ".obj")
        write_obj(output, surface.vertices, surface.facets, surface.patch, sized.input.patch_names);
    else
        write_stl(output, surface.vertices, surface.facets);
    return {static_cast<std::int64_t>(surface.facets.size()), *sized.input.remeshed, sized.found};
}

}  // namespace kerf

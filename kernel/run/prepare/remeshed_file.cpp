#include "run/prepare/remeshed_file.h"

#include "files/io/output_file.h"
#include "run/prepare/surface_file.h"

namespace kerf {

namespace {

// Lengths may be shares of the diagonal.
SizedInput remesh_as(Remeshing how, Input input, RunRequest options, StageListener* listener) {
    options.remeshing = how;
    options.deviation = options.deviation.of(input.body_diagonal());
    options.sizes.resolve_lengths(input.body_diagonal());
    return remesh_and_size(std::move(input), options, listener);
}

}  // namespace

RemeshedFile remesh_file(RunRequest options, const std::string& output, StageListener* listener, Remeshing how) {
    require_surface_file("--output", output);
    refuse_to_overwrite(options.input, "--output", output);
    require_writable("--output", output, output_kind::surface);
    options.input_options.check();
    options.sizes.check();
    Input input = read_input(options.input, options.input_options, listener);
    require_surface_file("--output", output, input.complex.region_count());
    const SizedInput sized = remesh_as(how, std::move(input), std::move(options), listener);
    write_surface(output, sized.input.complex, sized.input.patch_names);
    return {sized.input.complex.facet_count(), sized.input.remeshed, sized.found, sized.input.wrapped,
            sized.input.notes};
}

SizedInput remesh_always(Input input, RunRequest options, StageListener* listener) {
    return remesh_as(Remeshing::always, std::move(input), std::move(options), listener);
}

}  // namespace kerf

// The options of a traced run.
#pragma once

#include "prepare/size_reader.h"
#include "run/trace.h"

namespace kerf::test {

/// With them and the surface of the trace the same cuts can be made again. Throws Error(usage) for a name or value that
/// this version does not have.
inline RunOptions options_of(const Trace& trace) {
    RunOptions options;
    set_options(options, trace.options, "The trace of " + trace.input);
    options.input = trace.input;
    options.resolve(1);
    if (options.sizes.depends_on_place())
        options.use_sizes(read_size_field(options.sizes, trace.surface, trace.patch_names));
    return options;
}

}  // namespace kerf::test

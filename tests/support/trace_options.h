// The options of a traced run.
#pragma once

#include "run/prepare/size_reader.h"
#include "run/run/trace.h"

namespace kerf::test {

/// With them and the surface of the trace the same cuts can be made again. Throws Error(usage) for a name or value that
/// this version does not have.
inline RunOptions options_of(const Trace& trace) {
    RunOptions options;
    set_options(options, trace.options, "The trace of " + trace.input);
    options.input = trace.input;
    return with_sizes_on(resolved(std::move(options)), trace.surface, trace.patch_names);
}

}  // namespace kerf::test

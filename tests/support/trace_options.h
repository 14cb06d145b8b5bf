// The options of a traced run.
#pragma once

#include "run/prepare/size_reader.h"
#include "run/request/run_choices.h"
#include "run/run/trace.h"

namespace kerf::test {

/// Returns the request of the run. Throws Error(usage) for a name or value that this version does not have.
inline RunRequest request_of(const Trace& trace) {
    RunRequest request;
    set_options(request, trace.options, "The trace of " + trace.input);
    request.input = trace.input;
    return request;
}

/// Returns the options with which the same cuts can be made of the surface of the trace again. Throws as request_of().
inline DecomposeOptions options_of(const Trace& trace) {
    const RunChoices choices = choices_of(request_of(trace));
    return choices.decompose_options(read_size_field(choices.request.sizes, trace.surface, trace.patch_names));
}

}  // namespace kerf::test

// The options of a traced run.
#pragma once

#include "run/prepare/size_reader.h"
#include "run/request/run_choices.h"
#include "run/run/trace.h"

namespace kerf::test {

/// Returns the options with which the same cuts can be made of the surface of the trace again. Throws Error(usage) for
/// a name or value that this version does not have.
inline DecomposeOptions options_of(const Trace& trace) {
    RunRequest request;
    set_options(request, trace.options, "The trace of " + trace.input);
    request.input = trace.input;
    const RunChoices choices = choices_of(std::move(request));
    return choices.decompose_options(read_size_field(choices.request.sizes, trace.surface, trace.patch_names));
}

}  // namespace kerf::test

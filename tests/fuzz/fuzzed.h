// What every fuzzer asks of the code that it drives.
#pragma once

#include <cstdlib>
#include <iostream>

#include "base/core/error.h"

namespace kerf::test {

/// Runs `action`; an error that does not blame the file ends the process, which is a finding. All other exceptions do
/// so by themselves.
template <class Action>
void run_fuzzed(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        if (error.code() == ErrorCode::input || error.code() == ErrorCode::io) return;
        std::cerr << "not an error of the file: " << error.what() << "\n";
        std::abort();
    }
}

}  // namespace kerf::test

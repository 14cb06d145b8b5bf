// The ways in which a surface is filled without TetGen, each told apart from what it does to the process.
#pragma once

#include <span>
#include <string>

#include "surface/complex/surface.h"

namespace kerf::bench {

/// What became of a surface.
struct Outcome {
    std::string failure;  ///< why, in a sentence; empty where all facets were recovered and all laws hold
    std::string remark;   ///< what was made
    double seconds = 0;   ///< of the processor
};

struct RecoveryPass {
    const char* name;
    Outcome (*fill)(const SurfaceArrays& surface);  ///< its failure may be an exception, too, or the end of the process
};

std::span<const RecoveryPass> recovery_passes();

/// The pass in a process of its own, which is ended after ten seconds.
Outcome outcome_in_child(const RecoveryPass& pass, const SurfaceArrays& surface);

}  // namespace kerf::bench

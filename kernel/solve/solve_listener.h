// How a solution tells of its progress.
#pragma once

#include <cstdint>

#include "report/listener.h"

namespace kerf {

/// Stages are "read", "number", "conditions", "assemble", "setup" (of the preconditioner), "solve", "modes", "recover"
/// and "write".
class SolveListener : public RunListener {
 public:
    /// How many equations there are, when that is known; only on the root rank.
    virtual void on_equations(std::int64_t /*unknowns*/) {}
};

}  // namespace kerf

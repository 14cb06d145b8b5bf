// The listener to the progress of a solution.
#pragma once

#include <cstdint>

#include "run/report/listener.h"

namespace kerf {

/// A listener whose stages are "read", "number", "conditions", "assemble", "setup" (of the preconditioner), "solve",
/// "modes", "recover" and "write".
class SolveListener : public RunListener {
 public:
    /// Called with the number of equations, once that is known; only on the root rank.
    virtual void on_equations(std::int64_t /*unknowns*/) {}
};

}  // namespace kerf

// The options of PETSc that a case may have: people send cases to each other, so that they must do no harm.
#pragma once

#include <string>

namespace kerf {

/// Returns a sentence that says why a case may not have these options of PETSc; empty: it may. Allowed are options of
/// the solver alone, as -ksp_type, -mg_levels_pc_type and -eps_ncv, so that nothing is loaded or logged, and no files:
/// the output of PETSc goes to the terminal. Whether PETSc knows the options is not checked.
std::string why_not_in_case(const std::string& options);

}  // namespace kerf

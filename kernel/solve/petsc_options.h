// What a case may tell PETSc: cases are sent from one to another.
#pragma once

#include <string>

namespace kerf {

/// Why options of PETSc are none that a case may give, a sentence; empty: they are. Of the solver alone, as -ksp_type,
/// -mg_levels_pc_type and -eps_ncv, so that nothing is loaded or logged, and without files: what PETSc shows goes to
/// the terminal. Whether PETSc knows them is not asked.
std::string why_not_in_case(const std::string& options);

}  // namespace kerf

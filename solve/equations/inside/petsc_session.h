// PETSc for as long as it is used, and its failures as errors.
#pragma once

#include <string>

#include "base/core/error.h"
#include "base/mpi/mpi_ranks.h"

struct _n_PetscOptions;  // PETSc's

namespace kerf {

/// A failure that PETSc reports: other ranks may wait for this one, so that all have to be ended.
class PetscFailure : public Error {
 public:
    using Error::Error;
};

/// Initialises PETSc on the communicator of the ranks, which may be some of those of the program; finalises it at the
/// end. Where the program has initialised it already, PETSc goes on as it is, and has `options` for the session alone.
/// Neither .petscrc nor the program's arguments are read; programs that want PETSC_OPTIONS not to be read, either, take
/// it out of their environment. Throws Error(usage) for `options` that PETSc does not take.
class PetscSession {
 public:
    explicit PetscSession(const MpiRanks& ranks, const std::string& options = "");
    ~PetscSession();
    PetscSession(const PetscSession&) = delete;
    PetscSession& operator=(const PetscSession&) = delete;

 private:
    void initialise(const MpiRanks& ranks);
    void use_own_options();
    void end();

    bool is_own_ = true;                  // else the program's
    _n_PetscOptions* options_ = nullptr;  // of the session, where PETSc is the program's
};

/// Throws PetscFailure for a code of PETSc that is not 0. Objects of PETSc are lost then.
void check(int code);
/// Checks the code of a call that reads the `options` of the case, which are blamed for its failure: Error(usage).
void check_options(int code, const std::string& options);
/// Throws Error(usage) for options of the session that PETSc has not used.
void refuse_unknown_options();

}  // namespace kerf

// PETSc for as long as a solution needs it. Its handler of errors keeps the text of the first failure, since the codes
// that come up no longer tell it, and check() throws it; PETSc's objects are lost then, and other ranks may wait in a
// call. Where the program has initialised PETSc already, the session pushes options and a handler of its own and pops
// them in the end; else it initialises and finalises, and takes PETSc's signal handlers away. Options of the case that
// nothing has read until the solver is set up are refused.
#include "solve/equations/inside/petsc_session.h"

#include <array>
#include <string_view>

#include <fmt/format.h>
#include <petscsys.h>

namespace kerf {

namespace {

// The first words of PETSc on a failure, which its codes on the way up no longer tell.
struct FirstFailure {
    bool is_of_memory = false;
    std::string text;
};
FirstFailure& first_failure() {
    static FirstFailure failure;
    return failure;
}

// A failure of PetscMallocAlign() has the number of a line as its code: it is known by the function.
PetscErrorCode remember_failure(MPI_Comm, int, const char* function, const char*, PetscErrorCode code,
                                PetscErrorType type, const char* message, void*) {
    if (type == PETSC_ERROR_INITIAL)
        first_failure() = {code == PETSC_ERR_MEM || std::string_view(function).starts_with("PetscMalloc"),
                           fmt::format("{} in {}", message ? message : "", function)};
    return code;
}

}  // namespace

// Throws for a failure, after which PETSc's objects are lost.
void check(int code) {
    if (code == 0) return;
    const FirstFailure failure = first_failure();
    if (failure.is_of_memory)
        throw PetscFailure(ErrorCode::memory,
                           "PETSc ran out of memory. Use more ranks, more hosts, a coarser mesh or order 1.");
    throw PetscFailure(ErrorCode::internal,
                       fmt::format("PETSc failed with code {}: {}.", static_cast<int>(code), failure.text));
}

// Blames a failure of a call that reads the options of the case on them.
void check_options(int code, const std::string& options) {
    if (code == 0 || options.empty() || first_failure().is_of_memory) return check(code);
    const std::string& text = first_failure().text;
    throw PetscFailure(ErrorCode::usage, fmt::format("PETSc does not take the options '{}' of the case, petsc under "
                                                     "[solver]: {}. Correct them or leave them out.",
                                                     options, text.substr(0, text.find('\n'))));
}

// Refuses options of the case that nothing has asked for when the solver is set up.
void refuse_unknown_options() {
    PetscInt count = 0;
    char **names = nullptr, **values = nullptr;
    check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
    std::string unknown;
    for (PetscInt i = 0; i < count; ++i)
        if (std::string(names[i]) != "skip_petscrc")
            unknown += fmt::format("{}-{}", unknown.empty() ? "" : ", ", names[i]);
    check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
    if (!unknown.empty())
        throw Error(ErrorCode::usage, fmt::format("PETSc has no use for these options of the case: {}.", unknown));
}

void PetscSession::initialise(const MpiRanks& ranks) {
    PETSC_COMM_WORLD = ranks.handle();
    std::array<char*, 3> arguments = {const_cast<char*>("kerf-solve"), const_cast<char*>("-skip_petscrc"), nullptr};
    int count = 2;
    char** list = arguments.data();
    check(PetscInitialize(&count, &list, nullptr, nullptr));
    check(PetscPopSignalHandler());
}

void PetscSession::use_own_options() {
    check(PetscOptionsCreate(&options_));
    check(PetscOptionsPush(options_));
}

PetscSession::PetscSession(const MpiRanks& ranks, const std::string& options) {
    PetscBool is_running = PETSC_FALSE;
    check(PetscInitialized(&is_running));
    is_own_ = !is_running;
    if (is_own_)
        initialise(ranks);
    else
        use_own_options();
    check(PetscPushErrorHandler(remember_failure, nullptr));
    const bool are_options = options.empty() || options[0] == '-';
    if (are_options && PetscOptionsInsertString(nullptr, options.c_str()) == 0) return;
    end();
    throw Error(ErrorCode::usage, fmt::format("PETSc does not take the options '{}'.", options));
}

PetscSession::~PetscSession() { end(); }

void PetscSession::end() {
    if (is_own_) {
        PetscFinalize();
        return;
    }
    PetscPopErrorHandler();
    PetscOptionsPop();
    PetscOptionsDestroy(&options_);
}

}  // namespace kerf

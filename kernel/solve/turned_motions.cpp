#include "solve/turned_motions.h"

#include <vector>

#include <petscmat.h>

namespace kerf {

int turn_into_frames(const NodeFrames& frames, MatNullSpace* motions) {
    PetscInt count = 0;
    const Vec* given = nullptr;
    PetscCall(MatNullSpaceGetVecs(*motions, nullptr, &count, &given));
    std::vector<Vec> turned(static_cast<std::size_t>(count), nullptr);
    for (std::size_t i = 0; i < turned.size(); ++i) {
        PetscInt size = 0;
        double* values = nullptr;
        PetscCall(VecDuplicate(given[i], &turned[i]));
        PetscCall(VecCopy(given[i], turned[i]));
        PetscCall(VecGetLocalSize(turned[i], &size));
        PetscCall(VecGetArray(turned[i], &values));
        frames.to_frames({values, static_cast<std::size_t>(size)});
        PetscCall(VecRestoreArray(turned[i], &values));
    }
    const MPI_Comm ranks = PetscObjectComm(reinterpret_cast<PetscObject>(*motions));
    MatNullSpace replaced = nullptr;
    PetscCall(MatNullSpaceCreate(ranks, PETSC_FALSE, count, turned.data(), &replaced));
    for (Vec& vector : turned) PetscCall(VecDestroy(&vector));
    PetscCall(MatNullSpaceDestroy(motions));
    *motions = replaced;
    return 0;
}

}  // namespace kerf

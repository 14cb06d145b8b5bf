// Kerf on the ranks of a program that uses MPI, with a communicator of its own. Everything else is in kerf/kerf.h.
#pragma once

#include <string>

#include <mpi.h>

#include "kerf/kerf.h"

namespace kerf {

/// Meshes into a run folder, shared out among the ranks of a communicator, of which a duplicate is used: the same bytes
/// for any number of ranks. Collective, with the same surface, options and folder on every rank; the folder lies where
/// all of them reach it. MPI has to allow MPI_THREAD_FUNNELED where the program has initialised it; else it is
/// initialised here, and finalised at the end of the process. MeshOptions::progress is asked on every rank, and any of
/// them ends the call. Throws the same Error on all ranks.
void mesh_to_folder(const ClosedSurface& surface, const MeshOptions& options, const std::string& folder,
                    MPI_Comm ranks);

}  // namespace kerf

// mpi_consumer SURFACE FOLDER: all ranks but the last mesh a surface, and the last meshes another one meanwhile.
#include <iostream>

#include "kerf/mpi.h"

int main(int argc, char** argv) {
    int provided = 0, rank = 0, size = 1;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    const bool is_last = rank == size - 1;
    MPI_Comm ranks = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, is_last, rank, &ranks);
    const std::string folder = std::string(argv[2]) + (is_last ? "/last" : "/others");
    kerf::mesh_to_folder(kerf::surface_from_file(argv[1]), {.parts = 3, .workers = 1}, folder, ranks);
    MPI_Comm_free(&ranks);
    MPI_Barrier(MPI_COMM_WORLD);
    if (is_last) std::cout << kerf::arrays_of_run(folder).tets.size() << " cells\n";
    MPI_Finalize();
}

// How the error of kerf solve falls: known displacements on the surface of a finished run, and the forces that go with
// them inside.
//
//     solve_bench sine|bending|sphere FOLDER ORDER
//
// `sine`: products of sines in the unit cube. `bending`: a beam under moments at its ends, of which elements of order 2
// have all. `sphere`: a thick sphere between radii 1 and 2 under pressure inside
// (Lame). Prints one object of JSON: errors in the norm of L2 and of the energy over those of the solution, measured
// with 64 points in each tetrahedron, and the estimate of the latter.
#include <string>

#include <fmt/format.h>
#include <mpi.h>

#include "base/mpi/mpi_ranks.h"
#include "files/part/run_parts.h"
#include "solve/equations/linear_system.h"
#include "solve/equations/stress.h"
#include "support/known_fields.h"

namespace kerf {

namespace {

void solve_and_print(MpiRanks& ranks, const test::KnownField& field, const std::string& folder, int order) {
    const RunParts run(folder);
    const std::vector<PartIndex> first = {PartIndex(0), PartIndex(run.outline().parts.size())};
    std::vector<Part> parts;
    for (const PartIndex index : run.outline().parts.ids()) parts.push_back(run.load(index));
    const FeSpace space(ranks, run.outline(), first, std::move(parts), order);

    const test::KnownProblem known = test::known_problem(space, field);
    std::vector<double> u;
    SolverOptions options;
    options.rtol = 1e-10;
    LinearSystem system(known.problem, options);
    const SolveOutcome outcome = system.solve(known.forces, u);
    const StressField stress = recover_stress(known.problem, u);

    const test::KnownErrors errors = test::errors_of(space, field, u);
    fmt::print(R"({{"tets": {}, "nodes": {}, "iterations": {}, "residual": {:.3g}, "l2": {:.6g}, "energy": {:.6g}, )"
               R"("estimate": {:.6g}}})"
               "\n",
               run.outline().tets(), space.total_rows(), outcome.iterations, outcome.residual, errors.l2, errors.energy,
               stress.norms.error / errors.energy_of_field);
}

}  // namespace

}  // namespace kerf

int main(int argc, char** argv) {
    int threads = MPI_THREAD_SINGLE;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &threads);
    int code = 2;
    if (argc == 4) try {
            kerf::MpiRanks ranks(MPI_COMM_SELF);
            const kerf::PetscSession petsc(ranks);
            const std::string name = argv[1];
            kerf::solve_and_print(ranks,
                                  name == "sphere"    ? kerf::test::sphere
                                  : name == "bending" ? kerf::test::bending
                                                      : kerf::test::sine,
                                  argv[2], std::stoi(argv[3]));
            code = 0;
        } catch (const std::exception& error) {
            fmt::print(stderr, "{}\n", error.what());
            code = 1;
        }
    MPI_Finalize();
    return code;
}

// Natural frequencies and modes of an elastic body.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solve/equations/elastic_problem.h"
#include "solve/space/largest_place.h"

namespace kerf {

struct Mode {
    double frequency = 0;       ///< cycles per time
    bool is_rigid = false;      ///< a motion that no support prevents, of frequency 0
    double residual = 0;        ///< |K x - w^2 M x| over |K x|, w = 2 pi f, in the norm of energy (EigenPairs)
    std::vector<double> shape;  ///< 3 for each local node; x^T M x = 1, the largest component is positive
    Extreme displacement = {};  ///< the largest of the shape
};

/// The file of to_csv() in the result folder.
inline constexpr const char* modes_file = "modes.csv";

struct FoundModes {
    std::vector<Mode> modes;  ///< ascending
    int iterations = 0;
};

/// Called after each iteration, on every rank, with its number and the number of modes found. Must not throw.
using AfterModesIteration = std::function<void(int iteration, int found)>;

/// Returns the modes with the lowest frequencies, with consistent mass, by blocks
/// (solve/multigrid/block_eigensolver.h), preconditioned by the multigrid of the stiffness and a little of the mass, so
/// that supports may leave the body free. Residuals reach 1e-5 in the norm of energy, and errors of frequencies follow
/// their square: of cantilevers 20 and 200 times as long as high they are 1e-8 and 1e-7, of one of 1000 times 3e-5,
/// since rounding in the stiffness leaves no more. Collective. O(count) times the work of a solution; about 0.5 kB for
/// each mode and node. Bytes are the same for the same number of ranks. Throws Error(usage) for a material without
/// density, or for more modes than there are degrees of freedom; Error(convergence) if they are not found.
FoundModes find_modes(const ElasticProblem& problem, int count, const AfterModesIteration& after_iteration = {});

/// Returns a table for people.
std::string to_text(const std::vector<Mode>& modes);
/// Returns a table for programs: number, frequency, rigid, residual.
std::string to_csv(const std::vector<Mode>& modes);

}  // namespace kerf

// A solution as files: the parts again, with values.
#pragma once

#include <string>
#include <vector>

#include "files/part/vtu_writer.h"
#include "solve/equations/elastic_problem.h"
#include "solve/equations/modes.h"
#include "solve/equations/stress.h"
#include "surface/size/background_sizes.h"

namespace kerf {

/// The solution for one set of loads.
struct CaseSolution {
    std::string name;
    std::vector<double> displacement;  ///< 3 for each local node
    StressField stress;
};

/// Returns the arrays of a part of this rank, of all cases: at its nodes Displacement (Float64), Stress (Float32, XX YY
/// ZZ XY YZ XZ) and VonMises (Float32); of cells Stress, VonMises and ErrorIndicator (Float32; the error's energy
/// norm). With several cases the names end with a space and the case's.
std::vector<PartValues> values_of_part(const ElasticProblem& problem, const std::vector<CaseSolution>& solutions,
                                       std::size_t p);

/// Returns the shapes of modes at points, as "Mode 1" and so on (Float64).
std::vector<PartValues> values_of_part(const ElasticProblem& problem, const std::vector<Mode>& modes, std::size_t p);

/// Writes a file that read_size_field() takes. Throws Error(io).
void write_sizes(const std::string& path, const SizedMesh& sizes);

}  // namespace kerf

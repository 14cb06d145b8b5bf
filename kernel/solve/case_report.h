// What came out for one set of loads, as plain data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solve/largest_place.h"
#include "solve/linear_system.h"
#include "solve/result_files.h"

namespace kerf {

/// What came out for one of several regions.
struct RegionResult {
    std::string name;
    double energy = 0;  ///< of the strain
    Extreme von_mises;
    std::vector<ForceAndMoment> reactions;  ///< of each support, to cells of the region
    std::optional<Extreme> safety;          ///< as that of CaseReport
};

/// What came out for one set of loads.
struct CaseReport {
    std::string name;
    SolveOutcome outcome;
    Vec3 load = Vec3::Zero();               ///< sum of all nodal forces, without inertia
    std::vector<ForceAndMoment> reactions;  ///< of each support and spring; moments about their places
    double imbalance = 0;                   ///< |loads + reactions + inertia| beside the largest of them
    EnergyNorms norms;
    Extreme displacement, von_mises;
    std::vector<RegionResult> regions;  ///< empty if there is one
    std::optional<Extreme> safety;      ///< the least of yield stress / von Mises stress, where a material has a yield
    Vec3 inertia = Vec3::Zero();        ///< the sum of its forces
    std::vector<BodyInertia> relieved;
    std::vector<std::pair<std::string, double>> factors;  ///< of a combination
};

/// Fills what follows from the solution of case `number`: all but name and outcome. `regions`: names of those of the
/// mesh. Collective; O(n).
void report_case(const ElasticProblem& problem, const CaseSolution& solution, std::size_t number,
                 const std::vector<std::string>& regions, CaseReport& report);

}  // namespace kerf

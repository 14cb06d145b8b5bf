// The results for one set of loads, as plain data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solve/equations/linear_system.h"
#include "solve/run/inside/result_files.h"
#include "solve/space/largest_place.h"

namespace kerf {

/// The results for one of several regions.
struct RegionResult {
    std::string name;
    double energy = 0;  ///< strain energy
    Extreme von_mises;
    std::vector<ForceAndMoment> reactions;  ///< as CaseReport::reactions, on the cells of the region
    std::optional<Extreme> safety;          ///< as CaseReport::safety
};

/// The results for one set of loads.
struct CaseReport {
    std::string name;
    SolveOutcome outcome;
    Vec3 load = Vec3::Zero();               ///< sum of all nodal forces, without inertia
    std::vector<ForceAndMoment> reactions;  ///< of each of ElasticProblem::supports; moments about their places
    double imbalance = 0;                   ///< |loads + reactions + inertia| over the largest of them
    EnergyNorms norms;
    Extreme displacement, von_mises;
    std::vector<RegionResult> regions;  ///< empty if the mesh has one region
    std::optional<Extreme> safety;      ///< the least of yield stress / von Mises stress, where a material has a yield
    Vec3 inertia = Vec3::Zero();        ///< sum of the forces of inertia
    std::vector<BodyInertia> relieved;
    std::vector<std::pair<std::string, double>> factors;  ///< of a combination: cases and factors
};

/// Fills all members of `report` but name and outcome from the solution of case `number`. `regions`: the names of the
/// mesh's regions. Collective; O(n).
void report_case(const ElasticProblem& problem, const CaseSolution& solution, std::size_t number,
                 const std::vector<std::string>& regions, CaseReport& report);

}  // namespace kerf

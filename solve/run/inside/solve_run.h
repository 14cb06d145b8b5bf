// From a finished run and a case to displacements and stresses: the order of the stages.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/mpi/mpi_ranks.h"
#include "solve/case/elastic_case.h"
#include "solve/equations/modes.h"
#include "solve/run/inside/case_report.h"
#include "solve/run/solve_listener.h"
#include "solve/space/surface_selection.h"

namespace kerf {

struct SolveRequest {
    std::string folder;  ///< of the run
    std::string case_file;
    std::string output;
    /// If given, and the estimated error beside the norm of the solution is above it, the result has a field of sizes
    /// for the next mesh.
    std::optional<double> target_error;
    std::optional<int> order = {};  ///< of the elements, whatever the case and the mesh say
    int modes = 0;  ///< if positive, so many natural frequencies and modes are found, and no case is solved
};

/// Seconds of wall clock for each stage, the longest over the ranks.
struct SolveSeconds {
    double read = 0, number = 0, conditions = 0, assemble = 0, setup = 0, solve = 0, modes = 0, recover = 0, write = 0,
           wall = 0;
};

/// A support, spring or inertia relief, and the point about which its moments are.
struct Reacting {
    std::string name;
    Vec3 place = Vec3::Zero();
};

struct SolveReport {
    SolveRequest request;
    ElasticCase wanted;  ///< with the order that the elements have
    int ranks = 1;
    std::int64_t parts = 0, tets = 0, vertices = 0;
    std::int64_t nodes = 0;          ///< of the finite elements; three unknowns each, but for held ones
    std::int64_t held = 0;           ///< number of held degrees of freedom
    std::vector<Reacting> reacting;  ///< supports, springs and inertia relief
    std::vector<CaseReport> cases;
    std::vector<Mode> modes;  ///< without their shapes
    int mode_iterations = 0;
    double wanted_of_next = 0;  ///< the error for which size_field.vtu is made; 0: there is no such file
    SolveSeconds seconds;
    std::int64_t peak_rss_bytes = 0;  ///< sum over the ranks
    std::vector<RunFile> files;
    int exit_code = 0;

    /// Returns the largest relative error of the cases (EnergyNorms::relative()).
    double relative_error() const;
};

/// The field of sizes in the result folder: a mesh for --size-field of kerf mesh.
inline constexpr const char* size_field_file = "size_field.vtu";

/// The tables for spreadsheets in the result folder: CSV (RFC 4180), numbers with all their digits.
inline constexpr const char* results_file = "results.csv";
inline constexpr const char* reactions_file = "reactions.csv";

/// Solves and writes the result folder: parts, of the order of the elements, with Displacement, Stress, VonMises and
/// ErrorIndicator and tables as CSV, or with Mode 1 and so on and modes.csv, mesh.pvtu and report.json, which appears
/// as a whole or not at all (files/io/run_folder.h). Collective. Throws Error on all ranks alike; Error(convergence) if
/// the tolerance is not reached, and nothing is written then.
SolveReport solve_run(const SolveRequest& request, MpiRanks& ranks, SolveListener* listener);

/// Returns the patches of a finished run. Collective.
std::vector<PatchSummary> list_patches(const std::string& folder, MpiRanks& ranks);

/// Returns report.json, sealed (files/io/run_manifest.h).
std::string to_json(const SolveReport& report);
/// Returns some lines for people.
std::string to_text(const SolveReport& report);
/// Returns a row for each case, and after it one for each of several regions: `region` is empty for the whole. Unknown
/// values are empty.
std::string results_csv(const std::vector<CaseReport>& cases);
/// Returns a row for each case and support, and after it one for each of several regions.
std::string reactions_csv(const std::vector<CaseReport>& cases, const std::vector<Reacting>& reacting);

}  // namespace kerf

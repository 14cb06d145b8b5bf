#include "solve/equations/modes.h"

#include <fmt/format.h>

#include "base/core/error.h"
#include "solve/equations/inside/mode_solver.h"

namespace kerf {

namespace {

void require_density(const ElasticProblem& problem) {
    for (const Material& material : problem.materials)
        if (!(material.density > 0))
            throw Error(ErrorCode::usage, fmt::format("Modes need the density of material '{}'. Add density to it, in "
                                                      "t/mm^3 with mm and MPa, or in kg/m^3 with m and Pa.",
                                                      material.name));
}

}  // namespace

FoundModes find_modes(const ElasticProblem& problem, int count, const AfterModesIteration& after_iteration) {
    require_density(problem);
    std::int64_t free = 0;
    for (std::int32_t dof = 0; dof < 3 * problem.space->owned_count(); ++dof) free += problem.is_held(dof) ? 0 : 1;
    free = problem.space->ranks().all_reduce(free, Reduction::sum);
    if (4 * static_cast<std::int64_t>(count) > free)
        throw Error(ErrorCode::usage, fmt::format("{} modes are too many for {} free degrees of freedom. Ask for {} at "
                                                  "most, or use a finer mesh.",
                                                  count, free, free / 4));
    return ModeSolver(problem, count).find(after_iteration);
}

std::string to_text(const std::vector<Mode>& modes) {
    std::string text;
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const Mode& mode = modes[m];
        text += fmt::format("{:<12}{:>3}  {}\n", "mode", m + 1,
                            mode.is_rigid ? std::string("rigid motion") : fmt::format("{:.6g} Hz", mode.frequency));
    }
    return text;
}

std::string to_csv(const std::vector<Mode>& modes) {
    std::string text = "mode,frequency_hz,rigid,residual\n";
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const Mode& mode = modes[m];
        text += fmt::format("{},{:.12g},{},{:.3g}\n", m + 1, mode.frequency, mode.is_rigid ? 1 : 0, mode.residual);
    }
    return text;
}

}  // namespace kerf

#include "volume/retries.h"

#include <fmt/format.h>

namespace kerf {

namespace {

constexpr std::uint32_t other_orders = 2;             // cured 10 of 10 failures in a trial
constexpr double tolerances[] = {1e-6, 1e-5, 1e-12};  // relative; TetGen's own is 1e-8
constexpr double weaker_radius_edge = 2;              // Delaunay refinement ends for it in theory

}  // namespace

std::vector<MesherCall> mesher_calls(const MesherOptions& wanted) {
    std::vector<MesherCall> calls = {{"", wanted, 0}};
    for (std::uint32_t seed = 1; seed <= other_orders; ++seed)
        calls.push_back({"another order of the vertices", wanted, seed});
    if (!wanted.tetgen_switches.empty()) return calls;
    for (const double tolerance : tolerances) {
        MesherCall& call = calls.emplace_back(MesherCall{fmt::format("tolerance {:g}", tolerance), wanted, 0});
        call.options.tolerance = tolerance;
    }
    if (wanted.radius_edge == 0) return calls;
    if (wanted.radius_edge < weaker_radius_edge) {
        MesherCall& call =
            calls.emplace_back(MesherCall{fmt::format("radius-edge ratio {:g}", weaker_radius_edge), wanted, 1});
        call.options.radius_edge = weaker_radius_edge;
    }
    MesherCall& call = calls.emplace_back(MesherCall{"no bound of the radius-edge ratio", wanted, 0});
    call.options.radius_edge = 0;
    return calls;
}

std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure) {
    if (call + 1 >= calls.size()) return std::nullopt;
    return failure == MesherFailure::timed_out && call > 0 ? calls.size() - 1 : call + 1;
}

}  // namespace kerf

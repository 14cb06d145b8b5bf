#include "volume/retries.h"

#include <fmt/format.h>

#include "core/check.h"

namespace kerf {

namespace {

constexpr std::uint32_t other_orders = 2;             // cured 10 of 10 failures in a trial
constexpr double tolerances[] = {1e-6, 1e-5, 1e-12};  // relative; TetGen's own is 1e-8
constexpr double coarser_factor = 8;                  // twice the edge length
constexpr double weaker_radius_edge = 2;              // Delaunay refinement ends for it in theory

}  // namespace

std::vector<MesherCall> mesher_calls(const MesherOptions& wanted) {
    std::vector<MesherCall> calls = {{.remedy = "", .options = wanted}};
    for (std::uint32_t seed = 1; seed <= other_orders; ++seed)
        calls.push_back({.remedy = "another order of the vertices", .options = wanted, .vertex_order_seed = seed});
    const auto cut_in_two = [&] {
        calls.push_back({.remedy = "cut in two and joined", .options = wanted, .cut_first = true, .easier = true});
    };
    if (!wanted.tetgen_switches.empty()) {
        cut_in_two();
        return calls;
    }
    for (const double tolerance : tolerances) {
        calls.push_back({.remedy = fmt::format("tolerance {:g}", tolerance), .options = wanted});
        calls.back().options.tolerance = tolerance;
    }
    if (wanted.radius_edge > 0 && wanted.radius_edge < weaker_radius_edge) {
        calls.push_back({.remedy = fmt::format("radius-edge ratio {:g}", weaker_radius_edge),
                         .options = wanted,
                         .vertex_order_seed = 1});
        calls.back().options.radius_edge = weaker_radius_edge;
    }
    if (wanted.radius_edge > 0) {
        calls.push_back({.remedy = "no bound of the radius-edge ratio", .options = wanted, .easier = true});
        calls.back().options.radius_edge = 0;
    }
    cut_in_two();
    if (!wanted.size.is_empty()) {
        calls.push_back({.remedy = fmt::format("tetrahedra {:g} times as large", coarser_factor),
                         .options = wanted,
                         .easier = true});
        calls.back().options.size = wanted.size.coarser(coarser_factor);
    }
    return calls;
}

std::optional<std::size_t> next_call(const std::vector<MesherCall>& calls, std::size_t call, MesherFailure failure) {
    KERF_CHECK(call < calls.size());
    const bool any = failure == MesherFailure::failed || call == 0;
    for (std::size_t next = call + 1; next < calls.size(); ++next)
        if (any || calls[next].easier) return next;
    return std::nullopt;
}

}  // namespace kerf

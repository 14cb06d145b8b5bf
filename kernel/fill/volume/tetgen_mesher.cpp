// TetGen (Si 2015, si2015) as a row of the table: its forecast, and the ladder of calls that are tried when it fails.
// The ladder goes from changes that cost nothing in the mesh, another order of the vertices or another tolerance, to
// those that give up more and more of what was asked for; the lattice stands between, because it keeps everything. The
// numbers of the forecast are measured. With switches of an expert bounds are not touched.
#include <malloc.h>

#include <fmt/format.h>

#include "fill/volume/inside/tetgen_adapter.h"
#include "fill/volume/meshers.h"

namespace kerf {

namespace {

constexpr std::uint32_t other_orders = 2;             // cured 10 of 10 failures in a trial
constexpr double tolerances[] = {1e-6, 1e-5, 1e-12};  // relative; TetGen's own is 1e-8
constexpr double coarser_factor = 8;                  // twice the edge length
constexpr double weaker_radius_edge = 2;              // Delaunay refinement ends for it in theory

void check_tetgen_options(const MesherOptions& options) { check_tetgen_switches(options.tetgen.switches); }

Filling fill_with_tetgen(const SurfaceArrays& surface, const MesherOptions& options) {
    Filling filling{mesh_with_tetgen(surface, hole_points(surface), options), ""};
    ::malloc_trim(0);  // TetGen has freed several times the memory that is still used; other workers may need it
    improve_filling(filling, options);
    return filling;
}

MesherOptions for_lattice(MesherOptions options) {
    options.name = "lattice";
    return options;
}

// Returns the ladder: other orders of the vertices, other tolerances, the lattice, which gives all that was asked for,
// a weaker bound of the shape, none, the part cut in two, eight times the wanted volume. With the expert's switches
// only the order changes, and the part is cut in two.
std::vector<MesherCall> tetgen_calls(const MesherOptions& wanted) {
    std::vector<MesherCall> calls = {{.fallback = "", .options = wanted}};
    const auto add = [&](const std::string& fallback) -> MesherOptions& {
        return calls.emplace_back(MesherCall{.fallback = fallback, .options = wanted}).options;
    };
    const auto cut_in_two = [&] {
        calls.push_back({.fallback = "cut in two and joined", .options = wanted, .cut_first = true, .easier = true});
    };
    for (std::uint32_t seed = 1; seed <= other_orders; ++seed)
        add("another order of the vertices").tetgen.shuffle = seed;
    if (!wanted.tetgen.switches.empty()) {
        cut_in_two();
        return calls;
    }
    for (const double tolerance : tolerances)
        add(fmt::format("tolerance {:g}", tolerance)).tetgen.tolerance = tolerance;
    calls.push_back({.fallback = "the lattice mesher", .options = for_lattice(wanted), .easier = true});
    if (wanted.radius_edge > 0 && wanted.radius_edge < weaker_radius_edge) {
        MesherOptions& options = add(fmt::format("radius-edge ratio {:g}", weaker_radius_edge));
        options.radius_edge = weaker_radius_edge;
        options.tetgen.shuffle = 1;
    }
    if (wanted.radius_edge > 0) {
        add("no bound of the radius-edge ratio").radius_edge = 0;
        calls.back().easier = true;
    }
    cut_in_two();
    if (!wanted.size.is_empty()) {
        add(fmt::format("tetrahedra {:g} times as large", coarser_factor)).size = wanted.size.coarser(coarser_factor);
        calls.back().easier = true;
    }
    return calls;
}

std::string command_line_switches(const MesherOptions& options) {
    if (!options.tetgen.switches.empty()) return "pY" + options.tetgen.switches;
    std::string switches = "pY";
    if (options.radius_edge > 0) switches += fmt::format("q{:g}", options.radius_edge);
    if (options.tetgen.tolerance > 0) switches += fmt::format("T{:g}", options.tetgen.tolerance);
    if (!options.size.is_empty() && options.size.is_constant())
        switches += fmt::format("a{:g}", options.size.reference_volume());
    return switches;
}

Reproducer tetgen_reproducer(const SurfaceArrays& surface, const MesherOptions& options, const std::string& stem) {
    return smesh_reproducer(surface, options, fmt::format("tetgen -{} {}.smesh", command_line_switches(options), stem));
}

}  // namespace

// Measured on 270 parts of the assets: nine tenths have 0.74 to 1.25 times as many tetrahedra, and for their number
// take 0.55 to 1.44 times the memory and 0.8 to 2 times the seconds. The work was fitted on 1,160 runs (rms 16 %).
// TetGen counts the corners of tetrahedra in 32 bits.
extern const Mesher tetgen_mesher = {
    .name = "tetgen",
    .forecast = {.tets_by_edge_ratio = {0, 0, 0, 0, 0.8, 0.9, 1.2, 1.75, 2.1, 2.2, 2.3},
                 .tets_per_volume_bound = 1.48,
                 .tets_per_sized_volume = 2.1,
                 .most_tets_per_facet = 1.9,
                 .seconds_per_facet = 0,
                 .seconds_per_tet = 5e-6,
                 .bytes_per_tet = 220,
                 .volume_weight = 0.606,
                 .most_tets = 1 << 29},
    .check = check_tetgen_options,
    .fill = fill_with_tetgen,
    .calls = tetgen_calls,
    .reproducer = tetgen_reproducer};

}  // namespace kerf

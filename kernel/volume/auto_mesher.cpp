// Which mesher a part gets if its user has not said: the lattice, which asks TetGen where it fails itself, but TetGen
// if there are switches for it.
#include "volume/meshers.h"

namespace kerf {

namespace {

MesherOptions with_chosen_mesher(MesherOptions options) {
    options.name = options.tetgen.switches.empty() ? "lattice" : "tetgen";
    return options;
}
const Mesher& chosen_mesher(const MesherOptions& options) { return find_mesher(with_chosen_mesher(options).name); }

void check_auto_options(const MesherOptions& options) { chosen_mesher(options).check(with_chosen_mesher(options)); }

Filling fill_with_chosen_mesher(const SurfaceArrays& surface, const MesherOptions& options) {
    return chosen_mesher(options).fill(surface, with_chosen_mesher(options));
}

std::vector<MesherCall> auto_calls(const MesherOptions& wanted) {
    return chosen_mesher(wanted).calls(with_chosen_mesher(wanted));
}

Reproducer auto_reproducer(const SurfaceArrays& surface, const MesherOptions& options, const std::string& stem) {
    return chosen_mesher(options).reproducer(surface, with_chosen_mesher(options), stem);
}

}  // namespace

// The lattice's own; TetGen with switches is not known in advance.
extern const Mesher auto_mesher = {.name = "auto",
                                   .forecast = {.tets_per_facet = 2.1,
                                                .tets_per_volume_bound = 1.7,
                                                .most_tets_per_facet = 2.5,
                                                .seconds_per_facet = 6e-6,
                                                .seconds_per_tet = 1e-6,
                                                .bytes_per_tet = 70,
                                                .volume_weight = 0.1,
                                                .most_tets = (std::int64_t{1} << 31) - 2},
                                   .check = check_auto_options,
                                   .fill = fill_with_chosen_mesher,
                                   .calls = auto_calls,
                                   .reproducer = auto_reproducer};

}  // namespace kerf

// The mesher of a part if the user has not named one: the lattice, which asks TetGen where it fails itself, but TetGen
// if there are switches for it.
#include "fill/volume/meshers.h"

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

// The forecast is that of the lattice, as nothing is known in advance of TetGen with switches.
extern const Mesher auto_mesher = {.name = "auto",
                                   .forecast = lattice_forecast,
                                   .check = check_auto_options,
                                   .fill = fill_with_chosen_mesher,
                                   .calls = auto_calls,
                                   .reproducer = auto_reproducer};

}  // namespace kerf

// Workers have found the worst cells of their parts, by causes (fill/mesh/worst_cells.h); here they are added up over
// the parts, and get names and ways out. What helps against a bad facet depends on what has become of the facets of the
// file: kept, partly kept, divided or remeshed.
#include "run/report/inside/sharp_places.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/core/number_text.h"

namespace kerf {

namespace {

// Returns the ways to other facets, by what has become of those of the file.
std::string way_to_better_facets(const RunReport& report) {
    const Input& input = report.input;
    if (report.request.remeshing == Remeshing::never)
        return fmt::format("--surface {} keeps these facets: --surface remesh makes better ones.",
                           report.request.facets == FacetPolicy::keep ? "keep" : "split");
    if (!input.remeshed || input.remeshed->only_divided) return "--surface remesh makes better facets.";
    if (input.remeshed->facets_kept > 0)
        return "These facets were kept where others were remeshed: --surface remesh makes all of them new.";
    const std::string help = "A larger --deviation leaves the new facets more room; edges and borders of patches stay.";
    return report.request.input_options.feature_angle_deg > 0
               ? help + " A larger --feature-angle has fewer such borders."
               : help;
}

std::string way_to_wider_walls(const RunReport& report) {
    const std::string help =
        "A fold goes with a --deviation larger than that; at walls, facets as small as they are near help: a --size-in "
        "there, or --cells-across 1, everywhere.";
    if (report.input.components < 2) return help;
    return fmt::format("{} Bodies that are meant to touch: --{}.", help,
                       report.input.is_cad ? "unite" : "repair full,snap,bodies=regions");
}

std::string way_out_of(SharpnessCause cause, const RunReport& report) {
    switch (cause) {
        case SharpnessCause::edge:
            return "Every mesh of this surface has such cells there; a fold goes with a --deviation larger than it is.";
        case SharpnessCause::walls:
            return way_to_wider_walls(report);
        case SharpnessCause::facet:
            return way_to_better_facets(report);
        case SharpnessCause::cut:
            return "Another -n or --axis cuts elsewhere.";
        case SharpnessCause::unknown:
            break;
    }
    if (!report.request.mesher.improve) return "Without --no-improve they are replaced.";
    if (!report.request.mesher.tetgen.switches.empty()) return "Without --tetgen-switches they are replaced.";
    return "Another --size or -n gives other cells.";
}

}  // namespace

std::vector<SharpPlace> sharp_places(const RunReport& report) {
    const Input& input = report.input;
    const auto name_in = [](const auto& names, std::int64_t i) {
        return names.size() > 1 && i >= 0 && i < std::ssize(names) ? names[i] : std::string();
    };
    std::vector<SharpPlace> places;
    for (std::size_t i = 0; i < sharpness_causes; ++i) {
        SharpPlace place{static_cast<SharpnessCause>(i), {}, root_node, "", "", ""};
        for (const PartReport& part : report.parts) {
            const SharpCells& cells = part.result.worst.of(place.cause);
            if (cells.count == 0) continue;
            if (cells.angle_deg < place.cells.angle_deg) {
                place.part = part.id;
                place.region = name_in(input.complex.region_names(), part.region.value());
                place.patch = name_in(input.patch_names, cells.patch);
            }
            place.cells.add(cells);
        }
        if (place.cells.count == 0) continue;
        place.way_out = way_out_of(place.cause, report);
        places.push_back(std::move(place));
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const SharpPlace& a, const SharpPlace& b) { return a.cells.angle_deg < b.cells.angle_deg; });
    return places;
}

const char* name_of(SharpnessCause cause) {
    constexpr std::array<const char*, sharpness_causes> names = {"edge", "walls", "facet", "cut", "unknown"};
    return names[static_cast<std::size_t>(cause)];
}

std::string why(const SharpPlace& place) {
    const double measure = place.cells.measure;
    switch (place.cause) {
        case SharpnessCause::edge:
            return fmt::format("the body has an edge of {:.2g} degrees there", measure);
        case SharpnessCause::walls:
            return fmt::format("two walls are {:.2g} apart there", measure);
        case SharpnessCause::facet:
            return fmt::format("a facet there has an angle of {:.2g} degrees", measure);
        case SharpnessCause::cut:
            return "the cut between two parts is there";
        case SharpnessCause::unknown:
            break;
    }
    return "neither facets nor cuts there force them";
}

std::string sharp_text(const SharpPlace& place) {
    const SharpCells& cells = place.cells;
    const Vec3& at = cells.place;
    const std::string of_region = place.region.empty() ? "" : fmt::format(", region {}", place.region),
                      on_patch = place.patch.empty() ? "" : fmt::format(", at patch {}", place.patch);
    return fmt::format(
        "{} cell{} below {} degrees, the worst of {:.2g} at ({:.6g}, {:.6g}, {:.6g}) in part {}{}{}: "
        "{}. {}",
        grouped(cells.count), cells.count == 1 ? "" : "s", WorstCells::bound_deg, cells.angle_deg, at.x(), at.y(),
        at.z(), place.part.value(), of_region, on_patch, why(place), place.way_out);
}

}  // namespace kerf

// Ends that are open on purpose, as those of vessels, are closed by lids, each in a patch of its own, the largest
// first.
#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "surface/openings/opening_filler.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

struct CapsReport {
    RepairAction capped{"opening capped", "openings capped", "edges"};
    RepairAction few, smooth;
    RepairAction sheets = refused_action("rim of a sheet", "rims of sheets", "edges",
                                         "a lid would fold back onto the sheet; thicken makes it a wall");
    RepairAction unfit = refused_action(
        "rim", "rims", "edges", "it is no closed loop on a surface with two sides; orient and manifold may help");
    RepairAction impossible = refused_opening("every lid crosses the surface");

    explicit CapsReport(bool has_holes)
        : few(refused_opening(has_holes ? "fewer edges than caps=N asks for; a hole"
                                        : "fewer edges than caps=N asks for; holes fills it")),
          smooth(refused_opening(has_holes ? "the surface goes on over it; a hole, not an end"
                                           : "the surface goes on over it; holes fills it")) {}
    void add_to(StepReport& report) {
        for (RepairAction* action : {&capped, &few, &smooth, &sheets, &unfit, &impossible})
            report.actions.push_back(std::move(*action));
    }
    static RepairAction refused_opening(const char* because) {
        return refused_action("opening", "openings", "edges", because);
    }
};

RepairPlace place_of_rim(const Soup& soup, const Rim& rim) {
    return {rim.centre(soup), soup.file_facets({rim.facets.front()}), static_cast<double>(rim.facets.size())};
}

std::vector<RimOpening> openings_to_cap(const OpenRims& rims, const StepRequest& request, CapsReport& said) {
    std::vector<RimOpening> openings;
    for (const Rim& rim : rims.all()) {
        const RepairPlace place = place_of_rim(rims.soup(), rim);
        if (rim.obstacle != RimObstacle::none) {
            said.unfit.add(place);
        } else if (rim.facets.size() < request.amount) {
            said.few.add(place);
        } else {
            RimOpening opening = make_opening(rims, {&rim});
            if (opening.bend < BendDegrees::lid)
                said.smooth.add(place);
            else if (opening.bend > BendDegrees::folded)
                said.sheets.add(place);
            else
                openings.push_back(std::move(opening));
        }
    }
    return openings;
}

}  // namespace

void caps_step(Soup& soup, const StepRequest& request, StepReport& report) {
    const OpenRims rims(soup);
    CapsReport said(request.has(RepairKind::holes));
    constexpr double growth = 0.02;
    const std::vector<FilledOpening> filled =
        fill_openings(rims, openings_to_cap(rims, request, said),
                      {growth, request.has(RepairKind::intersections), request.check_cancelled});
    std::vector<std::size_t> by_area;
    std::vector<double> area(filled.size(), 0);
    for (std::size_t i = 0; i < filled.size(); ++i) {
        if (filled[i].patch) {
            by_area.push_back(i);
            area[i] = filled[i].area();
        } else {
            said.impossible.add(place_of_rim(soup, *filled[i].opening.rims[0]));
        }
    }
    std::stable_sort(by_area.begin(), by_area.end(), [&](std::size_t a, std::size_t b) { return area[a] > area[b]; });
    PatchAppender appender(soup);
    int number = 0;
    for (const std::size_t i : by_area) {
        said.capped.add(place_of_rim(soup, *filled[i].opening.rims[0]));
        appender.append(filled[i], add_patch(soup, fmt::format("{}{}", cap_name, ++number)));
    }
    said.add_to(report);
}

}  // namespace kerf

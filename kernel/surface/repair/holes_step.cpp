// Openings of few edges are filled by patches that go on as the surface does, by lids, or by bands between two rims.
// Rims that cannot be spanned or have too many edges are refused first; the others are paired where a band fits
// (surface/openings/rim_pairs.h). The angle of a filling with the surface around it tells the rest: beyond 135 degrees
// the rim is that of a sheet, and lids, from 45 degrees on, are refused where sheets are to be thickened. The remaining
// openings get patches (surface/openings/opening_filler.h), all in the patch "filled"; only where `intersections`
// follows may these cross the surface. Each reason of a refusal is an action of the report.
#include "surface/openings/opening_filler.h"
#include "surface/openings/rim_pairs.h"
#include "surface/repair/repair_step.h"

namespace kerf {

namespace {

struct HolesReport {
    RepairAction filled{"hole filled", "holes filled", "edges"};
    RepairAction banded{"gap between two rims closed", "gaps between two rims closed", "edges"};
    RepairAction crossing{"hole filled across other facets", "holes filled across other facets", "edges"};
    RepairAction high{"filling leaves the plane of its rim", "fillings leave the planes of their rims", "at most"};
    RepairAction long_ones = refused_hole("more edges than holes=N allows");
    RepairAction chains = refused_action("open chain of edges", "open chains of edges", "edges",
                                         "it ends where more than two facets meet in an edge; manifold opens those");
    RepairAction one_sided = refused_action("rim of a surface with one side", "rims of surfaces with one side", "edges",
                                            "what fills it would have no outside; cut the surface, or thicken it");
    RepairAction infinite = refused_hole("a vertex has no finite coordinates");
    RepairAction sheets = refused_action("rim of a sheet", "rims of sheets", "edges",
                                         "a filling would fold back onto the sheet; thicken makes it a wall");
    RepairAction lids = refused_hole("it would need a lid, but sheets are to be thickened");
    RepairAction impossible = refused_hole("every filling crosses the surface");

    HolesReport() { high.changes_surface = false; }
    static RepairAction refused_hole(const char* because) { return refused_action("hole", "holes", "edges", because); }
    RepairAction& of(RimObstacle obstacle) {
        return obstacle == RimObstacle::no_loop ? chains : obstacle == RimObstacle::one_sided ? one_sided : infinite;
    }
    // The place of the highest one is told.
    void add_height(RepairPlace place) {
        ++high.count;
        if (high.places.empty())
            high.places.push_back(std::move(place));
        else if (place.measure > high.places[0].measure)
            high.places[0] = std::move(place);
    }
    void add_to(StepReport& report) {
        for (RepairAction* action : {&filled, &banded, &crossing, &high, &long_ones, &chains, &one_sided, &infinite,
                                     &sheets, &lids, &impossible})
            report.actions.push_back(std::move(*action));
    }
};

RepairPlace place_of(const Soup& soup, const Rim& rim, double measure) {
    constexpr std::size_t a_few = 10;
    const std::size_t count = std::min(rim.facets.size(), a_few);
    return {rim.centre(soup), soup.file_facets({rim.facets.begin(), rim.facets.begin() + count}), measure};
}

RepairPlace place_of(const Soup& soup, const RimOpening& opening) {
    return place_of(soup, *opening.rims[0], opening.edges());
}

std::vector<RimOpening> openings_to_fill(const OpenRims& rims, const StepRequest& request, HolesReport& said) {
    std::vector<RimOpening> openings;
    for (const Rim& rim : rims.all()) {
        request.check_cancelled();
        const double edges = rim.facets.size();
        if (rim.obstacle != RimObstacle::none)
            said.of(rim.obstacle).add(place_of(rims.soup(), rim, edges));
        else if (edges > request.amount)
            said.long_ones.add(place_of(rims.soup(), rim, edges));
        else
            openings.push_back(make_opening(rims, {&rim}));
    }
    openings = join_facing(rims, std::move(openings), request.check_cancelled);
    std::erase_if(openings, [&](const RimOpening& opening) {
        const bool is_sheet = opening.bend > BendDegrees::folded;
        const bool is_unwanted_lid = request.has(RepairKind::thicken) && opening.bend > BendDegrees::lid;
        if (is_sheet || is_unwanted_lid) (is_sheet ? said.sheets : said.lids).add(place_of(rims.soup(), opening));
        return is_sheet || is_unwanted_lid;
    });
    return openings;
}

}  // namespace

void holes_step(Soup& soup, const StepRequest& request, StepReport& report) {
    const OpenRims rims(soup);
    HolesReport said;
    constexpr double growth = 0.1;
    const std::vector<FilledOpening> filled =
        fill_openings(rims, openings_to_fill(rims, request, said),
                      {growth, request.has(RepairKind::intersections), request.check_cancelled});
    PatchAppender appender(soup);
    std::int32_t patch = -1;
    for (const FilledOpening& one : filled) {
        const RepairPlace place = place_of(soup, one.opening);
        if (!one.patch) {
            said.impossible.add(place);
            continue;
        }
        if (patch < 0) patch = add_patch(soup, "filled");
        (one.crosses ? said.crossing : one.opening.rims.size() > 1 ? said.banded : said.filled).add(place);
        if (const double height = one.height(); height > 1e-6 * one.opening.length())
            said.add_height({place.where, place.facets, height});
        appender.append(one, patch);
    }
    said.add_to(report);
}

}  // namespace kerf

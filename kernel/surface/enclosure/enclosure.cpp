// Bodies and box become one arrangement of facets, which divides space into cells. A walk through the cells from the
// outside tells of each whether it is in the box and in which body: crossing a facet of the box changes the first, one
// of a body leads to the region on its other side. A piece of a face and of a body may be one facet, as where a
// building stands on the ground; it is crossed as both at once. The air is the largest cell that is in the box and in
// no body.
#include "surface/enclosure/enclosure.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/core/unique_name.h"
#include "surface/arrange/arrangement.h"
#include "surface/arrange/divided_soup.h"
#include "surface/enclosure/inside/box_facets.h"
#include "surface/regions/cell_walk.h"
#include "surface/regions/divided_space.h"

namespace kerf {

namespace {

// The bodies before they are divided.
struct Bodies {
    std::vector<FacetSides> sides;  // of each of their facets
    std::vector<std::string> names;
};

Bodies take_bodies(Soup& soup) {
    Bodies bodies{std::exchange(soup.sides, {}), std::exchange(soup.region_names, {})};
    if (bodies.sides.empty()) {
        bodies.sides.assign(soup.facets.size(), {RegionIndex::none(), RegionIndex(0)});
        bodies.names = {"body"};
    }
    return bodies;
}

// Faces of the box have the names that cases expect: patches of bodies give way.
void rename_patches(Soup& soup, const Enclosure& enclosure) {
    if (soup.patch_names == std::vector<std::string>{"surface"}) soup.patch_names = {"body"};
    std::set<std::string> faces, taken(soup.patch_names.begin(), soup.patch_names.end());
    for (const auto& ends : enclosure.face_names) faces.insert(ends.begin(), ends.end());
    taken.insert(faces.begin(), faces.end());
    for (std::string& name : soup.patch_names)
        if (faces.contains(name)) name = unique_name(fmt::format("body_{}", name), taken);
}

// What is crossed with a facet that stands for all pieces in its place, by its direction.
struct Crossing {
    bool is_of_box = false, is_of_body = false;
    FacetSides bodies;
};

std::vector<Crossing> crossings_of(const SingleFacets& single, const std::vector<std::int32_t>& parent,
                                   const Bodies& bodies) {
    std::vector<Crossing> crossings(single.facets.size());
    for (std::size_t f = 0; f < parent.size(); ++f) {
        if (single.single_of[f] < 0) continue;
        Crossing& crossing = crossings[single.single_of[f]];
        if (std::cmp_greater_equal(parent[f], bodies.sides.size())) {
            crossing.is_of_box = true;
            continue;
        }
        const FacetSides& sides = bodies.sides[parent[f]];
        crossing.is_of_body = true;
        crossing.bodies = single.is_turned[f] ? sides.turned() : sides;
    }
    return crossings;
}

// Where a cell lies.
struct CellPlace {
    bool is_in_box = false;
    RegionIndex body = RegionIndex::none();

    bool is_air() const { return is_in_box && !body.is_valid(); }
    bool is_of_body_in_box() const { return is_in_box && body.is_valid(); }
};

std::vector<CellPlace> places_of_cells(const Cells& cells, const std::vector<Crossing>& crossings) {
    std::vector<CellPlace> places(cells.count + 1);  // that of the unbounded cell first
    CellWalk(cells).run([&](std::int32_t from, std::int32_t facet, std::int32_t to) {
        CellPlace place = places[from + 1];
        const Crossing& crossing = crossings[facet];
        if (crossing.is_of_box) place.is_in_box = !place.is_in_box;
        if (crossing.is_of_body)
            place.body = cells.sides[facet].front == to ? crossing.bodies.front : crossing.bodies.back;
        places[to + 1] = place;
    });
    places.erase(places.begin());
    return places;
}

std::string extent_text(const Box& box) {
    return fmt::format("from ({:.6g}) to ({:.6g})", fmt::join(box.min(), ", "), fmt::join(box.max(), ", "));
}

[[noreturn]] void refuse_box(const char* what, const Enclosure& enclosure) {
    throw Error(ErrorCode::usage, fmt::format("{}: the body lies {}, and the box {}. Correct --box or --ground.", what,
                                              extent_text(enclosure.bodies), extent_text(enclosure.box)));
}

// Names of the faces of the box that bodies reach beyond.
std::vector<std::string> faces_crossed(const Enclosure& enclosure) {
    std::vector<std::string> names;
    for (int axis = 0; axis < 3; ++axis) {
        if (enclosure.bodies.min()[axis] < enclosure.box.min()[axis]) names.push_back(enclosure.face_names[axis][0]);
        if (enclosure.bodies.max()[axis] > enclosure.box.max()[axis]) names.push_back(enclosure.face_names[axis][1]);
    }
    return names;
}

// The number of the cell of air that counts. Notes what is left out.
std::int32_t choose_air(const std::vector<CellPlace>& places, const std::vector<double>& volumes,
                        const Enclosure& enclosure, std::vector<std::string>& notes) {
    std::int32_t air = -1;
    std::int64_t spaces = 0;
    double all = 0, body_in_box = 0, body_beyond = 0;
    for (std::int32_t c = 0; c < count_of(places); ++c) {
        if (places[c].body.is_valid()) (places[c].is_in_box ? body_in_box : body_beyond) += volumes[c];
        if (!places[c].is_air()) continue;
        ++spaces;
        all += volumes[c];
        if (air < 0 || volumes[c] > volumes[air]) air = c;
    }
    if (body_in_box == 0) refuse_box("There is no body in the box of air", enclosure);
    if (air < 0) refuse_box("There is no air in the box", enclosure);
    if (body_beyond > 0)
        notes.push_back(fmt::format("{:.3g} % of the body lie beyond the box of air, and are cut off at {}.",
                                    100 * body_beyond / (body_in_box + body_beyond),
                                    fmt::join(faces_crossed(enclosure), ", ")));
    if (spaces > 1)
        notes.push_back(
            fmt::format("{} of the air in the box {} closed off from the rest and left out, {:.2g} % of its "
                        "volume.",
                        spaces == 2 ? "1 space" : fmt::format("{} spaces", spaces - 1), spaces == 2 ? "is" : "are",
                        100 * (all - volumes[air]) / all));
    return air;
}

void name_regions(DividedSpace& space, const std::vector<CellPlace>& places, std::int32_t air, const Bodies& bodies,
                  bool keeps_bodies) {
    std::set<std::string> taken;
    space.names = {unique_name("air", taken)};
    space.region_of_cell[air] = RegionIndex(0);
    if (!keeps_bodies) return;
    for (const std::string& name : bodies.names) space.names.push_back(unique_name(name, taken));
    for (std::int32_t c = 0; c < count_of(places); ++c)
        if (places[c].is_of_body_in_box()) space.region_of_cell[c] = RegionIndex(places[c].body.value() + 1);
}

// Takes the walls of the regions, of which a single one needs no sides.
void take_walls(Soup& soup, DividedSpace space) {
    std::vector<std::string> notes = std::move(soup.notes);
    give_sides(soup, std::move(space));
    soup.notes = std::move(notes);  // facets that are no walls any more were to go
    if (soup.region_names.size() == 1) {
        soup.sides.clear();
        soup.region_names.clear();
    }
    drop_unused_vertices(soup);
}

}  // namespace

void enclose(Soup& soup, Enclosure& enclosure, bool keeps_bodies, const std::function<void()>& check_cancelled) {
    const Bodies bodies = take_bodies(soup);
    rename_patches(soup, enclosure);
    append(soup, facets_of_box(enclosure.box, enclosure.edge, enclosure.face_names));
    weld_exactly(soup);
    Arrangement arrangement = arrange(soup.vertices, soup.facets, check_cancelled);
    if (!arrangement.unresolved.empty())
        throw Error(
            ErrorCode::input,
            fmt::format("The body cannot be cut by the box of air near {}. Move the box or the ground a little.",
                        place_text(arrangement.unresolved.front().where)));
    const std::vector<std::int32_t> parent = arrangement.parent;
    const std::vector<char> all(parent.size(), 1), none(parent.size(), 0);
    take_divided_facets(soup, std::move(arrangement), all, none);
    std::optional<DividedSpace> space = divide_space(soup);
    if (!space) refuse_box("Body and box of air do not divide space", enclosure);
    const std::vector<CellPlace> places = places_of_cells(space->cells, crossings_of(space->single, parent, bodies));
    const std::vector<double> volumes = cell_volumes(soup.vertices, space->single.facets, space->cells);
    const std::int32_t air = choose_air(places, volumes, enclosure, soup.notes);
    enclosure.body_volume = enclosure.box.volume() - volumes[air];
    name_regions(*space, places, air, bodies, keeps_bodies);
    take_walls(soup, *std::move(space));
    soup.seeds.clear();  // they name regions that are gone
    soup.holes.clear();
}

}  // namespace kerf

// A surface may be one body or several, and which it is may be said by sides of facets, by points of regions, by names
// of walls in a JSON, by files, by closed patches, or not at all. These are tried in that order, and where something is
// said it counts: if it does not fit facets that are sound by themselves, that is an error of its own
// (MisplacedRegion). Otherwise the surface is diagnosed as one body; only if that finds errors as bodies with common
// walls have them, regions are searched for, and they are taken only if the surface is clean with them. So a surface of
// one clean body costs nothing more than its diagnosis.
//
// If nothing fits, known bodies are diagnosed one by one, and the places where two of them do not fit come first.
// "Divided" is a copy of the soup with sides, which replaces the soup when it is taken.
#include "run/prepare/region_diagnosis.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "surface/diagnosis/given_bodies.h"
#include "surface/regions/region_finder.h"

namespace kerf {

namespace {

// Whether the diagnosis as one body finds defects as several bodies with common walls have them.
bool may_be_several_bodies(const Diagnosis& diagnosis) {
    constexpr std::array kinds = {DefectKind::duplicate_facet, DefectKind::coincident_shell,
                                  DefectKind::non_manifold_edge};
    return std::any_of(kinds.begin(), kinds.end(), [&](DefectKind kind) { return diagnosis.count(kind) > 0; });
}

void take_regions(CheckedSoup& checked, Soup divided, Diagnosis diagnosis) {
    checked.soup = std::move(divided);
    checked.diagnosis = std::move(diagnosis);
}

// Takes the regions that were named, or throws an error about them; but where facets have gaps or intersect, these are
// the defects. `find(soup)`: sets the sides. `file`: the file that names the regions, empty for that of the surface.
template <class Find>
void diagnose_said(CheckedSoup& checked, const DiagnosisOptions& options, const std::string& file, const Find& find) {
    Soup divided = checked.soup;
    bool is_found = false;
    try {
        is_found = find(divided);
    } catch (const Error& error) {
        checked.diagnosis = diagnose(checked.soup, options);
        const Diagnosis& found = checked.diagnosis;
        const bool is_double = found.count(DefectKind::duplicate_facet) > 0;  // and so on itself: no defect of walls
        if (found.count(DefectKind::open_edge) > 0) return;
        if (found.count(DefectKind::self_intersection) > 0 && !is_double) return;
        throw MisplacedRegion(file.empty() ? error.what() : fmt::format("{}: {}", file, error.what()));
    }
    if (is_found) checked.tidied.unused_vertices += drop_unused_vertices(divided);
    Diagnosis diagnosis = diagnose(divided, options);
    take_regions(checked, std::move(divided), std::move(diagnosis));
}

void diagnose_seeded(CheckedSoup& checked, const DiagnosisOptions& options) {
    diagnose_said(checked, options, "", [](Soup& soup) { return find_seeded_regions(soup); });
}

// The regions that the patch of the first facet is said to lie between.
void name_by_walls(Defect& defect, const Soup& soup, const std::vector<NamedWall>& walls) {
    if (defect.facets.empty()) return;
    const std::string& patch = soup.patch_names[soup.patch[defect.facets.front()]];
    const auto wall = std::find_if(walls.begin(), walls.end(), [&](const auto& other) { return other.patch == patch; });
    if (wall == walls.end()) return;
    for (const std::string& region : wall->regions)
        if (!region.empty()) defect.bodies.push_back(region);
}

void diagnose_named_walls(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options) {
    diagnose_said(checked, options, files.walls_file,
                  [&](Soup& soup) { return find_walled_regions(soup, files.walls); });
    if (!checked.soup.sides.empty()) return;
    for (Defect& defect : checked.diagnosis.defects) name_by_walls(defect, checked.soup, files.walls);
}

// Returns the file of each patch. A patch that a repair has made, such as a cap, is of the file with the first facet
// beside it.
std::vector<std::int32_t> files_of_patches(const Soup& soup, const InputFiles& files) {
    std::vector<std::int32_t> file_of_patch = files.file_of_patch;
    const auto is_made = [&](std::int32_t patch) { return std::cmp_greater_equal(patch, files.file_of_patch.size()); };
    std::map<UndirectedEdge, std::int32_t> made_beside;  // patches
    const auto for_each_edge = [&](bool of_made, const auto& visit) {
        for (std::size_t f = 0; f < soup.facets.size(); ++f)
            if (is_made(soup.patch[f]) == of_made)
                for (std::size_t i = 0; i < 3; ++i)
                    visit(undirected(soup.facets[f][i], soup.facets[f][(i + 1) % 3]), soup.patch[f]);
    };
    for_each_edge(true, [&](const UndirectedEdge& edge, std::int32_t patch) { made_beside.try_emplace(edge, patch); });
    file_of_patch.resize(std::max(soup.patch_names.size(), file_of_patch.size()), 0);
    if (made_beside.empty()) return file_of_patch;
    std::vector<char> is_known(file_of_patch.size(), 0);
    for_each_edge(false, [&](const UndirectedEdge& edge, std::int32_t patch) {
        const auto beside = made_beside.find(edge);
        if (beside != made_beside.end() && is_known[beside->second] == 0) {
            file_of_patch[beside->second] = file_of_patch[patch];
            is_known[beside->second] = 1;
        }
    });
    return file_of_patch;
}

// Returns the files as bodies, or else patches that are closed by themselves. None: the bodies are not known.
GivenBodies known_bodies(const Soup& soup, const InputFiles& files) {
    if (files.names.empty()) return closed_patches(soup);
    GivenBodies bodies{{}, files.names};
    const std::vector<std::int32_t> file_of_patch = files_of_patches(soup, files);
    for (const std::int32_t patch : soup.patch) bodies.of_facet.push_back(file_of_patch[patch]);
    return bodies;
}

// Whether the soup is one of several regions now.
bool take_found_regions(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options) {
    if (files.names.empty() && !may_be_several_bodies(checked.diagnosis)) return false;
    Soup divided = checked.soup;
    const bool is_given =
        !files.names.empty() && find_given_bodies(divided, files_of_patches(divided, files), files.names);
    if (!is_given && !find_touching_bodies(divided)) return false;
    const std::int64_t unused = drop_unused_vertices(divided);
    Diagnosis diagnosis = diagnose(divided, options);
    if (!diagnosis.clean()) return false;
    checked.tidied.unused_vertices += unused;
    take_regions(checked, std::move(divided), std::move(diagnosis));
    return true;
}

// Keeps all defects of the solids of one file, and names both bodies of intersections; places where two of them do not
// fit come first.
void tell_mismatches(CheckedSoup& checked, const GivenBodies& bodies, const Diagnosis& by_body) {
    std::vector<Defect>& defects = checked.diagnosis.defects;
    for (Defect& defect : defects) {
        if (defect.kind != DefectKind::self_intersection || defect.facets.size() != 2) continue;
        const std::int32_t a = bodies.of_facet[defect.facets[0]], b = bodies.of_facet[defect.facets[1]];
        if (a != b) defect.bodies = {bodies.names[std::min(a, b)], bodies.names[std::max(a, b)]};
    }
    std::vector<Defect> between;
    std::copy_if(by_body.defects.begin(), by_body.defects.end(), std::back_inserter(between), is_between_bodies);
    for (const Defect& defect : between) ++checked.diagnosis.counts[static_cast<std::size_t>(defect.kind)];
    defects.insert(defects.begin(), between.begin(), between.end());
}

// Shells inside of others that are turned like them are no voids where they are bodies of their own: patches with a
// name.
bool take_nested_bodies(CheckedSoup& checked, const GivenBodies& bodies, const DiagnosisOptions& options) {
    const std::vector<Defect>& defects = checked.diagnosis.defects;
    const auto is_other_error = [](const Defect& defect) {
        return defect.severity == Severity::error && defect.kind != DefectKind::ambiguous_shell;
    };
    if (checked.diagnosis.count(DefectKind::ambiguous_shell) == 0) return false;
    if (std::any_of(defects.begin(), defects.end(), is_other_error)) return false;
    Soup divided = checked.soup;
    if (!find_nested_bodies(divided, bodies.of_facet, bodies.names)) return false;
    Diagnosis diagnosis = diagnose(divided, options);
    if (!diagnosis.clean()) return false;
    divided.notes.push_back(
        fmt::format("Bodies lie inside of others: they are {} regions by their names, and each is cut out of what is "
                    "around it.",
                    divided.region_names.size()));
    checked.tidied.unused_vertices += drop_unused_vertices(divided);
    take_regions(checked, std::move(divided), std::move(diagnosis));
    return true;
}

// A surface of one body costs nothing more than its diagnosis. `files`: without the soup.
void diagnose_with_regions(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options) {
    if (!files.walls.empty()) return diagnose_named_walls(checked, files, options);
    if (checked.soup.sides.empty() && !checked.soup.seeds.empty()) return diagnose_seeded(checked, options);
    checked.diagnosis = diagnose(checked.soup, options);
    if (!checked.soup.sides.empty() || take_found_regions(checked, files, options) || checked.diagnosis.clean()) return;
    const GivenBodies bodies = known_bodies(checked.soup, files);
    if (bodies.names.empty() || take_nested_bodies(checked, bodies, options)) return;
    Diagnosis by_body = diagnose_bodies(checked.soup, bodies, options);
    if (files.names.empty())
        tell_mismatches(checked, bodies, by_body);
    else if (!by_body.clean())
        checked.diagnosis = std::move(by_body);
}

// Whether a shell inside of another one is a void or a second body does not matter if both are regions.
void diagnose_filled(CheckedSoup& checked, const DiagnosisOptions& options) {
    const std::vector<Defect>& defects = checked.diagnosis.defects;
    const auto is_hindrance = [](const Defect& defect) {
        return defect.severity == Severity::error && defect.kind != DefectKind::ambiguous_shell;
    };
    if (std::any_of(defects.begin(), defects.end(), is_hindrance)) return;
    Soup divided = checked.soup;
    if (!checked.diagnosis.dropped.empty()) drop_facets(divided, checked.diagnosis.dropped);
    if (!fill_voids(divided)) return;
    checked.tidied.unused_vertices += drop_unused_vertices(divided);
    Diagnosis diagnosis = diagnose(divided, options);
    take_regions(checked, std::move(divided), std::move(diagnosis));
}

// Adds gaps between regions, or between patches that are bodies of their own.
void look_for_gaps(CheckedSoup& checked) {
    if (!checked.diagnosis.clean()) return;
    if (!checked.soup.sides.empty()) return add_gaps(checked.diagnosis, checked.soup, {});
    if (checked.soup.patch_names.size() < 2) return;
    const GivenBodies bodies = separate_patches(checked.soup);
    const auto is_of_first = [&](std::int32_t body) { return body == bodies.of_facet.front(); };
    if (std::all_of(bodies.of_facet.begin(), bodies.of_facet.end(), is_of_first)) return;
    CheckedSoup turned = checked;
    apply_repairs(turned);
    GivenBodies kept{{}, bodies.names};
    std::vector<std::int32_t> number;
    for (std::int32_t f = 0; f < count_of(checked.soup.facets); ++f) {
        if (!checked.diagnosis.dropped.empty() && checked.diagnosis.dropped[f] != 0) continue;
        kept.of_facet.push_back(bodies.of_facet[f]);
        number.push_back(f);
    }
    add_gaps(checked.diagnosis, turned.soup, kept, number);
}

}  // namespace

void diagnose_regions(CheckedSoup& checked, const InputFiles& files, const DiagnosisOptions& options,
                      bool voids_are_regions) {
    for (const Vec3& hole : holes_outside(checked.soup))
        checked.soup.notes.push_back(fmt::format(
            "The point {} of a hole lies outside: no facets close around it, and it makes no void. Move it, or leave "
            "it out.",
            place_text(hole)));
    diagnose_with_regions(checked, files, options);
    if (voids_are_regions) diagnose_filled(checked, options);
    look_for_gaps(checked);
}

std::vector<std::string> notes_on_gaps(const CheckedSoup& checked) {
    std::vector<std::string> notes;
    for (const Defect& defect : checked.diagnosis.defects)
        if (defect.kind == DefectKind::body_gap)
            notes.push_back(fmt::format(
                "'{}' and '{}' do not touch: they are up to {:.6g} apart at {}. If they should, "
                "{}.",
                defect.bodies[0], defect.bodies[1], defect.measure, place_text(defect.where), advice(defect)));
    return notes;
}

}  // namespace kerf

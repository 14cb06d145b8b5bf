// A file is either refused, where no surface could be made of it, or diagnosed: diagnosed() sorts the errors of
// checking into these two. Of the errors of checking, only Error(input) is a refusal; all others are thrown on. Regions
// are summarised only of a surface that can be meshed, without the facets that its repairs leave out; one that is not
// closed is a refusal, too. For people, defects are grouped by kind and severity, and of many the worst are named; JSON
// has all of them, with numbers counted as in the file. Both end with the same advice, and with the remedy where one
// was looked for.
#include "run/report/file_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/ids.h"
#include "base/core/number_text.h"
#include "base/core/shell_word.h"
#include "base/geometry/box.h"
#include "base/geometry/triangle.h"
#include "files/io/cad_body.h"
#include "files/io/json.h"
#include "run/prepare/region_diagnosis.h"
#include "run/prepare/slivers.h"
#include "run/report/repair_json.h"
#include "run/report/repair_text.h"
#include "surface/complex/inverted_region.h"
#include "surface/complex/mass_properties.h"
#include "surface/complex/point_inside.h"
#include "surface/regions/regions.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

Json defect_json(const Defect& defect, const Soup& soup) {
    Json json = {{"kind", name(defect.kind)},
                 {"severity", name(defect.severity)},
                 {"facets", soup.file_facets(defect.facets)},
                 {"vertices", soup.file_vertices(defect.vertices)},
                 {"where", {defect.where.x(), defect.where.y(), defect.where.z()}},
                 {"what_to_do", advice(defect)}};
    if (defect.kind == DefectKind::needle) json["angle_deg"] = defect.measure;
    if (defect.kind == DefectKind::open_edge || defect.kind == DefectKind::short_edge) json["length"] = defect.measure;
    if (!defect.bodies.empty()) json["regions"] = defect.bodies;
    if (is_between_bodies(defect)) json["distance"] = defect.measure;
    return json;
}

// Returns the regions of a soup that has been repaired, in the order of Soup::region_names; none if it has no sides.
// O(#F log #F).
Array<RegionIndex, RegionSummary> summarize_regions(const Soup& soup) {
    Array<RegionIndex, RegionSummary> regions;
    if (soup.sides.empty()) return regions;
    const Complex complex = make_complex(soup);
    for (const RegionIndex region : ids<RegionIndex>(complex.region_count())) {
        const Surface surface = complex.surface_of(region);
        regions.push_back(
            {soup.region_names[region.value()], enclosed_volume(surface), find_shells(surface).count, 0, {}});
    }
    std::map<std::pair<RegionIndex, RegionIndex>, double> walls;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const auto [front, back] = soup.sides[f];
        const auto [a, b, c] = soup.facets[f];
        const double area = triangle_area(soup.vertices[a], soup.vertices[b], soup.vertices[c]);
        if (soup.sides[f].is_wall()) {
            walls[{front, back}] += area;
            walls[{back, front}] += area;
        } else {
            regions[std::max(front, back)].outer_area += area;
        }
    }
    for (const auto& [sides, area] : walls)
        regions[sides.first].walls.push_back({soup.region_names[sides.second.value()], area, sides.second});
    return regions;
}

// The regions of a surface that can be meshed. Copies of facets that its repairs leave out have sides, too, so they go
// first.
Soup without_dropped(const CheckedSoup& checked) {
    Soup soup = checked.soup;
    if (!checked.diagnosis.dropped.empty()) drop_facets(soup, checked.diagnosis.dropped);
    return soup;
}

Array<RegionIndex, RegionSummary> regions_of(const CheckedSoup& checked) {
    if (checked.diagnosis.dropped.empty() || checked.soup.sides.empty()) return summarize_regions(checked.soup);
    return summarize_regions(without_dropped(checked));
}

// Measures of a surface: the box around it, its area, and the volume if it can be meshed.
struct SurfaceMeasures {
    Box box;
    double area = 0;
    std::optional<double> volume = {};
};

// Of several regions the volume is the sum.
SurfaceMeasures measures_of(const FileDiagnosis& found) {
    const Soup& soup = found.checked.soup;
    SurfaceMeasures measures{box_around_finite(soup.vertices)};
    const std::vector<char>& dropped = found.checked.diagnosis.dropped;
    for (std::size_t f = 0; f < soup.facets.size(); ++f) {
        const double own = triangle_area(soup.vertices, soup.facets[f]);
        if (std::isfinite(own) && (dropped.empty() || dropped[f] == 0)) measures.area += own;
    }
    if (!found.can_be_meshed()) return measures;
    if (!found.regions.empty()) {
        measures.volume = 0;
        for (const RegionSummary& region : found.regions) *measures.volume += region.volume;
    } else {
        CheckedSoup turned = found.checked;
        apply_repairs(turned);
        measures.volume = enclosed_volume(turned.soup.vertices, turned.soup.facets);
    }
    return measures;
}

std::string text_of(const SurfaceMeasures& measures) {
    if (measures.box.isEmpty()) return "";
    return fmt::format("  extent    {:.6g} x {:.6g} x {:.6g}, from ({:.6g}) to ({:.6g}); area {:.6g}{}\n",
                       measures.box.sizes().x(), measures.box.sizes().y(), measures.box.sizes().z(),
                       fmt::join(measures.box.min(), ", "), fmt::join(measures.box.max(), ", "), measures.area,
                       measures.volume ? fmt::format(", volume {:.6g}", *measures.volume) : "");
}

void add_measures(const SurfaceMeasures& measures, Json& json) {
    if (measures.box.isEmpty()) return;
    json["extent"] = Json::array();
    for (const Vec3& corner : {measures.box.min(), measures.box.max()})
        json["extent"].push_back({corner.x(), corner.y(), corner.z()});
    json["area"] = measures.area;
    json["volume"] = measures.volume ? Json(*measures.volume) : Json();
}

Json regions_json(const Array<RegionIndex, RegionSummary>& regions) {
    Json json = Json::array();
    for (const RegionSummary& region : regions) {
        Json walls = Json::array();
        for (const CommonWall& wall : region.walls) walls.push_back({{"region", wall.region}, {"area", wall.area}});
        json.push_back({{"name", region.name},
                        {"volume", region.volume},
                        {"shells", region.shells},
                        {"outer_area", region.outer_area},
                        {"walls", std::move(walls)}});
    }
    return json;
}

std::string region_tables(const Array<RegionIndex, RegionSummary>& regions) {
    if (regions.empty()) return "The surface bounds one region, which has no name.\n";
    std::string text = fmt::format("{:>12} {:>6} {:>12}  {}\n", "volume", "shells", "outside", "name");
    std::string walls;
    for (const RegionIndex r : regions.ids()) {
        const RegionSummary& region = regions[r];
        text += fmt::format("{:>12.6g} {:>6} {:>12.6g}  {}\n", region.volume, region.shells, region.outer_area,
                            region.name);
        for (const CommonWall& wall : region.walls)
            if (wall.number > r) walls += fmt::format("{:>12.6g}  {}  {}\n", wall.area, region.name, wall.region);
    }
    return text + (walls.empty() ? "" : fmt::format("\n{:>12}  wall between\n{}", "area", walls));
}

// Returns an option for each region, with a point inside of it.
std::string options_of_regions(const CheckedSoup& checked) {
    const Complex complex = make_complex(without_dropped(checked));
    std::string text;
    for (const RegionIndex r : ids<RegionIndex>(complex.region_names().size())) {
        const SurfaceArrays own = complex.arrays_of(r);
        text += fmt::format("--region {}={:.6g}\n", complex.region_names()[r.value()],
                            fmt::join(point_inside(own.vertices, own.facets), ","));
    }
    return text.empty() ? "" : "\nPoints inside, for facets that do not say what they bound:\n" + text;
}

// Returns a line a region, with its volume, shells and first walls; at most 50 lines.
std::string lines_of_regions(const Array<RegionIndex, RegionSummary>& regions) {
    constexpr std::size_t most = 50, most_walls = 3;
    std::string text;
    for (std::size_t r = 0; r < std::min(most, regions.size()); ++r) {
        const RegionSummary& region = regions[r];
        text += fmt::format("  region    {}: volume {:.6g}, {} shell{}", region.name, region.volume, region.shells,
                            region.shells == 1 ? "" : "s");
        if (region.outer_area > 0) text += fmt::format(", outside {:.6g}", region.outer_area);
        for (std::size_t w = 0; w < std::min(most_walls, region.walls.size()); ++w)
            text += fmt::format(", wall to {} {:.6g}", region.walls[w].region, region.walls[w].area);
        if (region.walls.size() > most_walls)
            text += fmt::format(" and {} more (--list-regions)", region.walls.size() - most_walls);
        text += "\n";
    }
    if (regions.size() > most) text += fmt::format("{:12}and {} more\n", "", regions.size() - most);
    return text;
}

// Returns a line on a region that fills a box with the others inside of it, as air in a tunnel does: these may be left
// out. Empty if there is none.
std::string line_on_air(const Array<RegionIndex, RegionSummary>& regions, const SurfaceMeasures& measures) {
    constexpr double rounding = 1e-9;
    constexpr std::size_t most_named = 3;
    if (regions.size() < 2) return "";
    const Vec3 sides = measures.box.sizes();
    const double area = 2 * (sides.x() * sides.y() + sides.y() * sides.z() + sides.z() * sides.x());
    std::string air;
    std::vector<std::string> holes;
    for (const RegionSummary& region : regions)
        if (region.outer_area > 0 && std::abs(region.outer_area / area - 1) < rounding)
            air = region.name;
        else if (region.outer_area > 0)
            return "";
        else if (holes.size() < most_named)
            holes.push_back("--hole " + shell_word(region.name));
    if (air.empty() || std::abs(measures.volume.value_or(0) / measures.box.volume() - 1) > rounding) return "";
    if (regions.size() > most_named + 1) holes.emplace_back("...");
    return fmt::format("  flow      {} is a box around the others: {} leaves them empty, and {} alone is meshed.\n",
                       air, fmt::join(holes, " "), air);
}

Json surface_json(const FileDiagnosis& found) {
    const CheckedSoup& checked = found.checked;
    const Soup& soup = checked.soup;
    Json counts = Json::object(), defects = Json::array();
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (const std::int64_t n = checked.diagnosis.counts[k]) counts[name(static_cast<DefectKind>(k))] = n;
    for (const Defect& defect : checked.diagnosis.defects) defects.push_back(defect_json(defect, soup));
    Json json = {{"path", found.path},
                 {"can_be_meshed", checked.diagnosis.clean()},
                 {"vertices", soup.vertices.size()},
                 {"faces", soup.facets.size()},
                 {"patches", soup.patch_names},
                 {"regions", regions_json(found.regions)},
                 {"notes", soup.notes},
                 {"repairs", json_of_counts(checked.tidied, checked.ladder)},
                 {"counts", std::move(counts)},
                 {"defects", std::move(defects)}};
    add_measures(measures_of(found), json);
    if (!checked.ladder.steps.empty()) json["repair"] = json_of_repair(checked.ladder);
    if (found.remedy) json["remedy"] = json_of_remedy(*found.remedy, found.path);
    return json;
}

Json refused_json(const std::string& path, const RefusedFile& refused) {
    return {{"path", path},
            {"can_be_meshed", false},
            {"counts", {{refused.kind, 1}}},
            {"defects", Json::array({Json{{"kind", refused.kind},
                                          {"severity", "error"},
                                          {"facets", Json::array()},
                                          {"vertices", Json::array()},
                                          {"message", refused.error.what()}}})}};
}

std::string place_and_measure(const Defect& defect, const Soup& soup) {
    const std::string text = place(defect, soup);
    if (defect.kind == DefectKind::needle) return fmt::format("{}, {:.3g} deg", text, defect.measure);
    if (defect.kind == DefectKind::open_edge)
        return fmt::format("{}, {} edges, length {:.6g}", text, defect.facets.size(), defect.measure);
    if (defect.kind == DefectKind::short_edge) return fmt::format("{}, length {:.3g}", text, defect.measure);
    return text;
}

// Returns the advice for a defect. Where openings have the size of inlets, as the ends of a vessel, patches for them
// are what is wanted first.
std::string way_out_of(const Defect& defect, std::int64_t caps) {
    if (defect.kind != DefectKind::open_edge || caps == 0) return advice(defect);
    return fmt::format("--cap closes {} by {} of {} own, for inlets and outlets; or {}",
                       caps == 1 ? "the large one" : fmt::format("the {} large ones", caps),
                       caps == 1 ? "a patch" : "patches", caps == 1 ? "its" : "their", advice(defect));
}

// Returns the text of the defects of one kind and severity, in their order. A single one takes one line; of many, the
// worst are named: the longest loops, the smallest angles, the shortest edges, the first of those without a measure.
std::string group_text(const CheckedSoup& checked, std::vector<const Defect*> defects, std::int64_t caps) {
    constexpr std::int64_t most_named = 10;
    std::stable_sort(defects.begin(), defects.end(), [](const Defect* a, const Defect* b) {
        return a->kind == DefectKind::open_edge ? a->measure > b->measure : a->measure < b->measure;
    });
    const Defect& worst = *defects.front();
    const std::int64_t listed = std::ssize(defects);
    const std::int64_t count =
        worst.severity == Severity::warning ? checked.diagnosis.count(worst.kind) : listed;  // not all are listed
    const std::string head = fmt::format("  {:<9} {}", name(worst.severity), counted(count, worst.kind));
    const std::string way = way_out_of(worst, caps);
    if (count == 1) return fmt::format("{}: {}; {}.\n", head, place_and_measure(worst, checked.soup), way);
    std::string text = fmt::format("{}; {}:\n", head, way);
    const std::int64_t named = std::min(listed, most_named);
    for (std::int64_t i = 0; i < named; ++i)
        text += fmt::format("{:12}{}\n", "", place_and_measure(*defects[i], checked.soup));
    const std::int64_t more = count - named;
    return more > 0 ? fmt::format("{}{:12}and {} more\n", text, "", more) : text;
}

// Groups are ordered by kind, and the errors of a kind come before what is repaired.
std::string text_of_defects(const CheckedSoup& checked, bool errors_only, std::int64_t caps) {
    std::map<std::pair<DefectKind, Severity>, std::vector<const Defect*>> groups;
    for (const Defect& defect : checked.diagnosis.defects)
        if (!errors_only || defect.severity == Severity::error)
            groups[{defect.kind, defect.severity}].push_back(&defect);
    std::string text;
    for (const auto& [kind, defects] : groups) text += group_text(checked, defects, caps);
    return text;
}

void require_good(const InputOptions& options, double needle_angle_deg) {
    options.check();
    require_in(needle_angle_range, "needle-angle", needle_angle_deg);
}

// Returns RefusedFile::kind of an error of the input.
std::string kind_of_refusal(const Error& error) {
    if (const auto* solid = dynamic_cast<const SolidDefect*>(&error)) return solid->kind();
    if (dynamic_cast<const MisplacedRegion*>(&error)) return MisplacedRegion::kind;
    return dynamic_cast<const WrongRow*>(&error) ? WrongRow::kind : "unreadable";
}

// Makes a diagnosis. `check` returns the CheckedSoup of the surface, or throws why there is none.
template <class Check>
FileDiagnosis diagnosed(const std::string& path, const Check& check) {
    FileDiagnosis found{path, {}, {}, {}, {}};
    try {
        found.checked = check();
    } catch (const Error& error) {
        if (error.code() != ErrorCode::input) throw;
        found.refused = {kind_of_refusal(error), error};
    }
    if (!found.can_be_meshed()) return found;
    try {
        found.regions = regions_of(found.checked);
    } catch (const Error& error) {
        found.refused = {dynamic_cast<const InvertedRegion*>(&error) ? InvertedRegion::kind : "open region", error};
    }
    return found;
}

}  // namespace

int FileDiagnosis::exit_code() const {
    if (refused) return static_cast<int>(refused->error.code());
    return can_be_meshed() ? 0 : static_cast<int>(ErrorCode::input);
}

FileDiagnosis diagnose_file(const std::string& path, const InputOptions& options, double needle_angle_deg,
                            const std::function<void()>& check_cancelled) {
    require_good(options, needle_angle_deg);
    return diagnosed(path, [&] { return check_input(path, options, needle_angle_deg, check_cancelled); });
}

FileDiagnosis diagnose_arrays(Soup soup, const InputOptions& options, double needle_angle_deg,
                              const std::function<void()>& check_cancelled) {
    require_good(options, needle_angle_deg);
    return diagnosed(name_of_arrays,
                     [&] { return check_arrays(std::move(soup), options, needle_angle_deg, check_cancelled); });
}

std::string defects_text(const CheckedSoup& checked, bool errors_only) {
    return text_of_defects(checked, errors_only, 0);
}

std::string defect_text(const Defect& defect, const Soup& soup) {
    return fmt::format("{}: {}; {}.", name(defect.kind), place_and_measure(defect, soup), advice(defect));
}

std::string to_json(const FileDiagnosis& found) {
    const Json json = found.refused ? refused_json(found.path, *found.refused) : surface_json(found);
    return json_text(json, 2) + "\n";
}

std::string to_text(const FileDiagnosis& found) {
    if (found.refused) return fmt::format("  error     {}: {}\n", found.refused->kind, found.refused->error.what());
    const CheckedSoup& checked = found.checked;
    const Soup& soup = checked.soup;
    std::string text =
        fmt::format("{}: {} facets, {} vertices, {} patch{}\n", found.path, soup.facets.size(), soup.vertices.size(),
                    soup.patch_names.size(), soup.patch_names.size() == 1 ? "" : "es");
    for (const std::string& note : soup.notes) text += fmt::format("  note      {}\n", note);
    const SurfaceMeasures measures = measures_of(found);
    text += text_of(measures) + to_text(checked.ladder) + lines_of_regions(found.regions);
    text += line_on_air(found.regions, measures);
    text += text_of_defects(checked, false, found.remedy ? found.remedy->caps : 0);
    const bool clean = found.can_be_meshed();
    if (const Slivers slivers = find_slivers(soup.vertices, soup.facets);
        clean && slivers.spoil_cells() && !soup.is_of_model)  // else all is remeshed, whatever there is
        text += fmt::format(
            "  slivers   {} of {} facets have angles below 10 degrees: kerf mesh makes new ones, unless --surface "
            "split or "
            "keep is given.\n",
            grouped(slivers.count), grouped(slivers.facets));
    text += clean ? "It can be meshed.\n" : "It cannot be meshed as it is.\n";
    return found.remedy ? text + to_text(*found.remedy, found.path) : text;
}

std::string tables_of_regions(const FileDiagnosis& found) {
    if (found.refused) throw found.refused->error;
    if (!found.can_be_meshed())
        throw Error(ErrorCode::input,
                    fmt::format("{}: {}", found.path, found.checked.diagnosis.summary(found.checked.soup)));
    return region_tables(found.regions) + options_of_regions(found.checked);
}

std::vector<PatchSummary> patches_of_run(FileDiagnosis found, const InputOptions& options) {
    if (found.refused) throw found.refused->error;
    CheckedSoup& checked = found.checked;
    if (checked.diagnosis.clean())
        apply_repairs(checked);
    else if (options.feature_angle_deg > 0)
        throw Error(ErrorCode::input, fmt::format("{}: {} Only a surface that can be meshed is divided at "
                                                  "--feature-angle: leave that out, or repair the surface.",
                                                  found.path, checked.diagnosis.summary(checked.soup)));
    if (options.feature_angle_deg > 0 && checked.soup.patch_names.size() == 1)
        make_feature_patches(checked.soup, options.feature_angle_deg);
    std::vector<PatchSummary> patches = summarize_patches(checked.soup);
    std::map<std::string, std::string> faces;
    for (const PatchFace& face : checked.faces_of_patches) faces.emplace(face.patch, to_text(face));
    for (PatchSummary& patch : patches)
        if (const auto face = faces.find(patch.name); face != faces.end()) patch.face = face->second;
    return patches;
}

}  // namespace kerf

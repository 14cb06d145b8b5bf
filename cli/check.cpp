#include "cli/check.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/cad_body.h"
#include "io/offenders_writer.h"
#include "io/output_file.h"
#include "io/standard_streams.h"
#include "prepare/remeshing.h"
#include "report/patch_summary.h"
#include "surface/regions.h"

namespace kerf {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Defect& defect, const Soup& soup) {
    Json json = {{"kind", name(defect.kind)},
                 {"severity", name(defect.severity)},
                 {"facets", soup.file_facets(defect.facets)},
                 {"vertices", soup.file_vertices(defect.vertices)},
                 {"where", {defect.where.x(), defect.where.y(), defect.where.z()}},
                 {"what_to_do", remedy(defect)}};
    if (defect.kind == DefectKind::needle) json["angle_deg"] = defect.measure;
    if (defect.kind == DefectKind::open_edge || defect.kind == DefectKind::short_edge) json["length"] = defect.measure;
    return json;
}

Json to_json(const InputRepairs& r) {
    return {{"vertices_welded", r.welded_vertices}, {"vertices_unused", r.unused_vertices},
            {"facets_dropped", r.dropped_facets},   {"vertices_merged", r.merged_vertices},
            {"facets_removed", r.removed_facets},   {"holes_filled", r.filled_holes},
            {"facets_added", r.added_facets}};
}

void print_json(const Json& json) { print_data(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"); }

void print_json(const std::string& path, const CheckedSoup& checked) {
    const Soup& soup = checked.soup;
    Json counts = Json::object(), defects = Json::array();
    for (std::size_t k = 0; k < defect_kind_count; ++k)
        if (const std::int64_t n = checked.diagnosis.counts[k]) counts[name(static_cast<DefectKind>(k))] = n;
    for (const Defect& defect : checked.diagnosis.defects) defects.push_back(to_json(defect, soup));
    print_json(Json{{"path", path},
                    {"can_be_meshed", checked.diagnosis.clean()},
                    {"vertices", soup.vertices.size()},
                    {"faces", soup.facets.size()},
                    {"patches", soup.patch_names},
                    {"notes", soup.notes},
                    {"repairs", to_json(checked.repairs)},
                    {"counts", std::move(counts)},
                    {"defects", std::move(defects)}});
}

std::string place_and_measure(const Defect& defect, const Soup& soup) {
    const std::string text = place(defect, soup);
    if (defect.kind == DefectKind::needle) return fmt::format("{}, {:.3g} deg", text, defect.measure);
    if (defect.kind == DefectKind::open_edge)
        return fmt::format("{}, {} edges, length {:.6g}", text, defect.facets.size(), defect.measure);
    if (defect.kind == DefectKind::short_edge) return fmt::format("{}, length {:.3g}", text, defect.measure);
    return text;
}

// The defects of one kind and severity, in their order. A single one takes one line; of many, the worst are named: the
// longest loops, the smallest angles, the shortest edges, the first of what has no measure.
std::string group_text(const CheckedSoup& checked, std::vector<const Defect*> defects) {
    constexpr std::size_t most_named = 10;
    std::stable_sort(defects.begin(), defects.end(), [](const Defect* a, const Defect* b) {
        return a->kind == DefectKind::open_edge ? a->measure > b->measure : a->measure < b->measure;
    });
    const Defect& worst = *defects.front();
    const auto listed = static_cast<std::int64_t>(defects.size());
    const std::int64_t count =
        worst.severity == Severity::warning ? checked.diagnosis.count(worst.kind) : listed;  // not all are listed
    const std::string head = fmt::format("  {:<9} {}", name(worst.severity), counted(count, worst.kind));
    if (count == 1) return fmt::format("{}: {}; {}.\n", head, place_and_measure(worst, checked.soup), remedy(worst));
    std::string text = fmt::format("{}; {}:\n", head, remedy(worst));
    const std::size_t named = std::min(defects.size(), most_named);
    for (std::size_t i = 0; i < named; ++i)
        text += fmt::format("{:12}{}\n", "", place_and_measure(*defects[i], checked.soup));
    const std::int64_t more = count - static_cast<std::int64_t>(named);
    return more > 0 ? fmt::format("{}{:12}and {} more\n", text, "", more) : text;
}

// By kind, and the errors of a kind before what is repaired.
std::string defects_text(const CheckedSoup& checked) {
    std::map<std::pair<DefectKind, Severity>, std::vector<const Defect*>> groups;
    for (const Defect& defect : checked.diagnosis.defects) groups[{defect.kind, defect.severity}].push_back(&defect);
    std::string text;
    for (const auto& [kind, defects] : groups) text += group_text(checked, defects);
    return text;
}

void print_text(const CheckRequest& request, CheckedSoup& checked) {
    const Diagnosis& diagnosis = checked.diagnosis;
    std::string text = fmt::format("{}: {} facets, {} vertices, {} patch{}\n", request.path, checked.soup.facets.size(),
                                   checked.soup.vertices.size(), checked.soup.patch_names.size(),
                                   checked.soup.patch_names.size() == 1 ? "" : "es");
    for (const std::string& note : checked.soup.notes) text += fmt::format("  note      {}\n", note);
    text += defects_text(checked);
    const bool clean = diagnosis.clean();
    const bool more = diagnosis.defects.size() > 1;
    if (const std::string note = sliver_note(find_slivers(checked.soup.vertices, checked.soup.facets), request.path);
        clean && !note.empty() && !checked.soup.is_of_model)  // else kerf mesh remeshes it anyway
        text += fmt::format("  slivers   {}\n", note);
    text += clean ? "It can be meshed.\n" : "It cannot be meshed as it is.\n";
    if (more) text += "--json lists all, --offenders FILE.vtu shows them in ParaView.\n";
    print_data(text);
}

// As a run would have them: those of the file, or those that --feature-angle makes.
int list_patches(const CheckRequest& request, CheckedSoup& checked) {
    if (checked.diagnosis.clean())
        apply_repairs(checked);
    else if (request.options.feature_angle_deg > 0)
        throw Error(ErrorCode::input, fmt::format("{}: {} Only a surface that can be meshed is divided at "
                                                  "--feature-angle: leave that out, or repair the surface.",
                                                  request.path, checked.diagnosis.summary(checked.soup)));
    Soup& soup = checked.soup;
    if (request.options.feature_angle_deg > 0 && soup.patch_names.size() == 1)
        make_feature_patches(soup, request.options.feature_angle_deg);
    const std::string spellings = spellings_text(soup.patch_names);
    print_data(to_text(summarize_patches(soup)) + (spellings.empty() ? "" : "\n" + spellings));
    return 0;
}

// The reader stops at the first thing that it does not understand, or of which it cannot make a surface.
int report_refused(const CheckRequest& request, const Error& error, const std::string& kind) {
    if (request.json)
        print_json(Json{{"path", request.path},
                        {"can_be_meshed", false},
                        {"counts", {{kind, 1}}},
                        {"defects", Json::array({Json{{"kind", kind},
                                                      {"severity", "error"},
                                                      {"facets", Json::array()},
                                                      {"vertices", Json::array()},
                                                      {"message", error.what()}}})}});
    else
        print_data(fmt::format("  error     {}: {}\n", kind, error.what()));
    return static_cast<int>(error.code());
}

}  // namespace

int check_surface(const CheckRequest& request) {
    request.options.check();
    refuse_to_overwrite(request.path, "--offenders", request.offenders_file);
    require_writable("--offenders", request.offenders_file);
    require_in(needle_angle_range, "needle-angle", request.needle_angle_deg);
    CheckedSoup checked;
    try {
        checked = check_input(request.path, request.options, request.needle_angle_deg);
    } catch (const SolidDefect& defect) {
        return report_refused(request, defect, defect.kind());
    } catch (const Error& error) {
        if (error.code() != ErrorCode::input) throw;
        return report_refused(request, error, "unreadable");
    }
    if (request.list_patches) return list_patches(request, checked);
    if (!request.offenders_file.empty()) write_offenders(request.offenders_file, checked.soup, checked.diagnosis);
    if (request.json)
        print_json(request.path, checked);
    else
        print_text(request, checked);
    return checked.diagnosis.clean() ? 0 : static_cast<int>(ErrorCode::input);
}

}  // namespace kerf

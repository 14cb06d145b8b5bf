#include "cli/check.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "io/offenders_writer.h"
#include "io/output_file.h"
#include "io/standard_streams.h"

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

// One line for the defects of equal kind and severity; of needles, the worst is named.
std::string kind_text(const CheckedSoup& checked, std::vector<Defect>::const_iterator first,
                      std::vector<Defect>::const_iterator last) {
    const auto worst = std::min_element(first, last, [](const Defect& a, const Defect& b) {
        return a.kind == DefectKind::open_edge ? a.measure > b.measure : a.measure < b.measure;
    });
    const bool is_warning = first->severity == Severity::warning;
    const std::int64_t count = is_warning ? checked.diagnosis.count(first->kind) : last - first;
    const bool is_measured = first->measure > 0;
    std::string measure;
    if (first->kind == DefectKind::needle) measure = fmt::format(", {:.3g} deg", worst->measure);
    if (first->kind == DefectKind::open_edge)
        measure = fmt::format(", {} edges, length {:.6g}", worst->facets.size(), worst->measure);
    if (first->kind == DefectKind::short_edge) measure = fmt::format(", length {:.3g}", worst->measure);
    return fmt::format("  {:<9} {}: {}{}{}; {}.\n", name(first->severity), counted(count, first->kind),
                       count == 1    ? ""
                       : is_measured ? "the worst "
                                     : "the first ",
                       place(*worst, checked.soup), measure, remedy(*first));
}

void print_text(const CheckRequest& request, CheckedSoup& checked) {
    const Diagnosis& diagnosis = checked.diagnosis;
    std::string text = fmt::format("{}: {} facets, {} vertices, {} patch{}\n", request.path, checked.soup.facets.size(),
                                   checked.soup.vertices.size(), checked.soup.patch_names.size(),
                                   checked.soup.patch_names.size() == 1 ? "" : "es");
    for (const std::string& note : checked.soup.notes) text += fmt::format("  note      {}\n", note);
    for (auto first = diagnosis.defects.begin(); first != diagnosis.defects.end();) {
        const auto last = std::find_if(first, diagnosis.defects.end(), [&](const Defect& d) {
            return d.kind != first->kind || d.severity != first->severity;
        });
        text += kind_text(checked, first, last);
        first = last;
    }
    const bool clean = diagnosis.clean();
    const bool more = diagnosis.defects.size() > 1;
    text += clean ? "It can be meshed.\n" : "It cannot be meshed as it is.\n";
    if (more) text += "--json lists all, --offenders FILE.vtu shows them in ParaView.\n";
    print_data(text);
}

// The reader stops at the first thing that it does not understand.
int report_unreadable(const CheckRequest& request, const Error& error) {
    if (request.json)
        print_json(Json{{"path", request.path},
                        {"can_be_meshed", false},
                        {"counts", {{"unreadable", 1}}},
                        {"defects", Json::array({Json{{"kind", "unreadable"},
                                                      {"severity", "error"},
                                                      {"facets", Json::array()},
                                                      {"vertices", Json::array()},
                                                      {"message", error.what()}}})}});
    else
        print_data(fmt::format("  error     unreadable: {}\n", error.what()));
    return static_cast<int>(error.code());
}

}  // namespace

int check_surface(const CheckRequest& request) {
    request.options.check();
    refuse_to_overwrite(request.path, "--offenders", request.offenders_file);
    require_writable("--offenders", request.offenders_file);
    if (!(request.needle_angle_deg >= 0 && request.needle_angle_deg <= 60))
        throw Error(ErrorCode::usage, fmt::format("--needle-angle is {}, but it must be 0 (no needles) to 60 degrees.",
                                                  request.needle_angle_deg));
    CheckedSoup checked;
    try {
        checked = check_input(request.path, request.options, request.needle_angle_deg);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::input) throw;
        return report_unreadable(request, error);
    }
    if (!request.offenders_file.empty()) write_offenders(request.offenders_file, checked.soup, checked.diagnosis);
    if (request.json)
        print_json(request.path, checked);
    else
        print_text(request, checked);
    return checked.diagnosis.clean() ? 0 : static_cast<int>(ErrorCode::input);
}

}  // namespace kerf

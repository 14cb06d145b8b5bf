// Rows of the tree are filled in two passes over report.json: "tree" has the nodes as they were when they were cut,
// "parts" has the parts as they are at the end. The second overwrites the first, because straight cuts of neighbours
// change a part after its node was described. Numbers that are not finite are null in the report and become -1, which
// stands for "not known". Members that reports of older versions do not have get defaults, and an option of another
// version becomes a note, so that its run can be shown. Files are only compared by their sizes here; their hashes are
// checked when they are read (checked_files.h).
#include "viewer/model/inside/run_report.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/io/json.h"
#include "files/io/listed_files.h"
#include "files/io/path_text.h"
#include "files/part/run_names.h"
#include "fill/mesh/quality.h"
#include "run/report/cut_json.h"

namespace kerf::view {

namespace {

using Json = nlohmann::json;

// Numbers that are not finite are null in a report.
double number(const Json& json, const char* name) {
    const auto found = json.find(name);
    return found != json.end() && found->is_number() ? found->get<double>() : -1;
}

Vec3 vector_of(const Json& json) {
    Vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = json.at(i).get<double>();
    return v;
}

void read_node(const Json& node, Tree& tree) {
    TreeRow& row = tree.at(node.at("id").get<NodeId>());
    row.state = node.at("children").empty() ? NodeState::waiting : NodeState::divided;
    row.leaves = node.at("leaves").get<std::int32_t>();
    row.regions = node.value("regions", 1);
    row.vertices = node.at("vertices").get<std::int64_t>();
    row.facets = node.at("faces").get<std::int64_t>();
    row.volume = number(node, "volume");
    if (row.regions > 1) return;  // which have axes, and are not cut
    row.centroid = vector_of(node.at("centroid"));
    row.eigenvalues = vector_of(node.at("eigenvalues"));
    for (int i = 0; i < 3; ++i) row.axes.col(i) = vector_of(node.at("axes").at(i));
    if (!node.contains("cut")) return;
    row.cut = cut_of_json(node.at("cut"));
    row.seconds = row.cut->seconds;
}

// Straight cuts of neighbours change a part after its node was described.
void read_part_row(const Json& part, bool meshed, Tree& tree) {
    TreeRow& row = tree.at(part.at("id").get<NodeId>());
    row.vertices = part.at("surface_vertices").get<std::int64_t>();
    row.facets = part.at("surface_faces").get<std::int64_t>();
    row.volume = number(part, "surface_volume");
    row.load = number(part, "load");
    row.rank = part.at("rank").get<std::int32_t>();
    row.region = RegionIndex(part.value("region", -1));
    if (!meshed) return;
    row.tets = part.at("tets").get<std::int64_t>();
    row.seconds = number(part, "seconds");
    row.filled_by = name_of_filler(part.value("mesher", ""), part.value("way", ""));
    row.core_tets = part.value("core_tets", std::int64_t{0});
    row.state = part.contains("error") ? NodeState::failed : NodeState::done;
    row.message = part.value("error", "");
}

// The report tells regions of parts only. Children have larger numbers than their parents.
void set_regions_of_nodes(Tree& tree) {
    for (auto row = tree.rows.rbegin(); row != tree.rows.rend(); ++row)
        if (!row->leaf() && row->regions == 1)
            if (const TreeRow* child = tree.find(child_of(row->id, 0))) row->region = child->region;
}

std::string option_text(const Json& value) {
    if (value.is_array()) return join_items(value.get<std::vector<std::string>>());
    return value.is_string() ? path_of_text(value.get<std::string>()) : json_text(value);
}

// The run is shown though an option of another version is not known.
void read_options(const Json& json, RunReportFile& report) {
    for (const auto& [name, value] : json.items()) {
        try {
            set_options(report.options, {{name, option_text(value)}}, "The report");
        } catch (const Error&) {
            report.notes.push_back(fmt::format("The option {} of the run is not known to this version", name));
        }
    }
}

std::optional<MeasureHistogram> read_histogram(const Json& quality, const char* measure) {
    MeasureHistogram histogram;
    const Json& all = quality.at("all").at(measure);
    histogram.edges = all.at("histogram").at("edges").get<std::vector<double>>();
    const auto counts = [&](const char* cells) {
        return quality.at(cells).at(measure).at("histogram").at("counts").get<std::vector<std::int64_t>>();
    };
    histogram.all = counts("all");
    histogram.interface = counts("interface");
    histogram.interior = counts("interior");
    histogram.min = number(all, "min");
    histogram.max = number(all, "max");
    histogram.median = number(all, "median");
    histogram.p1 = number(all, "p1");
    const bool is_empty =
        std::all_of(histogram.all.begin(), histogram.all.end(), [](std::int64_t count) { return count == 0; });
    return is_empty ? std::nullopt : std::optional(std::move(histogram));
}

RunReportFile report_from_json(const Json& json) {
    RunReportFile report;
    const Json& input = json.at("input");
    read_options(json.at("options"), report);
    report.options.input = path_of_text(input.at("path").get<std::string>());
    report.input_facets = input.at("faces").get<std::int64_t>();
    report.input_vertices = input.at("vertices").get<std::int64_t>();
    report.remeshed = input.contains("remeshing");
    RunNames names = RunNames::of_report(json);
    report.patch_names = std::move(names.patches);
    report.region_names = std::move(names.regions);
    report.volume = number(input, "volume");
    for (const Json& note : input.value("notes", Json::array())) report.notes.push_back(note.get<std::string>());
    for (const Json& node : json.at("tree")) read_node(node, report.tree);
    const Json& parts = json.at("parts");
    const bool meshed = json.at("totals").at("tets").get<std::int64_t>() > 0 ||
                        std::any_of(parts.begin(), parts.end(), [](const Json& p) { return p.contains("error"); });
    report.options.volume = meshed;
    for (const Json& part : parts) read_part_row(part, meshed, report.tree);
    set_regions_of_nodes(report.tree);
    for (std::size_t i = 0; i < quality_measures.size(); ++i)
        report.histograms[i] = read_histogram(json.at("quality"), quality_measures[i].name);
    report.seconds = number(json.at("totals"), "wall_seconds");
    report.cut_seconds = number(json.at("totals"), "decompose_seconds");
    report.mesh_seconds = number(json.at("totals"), "mesh_seconds");
    report.exit_code = json.at("exit_code").get<int>();
    if (const auto laws = json.find("verification"); meshed && laws != json.end())
        report.verified = laws->at("passed").get<bool>();
    if (report.exit_code == static_cast<int>(ErrorCode::verification))
        report.notes.push_back("The verification of this run has failed: see its report");
    return report;
}

// A sentence on files that are not there with all their bytes, or empty; their contents are for kerf verify.
std::string damage_of(const std::string& folder, const Json& files) {
    std::string first;
    int count = 0;
    for (const Json& file : files) {
        const auto path = file.at("path").get<std::string>();
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(std::filesystem::path(folder) / path, error);
        if (!error && size == file.at("bytes").get<std::uintmax_t>()) continue;
        if (count++ == 0) first = fmt::format("{}/{} is {}", folder, path, error ? "missing" : "cut short");
    }
    if (count == 0) return "";
    return fmt::format("{}{}. Run kerf verify on the folder, and kerf mesh again.", first,
                       count > 1 ? fmt::format(", and so are {} other files", count - 1) : "");
}

}  // namespace

RunReportFile read_report(const std::string& folder) {
    const std::string path = folder + "/report.json";
    const std::string text = read_sealed_report(folder);
    try {
        const Json json = parse_json(text);
        RunReportFile report = report_from_json(json);
        report.damage = damage_of(folder, json.value("files", Json::array()));
        return report;
    } catch (const Json::exception& error) {
        throw Error(ErrorCode::io,
                    fmt::format("{} is damaged or no report of a run: {}. Repeat the run.", path, error.what()));
    }
}

bool is_trace_of(const Trace& trace, const Tree& tree) {
    std::int64_t divided = 0;
    for (const TreeRow& row : tree.rows) {
        if (row.leaf() || row.regions > 1) continue;
        ++divided;
        const Cut* cut = trace.find(row.id);
        if (!cut || !cut->made()) return false;
        const Plane* plane = row.plane();
        if (plane && (cut->plane.origin != plane->origin || cut->plane.normal != plane->normal)) return false;
    }
    return divided == std::count_if(trace.cuts.begin(), trace.cuts.end(), [](const Cut& cut) { return cut.made(); });
}

}  // namespace kerf::view

// The page is assets/report/page.html with its style, its scripts, the part of three.js that these need (made by
// assets/report/make_bundle.sh), and two blocks of data: JSON, and the triangles (files/html/inside/packed_surface.h),
// compressed and as base64. No other file or address is named in it. The address under which a page is opened says what
// its view shows, which tests use, too. A page is sent to others, so paths lose their folders, and of the report only
// the members stay that the scripts read. A solution adds its report, and values at the vertices. The surfaces are read
// twice: for the box of the grid, and for the triangles, so that one part at a time is in memory.
#include "files/html/report_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "files/html/inside/packed_surface.h"
#include "files/html/inside/page_files.h"
#include "files/html/inside/page_surface.h"
#include "files/io/compressed.h"
#include "files/io/json.h"
#include "files/io/listed_files.h"
#include "files/io/run_folder.h"
#include "files/part/part_ranges.h"
#include "files/part/run_parts.h"
#include "files/part/solution_parts.h"
#include "files/part/vtu_reader.h"

namespace kerf {

namespace {

using PageJson = nlohmann::ordered_json;

template <std::size_t count>
PageJson chosen(const PageJson& from, const std::array<const char*, count>& names) {
    PageJson to = PageJson::object();
    for (const char* name : names)
        if (from.contains(name)) to[name] = from[name];
    return to;
}

// Returns the name of a file without its folders, which a page for others does not tell.
std::string file_name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

void cut_folders(PageJson& report) {
    PageJson &input = report.at("input").at("path"), &options = report.at("options");
    input = file_name_of(input);
    for (const char* name : {"size-field", "report", "events", "trace"})
        options.at(name) = file_name_of(options.at(name));
    for (PageJson& file : options.at("with")) file = file_name_of(file);
}

// Returns the report without what the page does not use, which would be most of a large run's.
PageJson shortened(PageJson report) {
    constexpr std::array of_node = {"id", "leaves", "faces", "volume", "cut"};
    constexpr std::array of_part = {"id",
                                    "rank",
                                    "region",
                                    "tets",
                                    "vertices",
                                    "volume",
                                    "surface_volume",
                                    "surface_faces",
                                    "interface_area",
                                    "min_dihedral_deg",
                                    "neighbours",
                                    "mesher",
                                    "way",
                                    "attempts",
                                    "seconds",
                                    "peak_rss_bytes",
                                    "error"};
    for (PageJson& node : report.at("tree")) node = chosen(node, of_node);
    for (PageJson& part : report.at("parts")) part = chosen(part, of_part);
    cut_folders(report);
    for (const char* name : {"files", "report_hash"}) report.erase(name);
    return report;
}

std::string title_of(const PageJson& report) {
    const std::string first = report.at("input").at("path");
    const PageJson& others = report.at("options").at("with");
    if (others.empty()) return first;
    if (others.size() == 1) return fmt::format("{} and {}", first, others[0].get<std::string>());
    return fmt::format("{} and {} more", first, others.size());
}

// Returns the verified surface of a part.
Part verified_surface(const PageJson& of_report, const ListedFiles& files) {
    const std::string path = files.verified("parts/" + part_surface_file_name(of_report.at("id")));
    Part surface = read_part(path, PartContent::surface);
    require_ranges(surface, path);
    return surface;
}

Box box_of_run(const PageJson& report, const ListedFiles& files) {
    Box box;
    for (const PageJson& part : report.at("parts")) box.extend(box_around(verified_surface(part, files).mesh.vertices));
    return box;
}

// The solution that a page tells of: its report, its files, and the fields that are drawn.
struct SolutionOfPage {
    PageJson report;
    ListedFiles files;
    std::vector<std::string> fields = {};

    explicit SolutionOfPage(const std::string& folder)
        : report(parse_ordered_json(read_sealed_report(folder))), files(folder, files_of_report(report)) {
        report.erase("files");
        report.erase("report_hash");
        PageJson& solve = report.at("solve");
        solve["case_file"] = file_name_of(solve.value("case_file", ""));
    }
};

// Returns the values of a part's solution at its boundary vertices, which are the first points of both files: of
// scalars as they are, of displacements and modes the length; of other arrays none. All parts have the same fields.
VertexValues values_on_surface(const PageJson& of_report, std::int64_t vertices, SolutionOfPage& solution) {
    constexpr std::size_t most_fields = 12;
    const std::string path = solution.files.verified(path_of_part_in(solution.files.folder(), of_report.at("id")));
    VertexValues all;
    solution.fields.clear();
    for (const PartValues& values : read_values(path)) {
        if (values.of != PartValues::Of::points || all.size() == most_fields) continue;
        if (values.components != 1 && values.components != 3) continue;
        std::vector<double> lengths(vertices);
        for (std::int64_t v = 0; v < vertices; ++v) {
            double squared = 0;
            for (int i = 0; i < values.components; ++i)
                squared += std::pow(values.number(v * values.components + i), 2);
            lengths[v] = values.components == 1 ? values.number(v) : std::sqrt(squared);
        }
        all.push_back(std::move(lengths));
        solution.fields.push_back(values.name);
    }
    return all;
}

struct ReadSurface {
    PageSurface surface;
    PageJson patch_names;
    PageJson region_names = PageJson::array();
};

// `solution`: null for a page of a run alone.
ReadSurface read_surfaces(const PageJson& report, const ListedFiles& files, SolutionOfPage* solution,
                          std::int64_t limit) {
    const PageJson& input = report.at("input");
    ReadSurface read{PageSurface(box_of_run(report, files), limit), input.value("patches", PageJson())};
    for (const PageJson& region : input.value("regions", PageJson::array()))
        read.region_names.push_back(region.at("name"));
    for (const PageJson& of_part : report.at("parts")) {
        const Part part = verified_surface(of_part, files);
        read.surface.add(
            part, solution ? values_on_surface(of_part, part.mesh.boundary_vertex_count, *solution) : VertexValues());
        if (read.patch_names.is_null()) read.patch_names = part.patch_names.names();  // of an older version
    }
    return read;
}

// Returns the runs of triangles, which are sorted so, with the same neighbour and patch: [neighbour, patch, how many].
PageJson groups_of(const PagePart& part) {
    PageJson groups = PageJson::array();
    for (const PageTriangle& t : part.triangles) {
        if (groups.empty() || groups.back()[0] != t.neighbour.value() || groups.back()[1] != t.patch)
            groups.push_back({t.neighbour, t.patch, 0});
        PageJson& count = groups.back()[2];
        count = count.get<std::int64_t>() + 1;
    }
    return groups;
}

PageJson json_of(const ReadSurface& read, const std::vector<std::string>& fields,
                 const std::vector<ValueRange>& ranges) {
    const PageSurface& surface = read.surface;
    PageJson parts = PageJson::array();
    for (const PagePart& part : surface.parts())
        parts.push_back({{"id", part.id},
                         {"region", part.region.value()},
                         {"vertices", part.cells.size()},
                         {"triangles", part.triangles.size()},
                         {"groups", groups_of(part)}});
    PageJson shown = PageJson::array();
    for (std::size_t k = 0; k < fields.size(); ++k)
        shown.push_back({{"name", fields[k]}, {"least", ranges[k].least}, {"most", ranges[k].most}});
    const Vec3& low = surface.low();
    return {{"low", {low.x(), low.y(), low.z()}},
            {"step", surface.step()},
            {"joins", surface.joins()},
            {"triangles", surface.triangles()},
            {"triangles_of_run", surface.triangles_of_run()},
            {"patches", read.patch_names},
            {"regions", read.region_names},
            {"fields", std::move(shown)},
            {"parts", parts}};
}

// Returns JSON as text that ends no script and begins no comment of HTML.
std::string as_script(const PageJson& json) {
    std::string text;
    for (const char c : json_text(json)) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

std::string as_text(std::string_view name) {
    std::string text;
    for (const char c : name) text += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : std::string(1, c);
    return text;
}

using Blanks = std::vector<std::pair<std::string_view, std::string>>;

// Returns the page with each {{name}} filled in. Filled-in texts are not searched for names again.
std::string filled(std::string_view page, const Blanks& blanks) {
    std::string text;
    while (!page.empty()) {
        const std::size_t begin = page.find("{{"), end = page.find("}}", begin);
        text += page.substr(0, begin);
        if (begin == page.npos) break;
        const std::string_view name = page.substr(begin + 2, end - begin - 2);
        text +=
            std::find_if(blanks.begin(), blanks.end(), [&](const auto& blank) { return blank.first == name; })->second;
        page.remove_prefix(end + 2);
    }
    return text;
}

}  // namespace

ReportPage report_page(const std::string& folder, std::int64_t limit) {
    try {
        std::optional<SolutionOfPage> solution;
        if (const std::optional<std::string> found = find_solution_folder(folder)) solution.emplace(*found);
        const std::string run = mesh_in(folder);
        PageJson report = parse_ordered_json(read_sealed_report(run));
        const ListedFiles files(run, files_of_report(report));
        const ReadSurface read = read_surfaces(report, files, solution ? &*solution : nullptr, limit);
        const std::vector<ValueRange> ranges = ranges_of(read.surface);
        report = shortened(std::move(report));
        const std::string title = title_of(report);
        PageJson data = {{"report", std::move(report)},
                         {"surface", json_of(read, solution ? solution->fields : std::vector<std::string>(), ranges)}};
        if (solution) data["solution"] = std::move(solution->report);
        return {filled(page_files::page_html, {{"title", as_text(title)},
                                               {"style", std::string(page_files::page_css)},
                                               {"data", as_script(data)},
                                               {"surface", base64(deflate_block(packed_surface(read.surface, ranges)))},
                                               {"library", std::string(page_files::three_min_js)},
                                               {"view", std::string(page_files::view_js)},
                                               {"figures", std::string(page_files::figures_js)},
                                               {"script", std::string(page_files::page_js)}}),
                std::ssize(read.surface.parts()), read.surface.triangles(), read.surface.triangles_of_run()};
    } catch (const nlohmann::json::exception& e) {
        throw Error(ErrorCode::io, fmt::format("{}/report.json is not one of this version of Kerf: {}. Run kerf mesh "
                                               "again.",
                                               folder, e.what()));
    }
}

}  // namespace kerf

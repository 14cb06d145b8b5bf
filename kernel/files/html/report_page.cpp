// The page is assets/report/page.html with its style, its scripts, the part of three.js that these need (made by
// assets/report/make_bundle.sh), and two blocks of data: JSON, and the triangles (files/html/inside/packed_surface.h),
// compressed and as base64. No other file or address is named in it. The address under which a page is opened says what
// its view shows, which tests use, too. A page is sent to others, so paths lose their folders, and of the report only
// the members stay that the scripts read. The surfaces are read twice: for the box of the grid, and for the triangles,
// so that one part at a time is in memory.
#include "files/html/report_page.h"

#include <algorithm>
#include <array>
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
    constexpr std::array of_part = {
        "id",         "rank",   "tets", "vertices", "volume",  "surface_volume", "surface_faces", "interface_area",
        "neighbours", "mesher", "way",  "attempts", "seconds", "peak_rss_bytes", "error"};
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

struct ReadSurface {
    PageSurface surface;
    PageJson patch_names;
    PageJson region_names = PageJson::array();
};

ReadSurface read_surfaces(const PageJson& report, const ListedFiles& files, std::int64_t limit) {
    const PageJson& input = report.at("input");
    ReadSurface read{PageSurface(box_of_run(report, files), limit), input.value("patches", PageJson())};
    for (const PageJson& region : input.value("regions", PageJson::array()))
        read.region_names.push_back(region.at("name"));
    for (const PageJson& of_part : report.at("parts")) {
        const Part part = verified_surface(of_part, files);
        read.surface.add(part);
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

PageJson json_of(const ReadSurface& read) {
    const PageSurface& surface = read.surface;
    PageJson parts = PageJson::array();
    for (const PagePart& part : surface.parts())
        parts.push_back({{"id", part.id},
                         {"region", part.region.value()},
                         {"vertices", part.cells.size()},
                         {"triangles", part.triangles.size()},
                         {"groups", groups_of(part)}});
    const Vec3& low = surface.low();
    return {{"low", {low.x(), low.y(), low.z()}},
            {"step", surface.step()},
            {"joins", surface.joins()},
            {"triangles", surface.triangles()},
            {"triangles_of_run", surface.triangles_of_run()},
            {"patches", read.patch_names},
            {"regions", read.region_names},
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
        PageJson report = parse_ordered_json(read_sealed_report(folder));
        if (is_of_solution(report))
            throw Error(ErrorCode::usage,
                        fmt::format("{} is a solution of kerf solve, and pages are of runs. kerf view {} shows its "
                                    "stresses, kerf screenshot {} -o stresses.png draws them, and kerf report {} -o "
                                    "mesh.html tells of its mesh.",
                                    folder, folder, folder, mesh_in(folder)));
        const ReadSurface read = read_surfaces(report, ListedFiles(folder, files_of_report(report)), limit);
        report = shortened(std::move(report));
        const std::string title = title_of(report);
        const PageJson data = {{"report", std::move(report)}, {"surface", json_of(read)}};
        return {filled(page_files::page_html, {{"title", as_text(title)},
                                               {"style", std::string(page_files::page_css)},
                                               {"data", as_script(data)},
                                               {"surface", base64(deflate_block(packed_surface(read.surface)))},
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

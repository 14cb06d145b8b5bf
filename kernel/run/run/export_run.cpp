// An export writes all files into a folder of its own inside of the target, so that a disk that is full or a program
// that is killed leaves no half of them under the names of whole ones. Then the list of files is written, which makes
// all of them known as Kerf's, and last they are renamed to their places; files of an earlier export that are not
// written again go away, but never those of a run. Files that the list did not have are never replaced, and no link is
// followed. The target's list is report.json for a run and kerf_export.json for another folder.
#include "run/run/export_run.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/core/error.h"
#include "base/core/ids.h"
#include "base/core/version.h"
#include "files/io/durable_file.h"
#include "files/io/file_bytes.h"
#include "files/io/json.h"
#include "files/io/json_rows.h"
#include "files/io/output_file.h"
#include "files/part/joined_parts.h"
#include "files/part/parts_of_order.h"
#include "files/part/solution_parts.h"
#include "run/run/edge_numbering.h"
#include "run/run/inside/write_stage.h"

namespace kerf {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

// The folder that files are exported to, and its list of those that Kerf has written: the report of a run, or the list
// of earlier exports.
class Target {
 public:
    Target(std::string folder, const std::string& list_name)
        : folder_(std::move(folder)), list_file_((fs::path(folder_) / list_name).string()) {
        std::error_code error;
        fs::create_directories(folder_, error);
        if (error) fail("create the folder", folder_, error);
        read_list();
        staging_ = folder_ + "/.kerf-export-XXXXXX";
        if (!::mkdtemp(staging_.data())) fail("write into", folder_, {errno, std::generic_category()});
    }
    ~Target() {
        std::error_code ignored;
        fs::remove_all(staging_, ignored);
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    const std::string& folder() const { return folder_; }
    const std::string& staging() const { return staging_; }
    /// Names of the files there that Kerf has written.
    std::set<std::string> own() const {
        std::set<std::string> names;
        for (const auto& file : list_.at("files")) names.insert(file.at("path").get<std::string>());
        return names;
    }

    /// Gives the files that lie in staging() their places. Unless `keeps_older`, files of earlier exports go away.
    void take(const std::vector<RunFile>& files, bool keeps_older) {
        const std::set<std::string> listed = own();
        std::set<std::string> written;
        for (const RunFile& file : files) written.insert(file.path);
        std::error_code ignored;
        for (const RunFile& file : files) require_no_link(file.path);
        for (const RunFile& file : files)
            if (!listed.contains(file.path) && fs::exists(fs::path(folder_) / file.path, ignored))
                throw Error(ErrorCode::io, fmt::format("{}/{} is in the way of the export, which has not written it. "
                                                       "Move it away, or choose another folder.",
                                                       folder_, file.path));
        std::vector<std::string> stale;
        if (!keeps_older)
            std::set_difference(listed.begin(), listed.end(), written.begin(), written.end(),
                                std::back_inserter(stale));
        write_list(files, {stale.begin(), stale.end()});
        for (const RunFile& file : files) place(file.path);
        for (const std::string& file : stale) remove(file);
    }

 private:
    [[noreturn]] static void fail(const std::string& action, const std::string& path, const std::error_code& reason) {
        throw Error(ErrorCode::io, fmt::format("Cannot {} {}: {}. Check its permissions, or choose another folder.",
                                               action, path, reason.message()));
    }
    // A folder below the target that is a link would lead out of it.
    void require_no_link(const std::string& file) const {
        std::error_code ignored;
        for (fs::path above = fs::path(file).parent_path(); !above.empty(); above = above.parent_path())
            if (fs::is_symlink(fs::path(folder_) / above, ignored))
                throw Error(ErrorCode::io, fmt::format("{} is a link, behind which nothing is written. Put a folder in "
                                                       "its place, or choose another one by --output.",
                                                       (fs::path(folder_) / above).string()));
    }
    void read_list() {
        std::error_code ignored;
        if (!fs::exists(list_file_, ignored)) {
            list_ = {{"kerf", version}, {"files", Json::array()}};
            return;
        }
        const std::string text = read_file(list_file_);
        if (!is_sealed(text))
            throw Error(ErrorCode::io, fmt::format("{} is not as Kerf has written it, so that nobody knows whose files "
                                                   "lie there. Choose another folder.",
                                                   list_file_));
        list_ = parse_ordered_json(text);
        list_.erase("report_hash");
    }
    // Before any file gets its place: whatever happens, all of them are known as Kerf's.
    void write_list(const std::vector<RunFile>& files, const std::set<std::string>& stale) {
        std::vector<RunFile> all = files;
        for (const auto& file : list_["files"])
            if (!stale.contains(file["path"])) all.push_back({file["path"], file["bytes"], file["hash"]});
        sort_files(all);
        list_["files"] = Json::array();
        for (const RunFile& file : all)
            list_["files"].push_back({{"path", file.path}, {"bytes", file.bytes}, {"hash", file.hash}});
        write_durable_file(list_file_, sealed(text_with_rows(list_)));
    }
    void place(const std::string& file) const {
        const fs::path to = fs::path(folder_) / file;
        std::error_code error;
        fs::create_directories(to.parent_path(), error);
        if (!error) fs::rename(fs::path(staging_) / file, to, error);
        if (error) fail("write", to.string(), error);
    }
    void remove(const std::string& file) const {
        std::error_code ignored;
        require_no_link(file);
        fs::remove(fs::path(folder_) / file, ignored);
        for (fs::path above = fs::path(file).parent_path(); !above.empty(); above = above.parent_path())
            fs::remove(fs::path(folder_) / above, ignored);  // only if it is empty
    }

    std::string folder_, list_file_, staging_;
    Json list_;
};

std::vector<FormatPlace> places_of(const ExportRequest& request, const std::vector<const Format*>& formats) {
    if (request.output.empty()) return places_in_run_folder(formats);
    std::vector<FormatPlace> places;
    for (const Format* format : formats) places.push_back({format, formats.size() == 1 ? "" : format->name});
    return places;
}

// Types of patches that are asked for come after those that the run was given, so that they count.
std::vector<PatchType> patch_types_of(const ExportRequest& request, const MeshOutline& outline) {
    std::vector<PatchType> types = parse_patch_types(outline.patch_types);
    for (PatchType& type : parse_patch_types(request.patch_types)) types.push_back(std::move(type));
    require_patches(types, outline.patch_names);
    return types;
}

// Throws Error(usage) for an option that none of the formats would obey.
FormatOptions options_of(const ExportRequest& request, const std::vector<const Format*>& formats) {
    const auto require = [&](bool is_asked, const char* option, const char* format) {
        if (is_asked && std::find(formats.begin(), formats.end(), &find_format(format)) == formats.end())
            throw Error(ErrorCode::usage,
                        fmt::format("{} is for the format {}, which --format does not name.", option, format));
    };
    require(request.msh_ascii, "--msh-ascii", "msh");
    require(!request.patch_types.empty(), "--patch-type", "openfoam");
    require(request.split_regions, "--split-regions", "openfoam");
    return {parse_cell_fields(request.fields), request.msh_ascii, {}, request.split_regions};
}

void check_request(const ExportRequest& request) {
    if (request.output.empty() && request.into > 0)
        throw Error(ErrorCode::usage,
                    "--into makes pieces that are not the parts of the run. Name a folder for them: "
                    "--output.");
    refuse_file_name("--output", request.output);
    if (!request.output.empty() && lies_inside(request.output, request.folder))
        throw Error(ErrorCode::usage,
                    fmt::format("--output is {}, which lies in the run {}. Leave it out to add the files to the run, "
                                "or choose another folder.",
                                request.output, request.folder));
}

}  // namespace

ExportSummary export_run(const ExportRequest& asked, Communicator& ranks, RunListener* listener) {
    ExportRequest request = asked;
    std::vector<FormatPlace> places;
    FormatOptions options;
    std::unique_ptr<PartSource> parts;
    in_agreement(ranks, [&] {
        request.folder = find_solution_folder(asked.folder).value_or(asked.folder);
        const std::vector<const Format*> formats = parse_formats(request.formats);
        places = places_of(request, formats);
        check_request(request);
        options = options_of(request, formats);
        parts = open_parts(request.folder);
        options.patch_types = patch_types_of(request, parts->outline());  // before there is a folder
        if (options.split_regions) require_regions(parts->outline().region_names.size());
        for (const Format* format : formats)
            require_order(*format, request.order == 0 ? parts->outline().order : request.order);
    });
    const auto of_order =
        parts_of_order(*parts, request.order, [&] { return number_edges_together(ranks, *parts, listener); });
    const PartSource& cells = of_order ? *of_order : *parts;
    std::unique_ptr<JoinedParts> joined;
    std::unique_ptr<Target> target;  // on the root rank
    const std::string staging = in_agreement(ranks, [&] {
        if (request.into != 0) joined = std::make_unique<JoinedParts>(cells, request.into);
        if (ranks.rank() != 0) return std::string();
        const bool is_of_run = request.output.empty();
        target = std::make_unique<Target>(is_of_run ? request.folder : request.output,
                                          is_of_run ? "report.json" : "kerf_export.json");
        return target->staging();
    });
    const std::string shared_staging = all_gather(ranks, staging).front();
    const std::string folder = request.output.empty() ? request.folder : request.output;
    const PartSource& source = joined ? *joined : cells;
    ExportSummary summary{
        folder, {}, count_of(source.outline().parts), source.outline().vertices, source.outline().tets()};
    for (const FormatPlace& place : places)
        if (std::string note = tell_values_left_out(*place.format, source.outline()); !note.empty())
            summary.notes.push_back(std::move(note));
    // Files that belong to no part are written by the root rank, which alone asks for files of others.
    const WriteTarget to{shared_staging, folder, target ? target->own() : std::set<std::string>(), options};
    summary.files = write_parts(ranks, source, places, to, request.threads, listener);
    in_agreement(ranks, [&] {
        if (target) target->take(summary.files, request.output.empty());
    });
    return summary;
}

}  // namespace kerf

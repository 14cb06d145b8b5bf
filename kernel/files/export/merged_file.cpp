// The ending of the output chooses the format, whose write_merged() writes one or more files into a temporary folder
// beside the place, on the same disk. When all are complete, each is renamed to its place: the named file to where its
// links lead, the others beside it, with the permissions of older files. Every place is checked before the first
// rename, so that a refusal leaves all older files. Of order 2 the edges are numbered first. A run that is merged at
// its end lies in FILE.kerf-run beside its file, from which merged_file_of() finds the way back. A solution has no mesh
// of its own: the run of its mesh is protected like the run itself.
#include "files/export/merged_file.h"

#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/output_file.h"
#include "files/io/run_folder.h"
#include "files/io/temporary_folder.h"
#include "files/part/parts_of_order.h"
#include "files/part/solution_parts.h"

namespace kerf {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view run_ending = ".kerf-run";

// The parts of another source, which must outlive it, with a question before each load: unless `is_cancelled` is
// empty, it is called, and true ends the load with Error(cancelled).
class WatchedParts : public PartSource {
 public:
    WatchedParts(const PartSource& parts, const std::function<bool()>& is_cancelled)
        : parts_(parts), is_cancelled_(is_cancelled) {}
    const MeshOutline& outline() const override { return parts_.outline(); }
    Part load(PartIndex index) const override {
        end_if_cancelled();
        return parts_.load(index);
    }
    Part load_only(PartIndex index, PartContent content) const override {
        end_if_cancelled();
        return parts_.load_only(index, content);
    }
    const RegionWalls& walls() const override { return parts_.walls(); }

 private:
    void end_if_cancelled() const {
        if (is_cancelled_ && is_cancelled_()) throw Error(ErrorCode::cancelled, "Writing was cancelled.");
    }

    const PartSource& parts_;
    const std::function<bool()>& is_cancelled_;
};

const Format& format_of(const fs::path& file) {
    if (const Format* format = find_merged_format(file.string())) return *format;
    std::string endings;
    for (const Format* format : formats())
        if (format->ending) endings += fmt::format("{}{}", endings.empty() ? "" : ", ", format->ending);
    throw Error(ErrorCode::usage, fmt::format("--output is {}, whose ending is that of no format. There are {}.",
                                              file.string(), endings));
}

// Returns the place of a file: behind links, free or a regular file of the format, and outside of the run.
fs::path place_for(const fs::path& file, const std::string& run, const Format& format) {
    const fs::path place = behind_links(file.string());
    if (!run.empty() && lies_inside(place.string(), run))
        throw Error(ErrorCode::io, fmt::format("--output is {}, which lies in the run {}, whose files it would mix "
                                               "with others. Choose another place.",
                                               file.string(), run));
    require_writable("--output", file.string(), format.kind);
    std::error_code ignored;
    if (fs::exists(place, ignored) && !fs::is_regular_file(place, ignored))
        throw Error(ErrorCode::io,
                    fmt::format("--output is {}, which is no file. Choose another place.", file.string()));
    return place;
}

// An older file gives its permissions to the one that replaces it.
void move_to(const fs::path& from, const fs::path& place) {
    std::error_code error, ignored;
    if (fs::exists(place, ignored)) fs::permissions(from, fs::status(place).permissions(), ignored);
    fs::rename(from, place, error);
    if (error)
        throw Error(ErrorCode::io, fmt::format("Cannot rename {} to {}: {}. Choose another place for --output.",
                                               from.string(), place.string(), error.message()));
}

// Checks the request and returns the format of the file.
const Format& check_merged_request(const MergeRequest& request) {
    const Format& format = format_of(request.output);
    if (request.msh_ascii && &format != &find_format("msh"))
        throw Error(ErrorCode::usage, fmt::format("--msh-ascii is for files that end with .msh, and --output is {}. "
                                                  "Drop one.",
                                                  request.output));
    require_order(format, request.order);
    place_for(request.output, request.folder, format);
    return format;
}

}  // namespace

const Format* find_merged_format(const std::string& file) {
    for (const Format* format : formats())
        if (format->ending && fs::path(file).extension() == format->ending) return format;
    return nullptr;
}

void check_merged_file(const MergeRequest& request) { check_merged_request(request); }

std::string run_folder_beside(const std::string& merged_file) { return merged_file + std::string(run_ending); }

std::string merged_file_of(const std::string& run_folder) {
    std::string file = RunFolder::result_of(run_folder);
    while (file.ends_with('/')) file.pop_back();
    if (!file.ends_with(run_ending)) return "";
    file.resize(file.size() - run_ending.size());
    return find_merged_format(file) ? file : "";
}

MergedFile merge_parts(const PartSource& parts, const MergeRequest& request) {
    const fs::path output = request.output;
    const Format& format = check_merged_request(request);
    const fs::path main_place = place_for(output, request.folder, format);
    // The files are written on the disk where they will lie, for as long as they are not complete.
    const TemporaryFolder beside(main_place.string(), "write beside " + main_place.string(),
                                 "Choose another place for --output.");
    ExportFiles files(beside.path(), "", {}, {.msh_ascii = request.msh_ascii});
    const WatchedParts watched(parts, request.is_cancelled);
    const auto of_order = parts_of_order(watched, request.order, [&] { return number_edges(watched); });
    const PartSource& written_parts = of_order ? *of_order : static_cast<const PartSource&>(watched);
    require_order(format, written_parts.outline().order);
    format.write_merged(written_parts, request.options, files, output.stem().string());

    const std::vector<RunFile> written = files.list();
    std::vector<fs::path> places;
    for (const RunFile& file : written)
        places.push_back(fs::path(file.path) == output.filename()
                             ? main_place
                             : place_for(output.parent_path() / file.path, request.folder, format));
    MergedFile merged{written_parts.outline().vertices, written_parts.outline().tets(), 0,
                      written_parts.outline().nodes(), tell_values_left_out(format, written_parts.outline())};
    for (std::size_t i = 0; i < written.size(); ++i) {
        move_to(fs::path(beside.path()) / written[i].path, places[i]);
        merged.bytes += fs::file_size(places[i]);
    }
    return merged;
}

MergedFile merge_run(const MergeRequest& request) {
    const Format& format = check_merged_request(request);
    if (const auto solution = find_solution_folder(request.folder))
        place_for(request.output, mesh_of_solution(*solution), format);
    return merge_parts(*open_parts(request.folder), request);
}

}  // namespace kerf

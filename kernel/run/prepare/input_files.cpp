// Several files become one soup by appending, in the order in which they are given, which is also that of the regions.
// Numbers of vertices and polygons in the file, which are left implicit where they equal places, are written out as
// soon as one file has its own, and those of each further file begin behind the last. Bodies are told apart by
// `file_of_patch`, so a patch never spans two files. A file that is given twice is found by its hash, since two equal
// bodies would overlap everywhere. The JSON with the regions of patches is read beside a single file only, and is part
// of the hash.
#include "run/prepare/input_files.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <numeric>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/hash.h"
#include "base/core/ids.h"
#include "base/core/unique_name.h"
#include "files/io/file_bytes.h"
#include "files/io/named_walls.h"
#include "files/io/run_manifest.h"
#include "run/prepare/cad_input.h"

namespace kerf {

namespace {

// bone for parts/bone.stl.gz.
std::string stem_of(const std::string& path) {
    std::filesystem::path name = std::filesystem::path(path).filename();
    if (name.extension() == ".gz" || name.extension() == ".zst") name = name.stem();
    return name.stem().string();
}

template <class T>
void append_items(std::vector<T>& all, const std::vector<T>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

// Numbers of a file that are those of the soup are not written out.
void write_out(std::vector<std::int32_t>& numbers, std::size_t count) {
    if (!numbers.empty()) return;
    numbers.resize(count);
    std::iota(numbers.begin(), numbers.end(), 0);
}

void append_numbers(std::vector<std::int32_t>& all, std::size_t count, std::vector<std::int32_t> more,
                    std::size_t more_count) {
    write_out(all, count);
    write_out(more, more_count);
    const std::int32_t next = all.empty() ? 0 : *std::max_element(all.begin(), all.end()) + 1;
    for (const std::int32_t number : more) all.push_back(next + number);
}

void append_polygons(Soup& all, const Soup& more) {
    if (all.polygon.empty() && more.polygon.empty()) return;
    write_out(all.polygon, all.facets.size());
    const std::int32_t next = all.polygon.empty() ? 0 : all.polygon.back() + 1;
    for (const std::int32_t polygon : more.unfit_polygons) all.unfit_polygons.push_back(next + polygon);
    append_numbers(all.polygon, all.facets.size(), more.polygon, more.facets.size());
}

void append_soup(Soup& all, const Soup& more, const std::string& name) {
    append_polygons(all, more);
    if (!all.vertex_number.empty() || !more.vertex_number.empty())
        append_numbers(all.vertex_number, all.vertices.size(), more.vertex_number, more.vertices.size());
    const auto first_vertex = count_of(all.vertices);
    const auto first_patch = count_of(all.patch_names);
    for (const Triangle& t : more.facets)
        all.facets.push_back({t[0] + first_vertex, t[1] + first_vertex, t[2] + first_vertex});
    for (const std::int32_t patch : more.patch) all.patch.push_back(first_patch + patch);
    for (const auto& [vertices, sharp] : more.model_edges)
        all.model_edges.push_back({{vertices[0] + first_vertex, vertices[1] + first_vertex}, sharp});
    const bool has_colours = !all.patch_colours.empty() || !more.patch_colours.empty();
    if (has_colours) {
        all.patch_colours.resize(all.patch_names.size());
        append_items(all.patch_colours, more.patch_colours);
    }
    for (const std::string& patch : more.patch_names)
        all.patch_names.push_back(more.patch_names.size() == 1 ? name : fmt::format("{}/{}", name, patch));
    if (has_colours) all.patch_colours.resize(all.patch_names.size());
    append_items(all.vertices, more.vertices);
    append_items(all.holes, more.holes);
    append_items(all.seeds, more.seeds);
    for (const std::string& note : more.notes) all.notes.push_back(fmt::format("{}: {}", name, note));
    all.is_of_model |= more.is_of_model;
}

void read_walls_beside(const std::string& path, const FileHash& hash, InputFiles& files) {
    const std::string beside = walls_path(path);
    std::error_code ignored;  // a name may be too long for it
    if (!std::filesystem::exists(beside, ignored)) return;
    if (!files.soup.sides.empty())
        throw Error(
            ErrorCode::input,
            fmt::format("{}: {} says what lies on the sides of its facets itself. Take the JSON away.", beside, path));
    const std::string bytes = read_file(beside);
    files.walls_file = beside;
    files.walls = read_named_walls(bytes, beside, files.soup.patch_names);
    Hasher hasher;
    hasher.add(std::span<const std::uint64_t>(hash));
    hasher.add(std::span<const char>(bytes));
    files.hash = hash_text(hasher.digest());
}

}  // namespace

std::string walls_path(const std::string& path) { return path + ".regions.json"; }

InputFiles read_input_files(const std::string& path, const InputOptions& options) {
    InputFiles files;
    HashedSoup first = read_surface_or_cad(path, options);
    if (options.more_files.empty()) {
        files.soup = std::move(first.soup);
        files.is_welded = first.is_welded;
        files.hash = hash_text(first.hash);
        read_walls_beside(path, first.hash, files);
        return files;
    }
    Hasher hasher;
    std::vector<FileHash> hashes;
    std::set<std::string> taken_names;
    const auto add = [&](const std::string& file, const HashedSoup& read) {
        const auto& [soup, hash, is_welded] = read;
        if (std::filesystem::exists(walls_path(file)))
            throw Error(ErrorCode::input, fmt::format("{}: such a JSON is for a file alone, but here are several, a "
                                                      "region each. Mesh {} alone, or take the JSON away.",
                                                      walls_path(file), file));
        if (!soup.sides.empty())
            throw Error(ErrorCode::usage, fmt::format("{} has regions already: mesh it alone, or give the surface of "
                                                      "each region as a file.",
                                                      file));
        if (std::find(hashes.begin(), hashes.end(), hash) != hashes.end())
            throw Error(ErrorCode::usage, fmt::format("{} is given twice, or is a copy of a file that is given before "
                                                      "it. Give each body once.",
                                                      file));
        hashes.push_back(hash);
        hasher.add(std::span<const std::uint64_t>(hash));
        files.names.push_back(unique_name(stem_of(file), taken_names));
        append_soup(files.soup, soup, files.names.back());
        files.file_of_patch.resize(files.soup.patch_names.size(), count_of(files.names) - 1);
    };
    add(path, first);
    first = {};
    for (const std::string& file : options.more_files) add(file, read_surface_or_cad(file, options));
    files.hash = hash_text(hasher.digest());
    return files;
}

}  // namespace kerf

// Several files become one soup by appending, in the order in which they are given, which is also that of the regions.
// Numbers of vertices and polygons in the file, which are left implicit where they equal places, are written out as
// soon as one file has its own, and those of each further file begin behind the last. Bodies are told apart by
// `file_of_patch`, so a patch never spans two files. A file that is given twice is found by its hash, since two equal
// bodies would overlap everywhere. The JSON with the regions of patches is read beside a single file only, and is part
// of the hash.
#include "run/prepare/input_files.h"

#include <algorithm>
#include <filesystem>
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

// A patch is called as the file if that has one patch, else "file/patch".
std::string patch_name_in(const Soup& file, const std::string& patch, const std::string& name) {
    return file.patch_names.size() == 1 ? name : fmt::format("{}/{}", name, patch);
}

void append_file(Soup& all, Soup file, const std::string& name) {
    for (std::string& patch : file.patch_names) patch = patch_name_in(file, patch, name);
    for (std::string& note : file.notes) note = fmt::format("{}: {}", name, note);
    append(all, file);
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
        files.faces_of_patches = std::move(first.faces_of_patches);
        files.hash = hash_text(first.hash);
        read_walls_beside(path, first.hash, files);
        return files;
    }
    Hasher hasher;
    std::vector<FileHash> hashes;
    std::set<std::string> taken_names;
    const auto add = [&](const std::string& file, HashedSoup read) {
        auto& [soup, hash, is_welded, faces] = read;
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
        for (PatchFace& face : faces) {
            face.patch = patch_name_in(soup, face.patch, files.names.back());
            files.faces_of_patches.push_back(std::move(face));
        }
        append_file(files.soup, std::move(soup), files.names.back());
        files.file_of_patch.resize(files.soup.patch_names.size(), count_of(files.names) - 1);
    };
    add(path, std::move(first));
    for (const std::string& file : options.more_files) add(file, read_surface_or_cad(file, options));
    files.hash = hash_text(hasher.digest());
    return files;
}

}  // namespace kerf

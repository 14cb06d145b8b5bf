// Files of other libraries are read by child processes, kerf-cad and kerf-3mf, because OpenCASCADE takes longer to load
// than a small mesh takes, may crash, and need not be installed. The child gets the path and the options as arguments,
// for projections the points on standard input, and answers in the bytes of files/io/cad_body.h: a body, projected
// points, or an error with its code. No answer means a crash or a program of another build, which are told apart by the
// way the child ended. The answer names the hash of the bytes that were read, and is refused if it is not that of the
// file which the caller has hashed.
//
// Formats are recognised by content, after decompression. Binary STL never comes through here as a whole string: it is
// read and hashed by blocks.
#include "run/prepare/cad_input.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "files/io/compressed.h"
#include "files/io/file_bytes.h"
#include "files/io/program_finder.h"
#include "files/io/surface_reader.h"
#include "files/io/threemf_file.h"
#include "fill/volume/child_process.h"
#include "surface/soup/region_patches.h"

namespace kerf {

namespace {

// `input`: the standard input of the program.
ChildResult run_import_program(const std::string& program, const std::vector<std::string>& arguments, Bytes input,
                               double timeout_seconds) {
    ChildPool pool;
    pool.start(0, program, arguments, std::move(input), timeout_seconds);
    return pool.wait_any()->result;
}

// Returns the answer, or throws an error with a sentence for a child that gave none.
CadAnswer answer_of(const ChildResult& result, const std::string& path, const std::string& program,
                    const ImportProgram& kind) {
    if (result.end == ChildResult::End::exited) try {
            return from_cad_bytes(result.output);
        } catch (const Error&) {
            throw Error(ErrorCode::io, fmt::format("{}: {} {} without an answer. Build it and kerf together, with the "
                                                   "package {} there. {}",
                                                   path, program, result.describe(), kind.run_package, result.log));
        }
    throw Error(ErrorCode::input, fmt::format("{}: {} fails on this file: {} {}. Repair the file in {}, or export it "
                                              "as STL, OBJ or PLY.",
                                              path, kind.library, kind.name, result.describe(), kind.origin));
}

// Refuses a unit for a file that names none, because units are converted only from the one of the file.
void refuse_unit(const std::string& path, const CadOptions& options) {
    if (!options.unit_is_asked && options.unit == LengthUnit::mm) return;
    throw Error(ErrorCode::usage,
                fmt::format("{} names no unit, so that --unit has no meaning. Leave it out, or multiply the "
                            "coordinates: --scale 0.001 makes m of mm.",
                            path));
}

std::string find_import_program(const ImportProgram& kind, const std::string& path) {
    ProgramSearch search = look_for_program(kind.name);
    if (search.found) return std::move(search.path);
    throw Error(ErrorCode::usage,
                fmt::format("{}: {} are read by the program {}, which is not here: {}. Install {}, build {} and put it "
                            "beside kerf (to run, it needs {}), or export the file as STL, OBJ or PLY.",
                            path, kind.files, kind.name, fmt::join(search.looked_at, ", "), kind.build_package,
                            kind.name, kind.run_package));
}

// `points`: to be projected; null: the file is to be read.
CadAnswer ask_import_program(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                             const std::string& named, double timeout_seconds, const ImportProgram& kind,
                             const CadPoints* points) {
    const std::string program = named.empty() ? find_import_program(kind, path) : named;
    std::vector<std::string> arguments = options.arguments();
    arguments.insert(arguments.begin(), path);
    if (points) arguments.emplace_back("--project");
    const ChildResult result =
        run_import_program(program, arguments, points ? to_bytes(*points) : Bytes(), timeout_seconds);
    CadAnswer answer = answer_of(result, path, program, kind);
    if (!answer.defect.empty()) throw SolidDefect(answer.defect, answer.message, answer.elements);
    if (answer.error_code != 0) throw Error(static_cast<ErrorCode>(answer.error_code), answer.message);
    if (answer.body.file_hash != file_hash)
        throw Error(ErrorCode::io, path + ": the file has changed while it was read. Run again.");
    return answer;
}

void refuse_cad_options(const std::string& path, const CadOptions& options) {
    for (const auto& [name, is_given] :
         {std::pair("solid", options.solid > 0), std::pair("unite", options.unite),
          std::pair("no-imprint", options.no_imprint), std::pair("cad-deflection", options.deflection > 0)})
        if (is_given)
            throw Error(ErrorCode::usage,
                        fmt::format("{} is no CAD file, so that --{} has no meaning. Leave it out.", path, name));
    refuse_unit(path, options);
}

// Returns a body that may have gaps and crossings where the solids are refused, since a wrap closes it.
CadBody read_cad_to_wrap(const std::string& path, const FileHash& file_hash, CadOptions options) {
    try {
        return read_cad(path, file_hash, options);
    } catch (const SolidDefect& defect) {
        options.as_it_is = true;
        CadBody body = read_cad(path, file_hash, options);
        body.soup.notes.insert(body.soup.notes.begin(), fmt::format("Wrapped as it is: {}", defect.what()));
        return body;
    }
}

CadBody read_cad_or_say_more(const std::string& path, const FileHash& file_hash, const CadOptions& options) {
    try {
        return read_cad(path, file_hash, options);
    } catch (const SolidDefect& defect) {
        throw SolidDefect(defect.kind(),
                          fmt::format("{} A closed surface around it as it is: kerf wrap {} -o around.obj --gap 1%.",
                                      defect.what(), path),
                          defect.elements());
    }
}

// `file_hash`: of the bytes.
HashedSoup read_unscaled(std::string bytes, const FileHash& file_hash, const std::string& path,
                         const InputOptions& options) {
    std::string content = decompress(std::move(bytes), path);
    if (cad_format(content) != CadFormat::none) {
        CadBody body = options.wraps() ? read_cad_to_wrap(path, file_hash, options.cad)
                                       : read_cad_or_say_more(path, file_hash, options.cad);
        if (body.file_unit.empty()) refuse_unit(path, options.cad);
        return {std::move(body.soup), file_hash, false, std::move(body.faces_of_patches)};
    }
    if (is_threemf(content)) {
        constexpr double timeout_seconds = 600;
        return {read_cad(path, file_hash, options.cad, "", timeout_seconds, threemf_program).soup, file_hash};
    }
    refuse_cad_options(path, options.cad);
    return {read_surface_bytes(std::move(content), path), file_hash};
}

}  // namespace

CadBody read_cad(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                 const std::string& named, double timeout_seconds, const ImportProgram& kind) {
    return ask_import_program(path, file_hash, options, named, timeout_seconds, kind, nullptr).body;
}

ProjectedPoints project_on_cad_file(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                                    const CadPoints& points, const std::string& program, double timeout_seconds) {
    return ask_import_program(path, file_hash, options, program, timeout_seconds, cad_program, &points).projected;
}

HashedSoup read_surface_or_cad(const std::string& path, const InputOptions& options) {
    std::optional<HashedSoup> read = read_binary_stl_file(path);
    if (read) {
        refuse_cad_options(path, options.cad);
    } else {
        std::string bytes = read_file(path);
        const FileHash hash = digest_of(bytes);
        read = read_unscaled(std::move(bytes), hash, path, options);
    }
    if (options.scale != 1) read->is_welded = false;  // products of different numbers may be equal
    scale(read->soup, options.scale);
    for (PatchFace& face : read->faces_of_patches) {
        face.radius *= options.scale;
        face.tube *= options.scale;
    }
    name_walls(read->soup);
    return std::move(*read);
}

}  // namespace kerf

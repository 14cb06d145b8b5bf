// Files that programs of their own read: CAD files and 3MF files.
#pragma once

#include <string>

#include "files/io/surface_reader.h"
#include "run/prepare/input.h"

namespace kerf {

/// A program that reads files for kerf, since its library is optional, slow to load, or may crash.
struct ImportProgram {
    const char* name;           ///< for look_for_program()
    const char* files;          ///< the kind of files that it reads
    const char* library;        ///< the library that it needs
    const char* build_package;  ///< the package that it needs to be built
    const char* run_package;    ///< the package that it needs to run
    const char* origin;         ///< the program that has written the files
};
inline constexpr ImportProgram cad_program = {
    "kerf-cad",       "CAD files", "OpenCASCADE", "libocct-data-exchange-dev", "libocct-data-exchange-7.6",
    "the CAD program"};
inline constexpr ImportProgram threemf_program = {"kerf-3mf",   "3MF files", "lib3mf",
                                                  "lib3mf-dev", "lib3mf1",   "the program that has written it"};

/// Returns the body that the program `program`, one of the kind `kind`, makes of the file `path`, in a child process
/// that is stopped after `timeout_seconds`. An empty `program` stands for the one that look_for_program() finds.
/// `file_hash`: of the bytes that the file must have.
///
/// Throws Error with the code and sentence of the program for a file that it refuses, as SolidDefect where the file was
/// read well; Error(io) for a program that cannot be started or a file that has changed; Error(input) if the program
/// crashes or takes too long, since other programs can export the file as triangles; Error(usage), naming the package
/// and the places, if the program is nowhere.
CadBody read_cad(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                 const std::string& program = "", double timeout_seconds = 600,
                 const ImportProgram& kind = cad_program);

/// Returns the places of points on the faces of the CAD file `path`, as import with the same options has them; points
/// are in units of that import, before InputOptions::scale. Works, and throws, as read_cad().
ProjectedPoints project_on_cad_file(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                                    const CadPoints& points, const std::string& program = "",
                                    double timeout_seconds = 3600);

/// Reads a surface as read_surface(), CAD files and 3MF files, too, obeys InputOptions::cad and multiplies all
/// coordinates by InputOptions::scale. Returns it with the hash of the file, whose bytes are read and hashed once.
/// Where the file has regions, patches are named as name_walls() does. Throws Error(usage) for options of CAD files on
/// another file, except options of the unit and of one solid (a build item there), which 3MF files have as well, and
/// for a unit that is asked of a file which has none.
HashedSoup read_surface_or_cad(const std::string& path, const InputOptions& options = {});

}  // namespace kerf

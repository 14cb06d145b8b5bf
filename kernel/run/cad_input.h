// CAD files as input: the program kerf-cad reads them.
#pragma once

#include <string>

#include "run/input.h"

namespace kerf {

/// Path of kerf-cad: what the environment variable KERF_CAD names, else beside this program, else in ../libexec/kerf
/// beside that; empty: nowhere.
std::string find_cad_program();

/// What the program `program` makes of the CAD file `path`, in a child process that is stopped after
/// `timeout_seconds`. `file_hash`: of the bytes that the file must have.
///
/// Throws Error with the code and sentence of kerf-cad for a file that it refuses, as SolidDefect where the file was
/// read well; Error(io) for a program that cannot
/// be started or a file that has changed; Error(input) if the program crashes or takes too long, since other programs
/// can export the file as triangles; Error(usage), naming the package, if `program` is empty.
CadBody read_cad(const std::string& path, const FileHash& file_hash, const CadOptions& options,
                 const std::string& program = find_cad_program(), double timeout_seconds = 600);

/// read_surface() that knows CAD files, too, obeys InputOptions::cad and multiplies all coordinates by
/// InputOptions::scale. With InputOptions::keep_largest volumes may touch: see Walls.
Soup read_surface_or_cad(const std::string& path, const InputOptions& options = {});

/// The same for the bytes of the file at `path`. Throws Error(usage) for options of CAD files on another one, and for a
/// unit that is asked of a file which has none.
Soup read_surface_or_cad(std::string bytes, const std::string& path, const InputOptions& options);

}  // namespace kerf

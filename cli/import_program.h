// Programs that read a file for kerf in a process of their own, because of the library that they need. They are started
// by kerf, which reads the answer from standard output (files/io/cad_body.h).
//
//     PROGRAM FILE [--solid N] [--unite] [--no-imprint] [--on-faces] [--unit mm|cm|m|inch|ft] [--deflection D]
//             [--project] [--output OUT]
//
// With --project, which kerf-cad has, points are read from standard input (files/io/cad_points.h), and the answer is
// their places on the faces of the file.
#pragma once

#include <string>
#include <string_view>

#include "files/io/cad_body.h"

namespace kerf {

/// A function that makes a body of the content of a file, without compression; the path is for messages.
using ImportFunction = CadBody (*)(std::string_view content, const std::string& path, const CadOptions& options);

/// A function that puts points on the faces of such a file.
using ProjectFunction = ProjectedPoints (*)(std::string_view content, const std::string& path,
                                            const CadOptions& options, const CadPoints& points);

/// Does all of main(). Standard output holds nothing but the answer, whatever the library prints. Ends the process with
/// the code of the error, without the library's own end, which would take longer.
[[noreturn]] void run_import_program(int argc, char** argv, const char* name, ImportFunction importer,
                                     ProjectFunction projector = nullptr);

}  // namespace kerf

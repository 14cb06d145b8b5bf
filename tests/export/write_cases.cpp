// export_cases DIR: the surfaces of all cases as DIR/NAME.stl, and what kerf mesh is to be told of each as
// DIR/NAME.args, for programs of others that judge the exports.
#include <fstream>
#include <iostream>

#include "export/cases.h"
#include "support/surface_files.h"

int main(int argc, char** argv) {
    if (argc != 2) return std::cerr << "usage: export_cases DIR\n", 2;
    for (const kerf::test::ExportCase& each : kerf::test::export_cases()) {
        const std::string stem = std::string(argv[1]) + "/" + each.name;
        std::ofstream(stem + ".stl", std::ios::binary) << kerf::test::to_ascii_stl(each.surface);
        std::ofstream(stem + ".args") << "-n " << each.parts << (each.straight_cuts ? " --contour straight" : "")
                                      << (each.cut_by_volume ? " --cut volume" : "") << "\n";
    }
    return 0;
}

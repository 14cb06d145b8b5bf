// kerf-cad: a CAD file to facets, in a process of its own. See cli/import_program.h for its command line.
#include "cad/cad_import.h"
#include "cli/import_program.h"

int main(int argc, char** argv) {
    kerf::run_import_program(argc, argv, "kerf-cad", kerf::import_cad, kerf::project_on_cad);
}

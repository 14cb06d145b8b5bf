// kerf-cad: a CAD file to facets, in a process of its own. See cli/import_program.h for its command line.
#include "cli/import_program.h"
#include "files/cad/cad_import.h"

int main(int argc, char** argv) {
    kerf::run_import_program(argc, argv, "kerf-cad", kerf::import_cad, kerf::project_on_cad);
}

// kerf-3mf: a 3MF file to facets, in a process of its own. See cli/import_program.h for its command line.
#include "cli/import_program.h"
#include "files/threemf/threemf_import.h"

int main(int argc, char** argv) { kerf::run_import_program(argc, argv, "kerf-3mf", kerf::import_threemf); }

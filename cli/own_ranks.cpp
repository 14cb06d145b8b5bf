#include "cli/own_ranks.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/ranks.h"

namespace kerf {

namespace {

constexpr const char* terminal_variable = "KERF_ON_TERMINAL";

// What Open MPI would refuse or add. Its mpirun runs nothing here but this program, which the user has started: as
// root in most containers. On a machine whose processors are threads of fewer cores, ranks may share these. An exit
// code that is not 0 has been explained by the program already.
void permit_ranks() {
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_orte_execute_quiet"})
        ::setenv(name, "1", 0);
    ::setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
}

}  // namespace

bool is_launched() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(name)) return true;
    return false;
}

void become_ranks(int ranks, char** argv) {
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> arguments = {"mpirun", "-n", std::to_string(ranks), program};
    for (char** argument = argv + 1; *argument; ++argument) arguments.emplace_back(*argument);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    permit_ranks();
    if (::isatty(STDERR_FILENO) == 1) ::setenv(terminal_variable, "1", 1);
    ::execvp(pointers.front(), pointers.data());
}

bool is_error_on_terminal() {
    return ::isatty(STDERR_FILENO) == 1 || (is_launched() && is_first_rank() && std::getenv(terminal_variable));
}

}  // namespace kerf

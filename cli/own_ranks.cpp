// A program that starts mpirun of itself and waits for it. The ranks know by KERF_OWN_RANKS that this was so and how
// many there should be: an mpirun of another MPI starts as many processes that each believe to be alone, which
// require_own_ranks() notices. mpirun gets a process group of its own, so that Ctrl-C on the terminal reaches this
// process alone: it passes the wish on as SIGUSR1, which mpirun hands to its ranks, and only a second wish as SIGTERM,
// by which mpirun kills them. mpirun ends with this process, even if that is killed (PR_SET_PDEATHSIG, with a check of
// the parent for the moment before it is set). Variables of Open MPI that it would need from the user are set unless
// they are.
#include "cli/own_ranks.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/core/error.h"
#include "cli/ranks.h"

namespace kerf {

namespace {

constexpr const char* terminal_variable = "KERF_ON_TERMINAL";
constexpr const char* ranks_variable = "KERF_OWN_RANKS";  // number of ranks that this program has asked for

volatile std::sig_atomic_t launcher = 0;   // process of mpirun; 0: none
volatile std::sig_atomic_t cancelled = 0;  // how often the user has wished for the end

// Passes the wish for the end on. A second wish makes mpirun end the ranks at once.
void pass_on(int) {
    cancelled = cancelled + 1;
    if (launcher > 0) ::kill(launcher, cancelled > 1 ? SIGTERM : SIGUSR1);
}

std::string find_program(const std::string& name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string file = folder.append("/").append(name); ::access(file.c_str(), X_OK) == 0) return file;
    return "";
}

// Sets variables without which Open MPI would refuse to start the ranks, or add messages. Its mpirun runs nothing here
// but this program, which the user has started: as root in most containers. On a machine whose processors are threads
// of fewer cores, ranks may share these. An exit code that is not 0 has been explained by the program already.
void permit_ranks() {
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM",
                             "OMPI_MCA_rmaps_base_oversubscribe", "OMPI_MCA_orte_execute_quiet"})
        ::setenv(name, "1", 0);
    ::setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
    if (::isatty(STDERR_FILENO) == 1) ::setenv(terminal_variable, "1", 1);
}

// Becomes mpirun, in a group of its own, so that the terminal's signals reach the parent alone. It ends with the
// parent.
[[noreturn]] void become_launcher(std::vector<char*>& arguments, pid_t parent) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(static_cast<int>(ErrorCode::cancelled));
    if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0) ::dup2(nothing, STDIN_FILENO);
    ::execv(arguments.front(), arguments.data());
    ::_exit(static_cast<int>(ErrorCode::internal));
}

int exit_code_of(pid_t process) {
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(process, &status, 0)) < 0 && errno == EINTR) continue;
    if (ended != process) return static_cast<int>(ErrorCode::internal);
    if (cancelled) return static_cast<int>(ErrorCode::cancelled);
    return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(ErrorCode::internal);
}

}  // namespace

bool is_launched() {
    for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", ranks_variable})
        if (std::getenv(name)) return true;
    return false;
}

bool is_own_launch() { return std::getenv(ranks_variable) != nullptr; }

void require_own_ranks(int size) {
    const char* wanted = std::getenv(ranks_variable);
    if (!wanted || wanted == std::to_string(size)) return;
    throw Error(ErrorCode::io,
                fmt::format("{} was to start {} ranks, but they are {}: it may belong to another MPI than "
                            "this program. Use --ranks 1, or start the program by its own mpirun.",
                            find_program("mpirun"), wanted, size));
}

std::optional<int> run_as_ranks(int ranks, char** argv) {
    const std::string mpirun = find_program("mpirun");
    if (mpirun.empty()) return std::nullopt;
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> arguments = {mpirun, "-n", std::to_string(ranks), program};
    for (char** argument = argv + 1; *argument; ++argument) arguments.emplace_back(*argument);
    std::vector<char*> pointers;
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    permit_ranks();
    std::signal(SIGCHLD, SIG_DFL);  // where it is ignored, nobody learns how mpirun has ended
    const pid_t parent = ::getpid();
    ::setenv(ranks_variable, std::to_string(ranks).c_str(), 1);
    const pid_t process = ::fork();
    if (process == 0) become_launcher(pointers, parent);
    ::unsetenv(ranks_variable);
    if (process < 0) return std::nullopt;
    launcher = process;
    std::signal(SIGINT, pass_on);
    std::signal(SIGTERM, pass_on);
    return exit_code_of(process);
}

bool is_error_on_terminal() {
    return ::isatty(STDERR_FILENO) == 1 || (is_launched() && is_first_rank() && std::getenv(terminal_variable));
}

}  // namespace kerf

#include "cli/ranks.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "base/parallel/processors.h"
#include "cli/own_ranks.h"

#ifdef KERF_WITH_MPI
#include <unistd.h>

#include <string_view>

#include "base/mpi/host_processors.h"
#include "base/parallel/failure_deadline.h"
#endif

namespace kerf {

namespace {

// The number of processors; all of the machine where the system tells of none.
int count_processors(const std::vector<int>& processors) {
    return processors.empty() ? machine_processors() : static_cast<int>(processors.size());
}

#ifdef KERF_WITH_MPI

// The seconds that a failed rank waits for the others: they are told by an agreement within moments, unless they are
// deaf or wait for a message that never comes.
constexpr unsigned seconds_for_others = 5;

// Ends a failed rank at once, after which the launcher ends the others.
void end_failed_rank_now(int code, std::string_view message) {
    for (const std::string_view text : {std::string_view("kerf: "), message, std::string_view("\n")})
        if (!message.empty()) (void)!::write(STDERR_FILENO, text.data(), text.size());
    ::_exit(code);
}

// Finds the processors of the ranks. Those that the launcher may use itself it could have given to its ranks: not all
// of the machine within the limits of a batch system. Where a shell lies between, that is bound like the rank, and
// nothing is known.
Ranks find_processors(MpiRanks& ranks) {
    Ranks joined;
    joined.launched = true;
    const HostProcessors host = host_processors(ranks);
    joined.cores_of_rank = host.share();
    joined.unbound_share = count_processors(allowed_processors(::getppid())) / static_cast<int>(host.allowed.size());
    joined.bound_to = count_processors(host.allowed[host.own]);
    for (const int processors : all_gather(ranks, joined.bound_to))
        joined.bound_to = std::min(joined.bound_to, processors);
    joined.mpi = &ranks;
    return joined;
}

Ranks join_mpi_ranks() {
    limit_wait_after_failure(seconds_for_others, end_failed_rank_now);
    auto ranks = std::make_unique<MpiRanks>();
    Ranks joined = run_together(*ranks, [&] { return find_processors(*ranks); });
    joined.communicator = std::move(ranks);
    return joined;
}

#endif

}  // namespace

bool is_first_rank() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (const char* rank = std::getenv(name)) return std::atoi(rank) == 0;
    return true;
}

Ranks join_ranks([[maybe_unused]] MpiUse use) {
#ifdef KERF_WITH_MPI
    if (use == MpiUse::always || is_launched()) return join_mpi_ranks();
#endif
    const int cores = count_processors(allowed_processors());
    return {std::make_unique<SingleRank>(), nullptr, cores, cores, cores};
}

std::string binding_note(const Ranks& ranks, int workers) {
    const int machine = machine_processors();
    if (workers > ranks.bound_to && machine > ranks.bound_to)
        return fmt::format("The {} workers of a rank share {} of {} processors, because {}", workers, ranks.bound_to,
                           machine,
                           ranks.launched ? "mpirun has bound it to them; mpirun --bind-to none lifts that."
                                          : "taskset or a batch system has bound it to them.");
    if (workers == 0 && ranks.unbound_share > ranks.bound_to)
        return fmt::format(
            "mpirun has bound a rank to {} processor{}, so that it has no more workers; mpirun "
            "--bind-to none gives it {}.",
            ranks.bound_to, ranks.bound_to == 1 ? "" : "s", ranks.unbound_share);
    return "";
}

}  // namespace kerf

#include "base/mpi/host_processors.h"

#include "base/parallel/processors.h"

namespace kerf {

int HostProcessors::share() const { return share_of_processors(allowed, own); }

HostProcessors host_processors(const MpiRanks& ranks) {
    HostProcessors host;
    for (const Bytes& bytes : ranks.gather_on_host(to_bytes(allowed_processors()), host.own))
        host.allowed.push_back(from_bytes<std::vector<int>>(bytes));
    return host;
}

}  // namespace kerf

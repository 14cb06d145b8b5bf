// A run folder that the ranks write together.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/parallel/communicator.h"
#include "files/io/run_folder.h"

namespace kerf {

/// Returns the folder that `create` makes on the root rank, which the other ranks join. Collective; throws Error on
/// every rank alike.
template <class Create>
RunFolder open_together(Communicator& ranks, Create create) {
    std::optional<RunFolder> folder;
    const std::string partial = in_agreement(ranks, [&] {
        if (ranks.rank() != 0) return std::string();
        folder.emplace(create());
        return folder->partial_path();
    });
    const std::string shared = all_gather(ranks, partial).front();
    in_agreement(ranks, [&] {
        if (!folder) folder.emplace(RunFolder::join(shared));
    });
    return std::move(*folder);
}

}  // namespace kerf

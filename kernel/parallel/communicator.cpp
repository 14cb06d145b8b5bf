#include "parallel/communicator.h"
#include "core/out_of_memory.h"

#include <algorithm>

namespace kerf {

StageStatus status_of_exception() {
    try {
        throw;
    } catch (const Error& e) {
        return {static_cast<int>(e.code()), e.what(), e.elements()};
    } catch (const std::exception& e) {
        if (is_out_of_memory(e))
            return {static_cast<int>(ErrorCode::memory), "Out of memory. Use more parts, fewer workers or more hosts."};
        return {static_cast<int>(ErrorCode::internal), e.what()};
    }
}

void throw_first_error(Communicator& ranks, const StageStatus& own) {
    constexpr int cancelled = static_cast<int>(ErrorCode::cancelled);
    const std::vector<StageStatus> all = all_gather(ranks, own);
    const auto failed = [](const StageStatus& status) { return status.code != 0 && status.code != cancelled; };
    auto first = std::find_if(all.begin(), all.end(), failed);
    if (first == all.end())
        first = std::find_if(all.begin(), all.end(), [](const StageStatus& status) { return status.code != 0; });
    if (first != all.end()) throw first->error();
}

}  // namespace kerf

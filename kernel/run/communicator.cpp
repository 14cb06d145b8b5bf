#include "run/communicator.h"

namespace kerf {

void throw_first_error(Communicator& ranks, const StageStatus& own) {
    for (const StageStatus& status : all_gather(ranks, own))
        if (status.code) throw Error(static_cast<ErrorCode>(status.code), status.message);
}

}  // namespace kerf

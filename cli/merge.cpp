#include "cli/merge.h"

#include <fmt/format.h>

#include "io/standard_streams.h"

namespace kerf {

int merge_command(const MergeRequest& request, bool quiet) {
    const MergedFile merged = merge_run(request);
    if (!quiet)
        tell(fmt::format("kerf: {}: {} vertices, {} tetrahedra, {:.1f} MB\n", request.output, merged.vertices,
                         merged.tets, static_cast<double>(merged.bytes) * 1e-6));
    return 0;
}

}  // namespace kerf

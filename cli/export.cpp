#include "cli/export.h"

#include <fmt/format.h>

#include "cli/progress.h"
#include "cli/ranks.h"
#include "core/error.h"
#include "core/number_text.h"
#include "io/standard_streams.h"

namespace kerf {

int export_formats(ExportRequest request, bool quiet) {
    const Ranks ranks = join_ranks();
    const bool root = ranks.communicator->rank() == 0;
    if (request.threads == 0) request.threads = ranks.cores_of_rank;
    try {
        ExportSummary summary;
        {
            ProgressLine progress(quiet || !root, nullptr);
            summary = export_run(request, *ranks.communicator, &progress);
        }
        std::int64_t bytes = 0;
        for (const RunFile& file : summary.files) bytes += file.bytes;
        if (root && !quiet)
            tell(fmt::format("kerf: {}: {} in {} part{}, {} tetrahedra, {} files, {:.1f} MB\n", summary.folder,
                             request.formats, summary.pieces, summary.pieces == 1 ? "" : "s", grouped(summary.tets),
                             summary.files.size(), static_cast<double>(bytes) * 1e-6));
        return 0;
    } catch (const Error& e) {
        if (root) tell(fmt::format("kerf: {}\n", e.what()));
        return static_cast<int>(e.code());
    }
}

}  // namespace kerf

#include "cli/remesh.h"

#include <fmt/format.h>

#include "cli/progress.h"
#include "io/standard_streams.h"
#include "prepare/remeshed_file.h"
#include "report/report.h"

namespace kerf {

int remesh_surface(const RunOptions& options, const std::string& output, bool quiet) {
    RemeshedFile written;
    {
        ProgressLine progress(quiet, nullptr);
        written = remesh_file(options, output, &progress);
    }
    if (!quiet) tell(fmt::format("kerf: {}: {} facets, {}\n", output, written.facets, remeshing_text(written.done)));
    return 0;
}

}  // namespace kerf

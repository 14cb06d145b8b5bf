#include "cli/failed_parts.h"

#include <algorithm>

#include <fmt/format.h>

#include "files/io/run_folder.h"
#include "files/io/standard_streams.h"

namespace kerf {

void tell_failed_parts(const RunReport& report) {
    std::size_t failed = 0;
    for (const PartReport& part : report.parts) {
        if (!part.result.code) continue;
        const auto node = std::find_if(report.cut.nodes.begin(), report.cut.nodes.end(),
                                       [&](const TreeNode& candidate) { return candidate.id == part.id; });
        const Vec3& place = node->mass.centroid;
        ++failed;
        tell(
            fmt::format("kerf: part {} around ({:.6g}, {:.6g}, {:.6g}) could not be meshed: {} How to repeat and to "
                        "look at it: {}/failed/{}.\n",
                        part.id.value(), place.x(), place.y(), place.z(), part.result.message, report.folder.path,
                        failed_part_file_name(part.id)));
    }
    if (failed > 0 && failed < report.parts.size())
        tell(
            fmt::format("kerf: the other {} parts are in {}; kerf mesh --resume {} tries the failed ones again, if "
                        "wanted with other --timeout or --memory.\n",
                        report.parts.size() - failed, report.folder.path, report.request.output));
    if (report.folder.kept_valid_run)
        tell(fmt::format("kerf: {} keeps the older run, which is valid; this one is in {}.\n", report.request.output,
                         report.folder.path));
}

}  // namespace kerf

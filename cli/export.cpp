#include "cli/export.h"

#include <filesystem>

#include "export/format.h"
#include "part/run_parts.h"

namespace kerf {

int export_run(const ExportRequest& request) {
    const std::vector<const Format*> chosen = parse_formats(request.formats);
    const RunParts parts(request.folder);
    for (const Format* format : chosen) {
        const std::filesystem::path folder = request.output.empty() ? request.folder : request.output;
        ExportFiles files(chosen.size() == 1 && !request.output.empty() ? folder.string()
                                                                        : (folder / format->name).string());
        write_format(*format, parts, files);
    }
    return 0;
}

}  // namespace kerf

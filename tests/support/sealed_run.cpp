#include "support/sealed_run.h"

#include <nlohmann/json.hpp>

#include "files/io/file_bytes.h"
#include "files/io/folder_files.h"
#include "files/io/json.h"
#include "files/io/run_manifest.h"
#include "files/io/text_file.h"

namespace kerf::test {

void seal_run(const std::string& folder) {
    const std::string path = folder + "/report.json";
    auto report = parse_ordered_json(read_file(path));
    report.erase("report_hash");
    report["files"] = nlohmann::ordered_json::array();
    for (const std::string& file : list_files(folder)) {
        if (file == "report.json" || file.ends_with('/')) continue;
        const RunFile now = describe_file(folder, file);
        report["files"].push_back({{"path", file}, {"bytes", now.bytes}, {"hash", now.hash}});
    }
    write_text_file(path, sealed(json_text(report, 2) + "\n"));
}

}  // namespace kerf::test

// Parts are what they are, whether a run writes them from its stored parts or an export from the files of a run.
#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "export/cases.h"
#include "files/export/format.h"
#include "files/io/file_bytes.h"
#include "files/part/run_parts.h"
#include "support/all_formats.h"
#include "support/temporary_folder.h"

namespace kerf::run_formats_test {
namespace {

std::map<std::string, std::string> bytes_by_name(const std::string& folder) {
    std::map<std::string, std::string> bytes;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file())
            bytes[entry.path().lexically_relative(folder).string()] = read_file(entry.path().string());
    return bytes;
}

TEST(RunFormats, ARunWritesWhatAnExportWrites) {
    const auto& cases = test::export_cases();
    const auto voids = std::find_if(cases.begin(), cases.end(), [](const auto& each) { return each.name == "voids"; });
    ASSERT_NE(voids, cases.end());
    const std::string run_folder = test::run_of(*voids, test::all_formats());
    const RunParts run(run_folder);
    for (const Format* format : formats()) {
        if (std::string_view(format->name) == "vtu") continue;  // its files are what the export reads
        SCOPED_TRACE(format->name);
        const test::TemporaryFolder folder;
        ExportFiles files(folder.file("export"));
        write_format(*format, run, files);
        const auto exported = bytes_by_name(folder.file("export"));
        const auto written = bytes_by_name(run_folder + "/export/" + format->name);
        EXPECT_FALSE(exported.empty());
        ASSERT_EQ(written.size(), exported.size());
        for (const auto& [name, bytes] : exported)
            EXPECT_TRUE(written.contains(name) && written.at(name) == bytes) << name;
    }
}

}  // namespace
}  // namespace kerf::run_formats_test

// kerf verify looks at parts on threads, and says the same for any number of them.
#include <filesystem>
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/core/threads.h"
#include "export/cases.h"
#include "files/io/folder_files.h"
#include "run/run/verify_folder.h"
#include "support/temporary_folder.h"

namespace kerf::verify_threads_test {
namespace {

// With another byte in some of the files.
void damage(const std::string& folder, unsigned seed) {
    std::mt19937 engine(seed);
    std::vector<std::string> files = list_files(folder);
    std::erase_if(files, [](const std::string& file) { return !file.starts_with("parts/") || file.ends_with('/'); });
    for (int i = 0; i < 3; ++i) {
        const std::string path = folder + "/" + files[engine() % files.size()];
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(engine() % std::filesystem::file_size(path)));
        file.put(static_cast<char>(engine()));
    }
}

std::string found_with(int threads, const std::string& folder) {
    set_thread_limit(threads);
    try {
        return to_json(verify_folder(folder), folder, {});
    } catch (const Error& error) {
        return error.what();
    }
}

TEST(VerifyThreads, FindTheSameForAnyNumber) {
    const std::string& run = test::run_of(test::export_cases()[3]);
    EXPECT_NE(found_with(3, run).find("\"passed\": true"), std::string::npos);
    int found = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        SCOPED_TRACE(seed);
        const test::TemporaryFolder folder;
        const std::string copy = folder.file("run");
        std::filesystem::copy(run, copy, std::filesystem::copy_options::recursive);
        damage(copy, seed);
        const std::string alone = found_with(1, copy);
        for (const int threads : {2, 5}) EXPECT_EQ(found_with(threads, copy), alone);
        found += alone.find("\"passed\": true") == std::string::npos;
    }
    EXPECT_GE(found, 11) << "of 12: a byte may be what it was";
    set_thread_limit(static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace
}  // namespace kerf::verify_threads_test

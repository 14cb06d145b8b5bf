// A folder of its own for each test, removed at its end.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace kerf::test {

class TemporaryFolder {
 public:
    TemporaryFolder() : path_(unused_path()) { std::filesystem::create_directories(path_); }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::string file(const std::string& name) const { return path_ + "/" + name; }
    /// Names of what lies in the folder, sorted.
    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

 private:
    static std::string unused_path() {
        static int count = 0;
        return testing::TempDir() + "kerf_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++);
    }
    std::string path_;
};

}  // namespace kerf::test

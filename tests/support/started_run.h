// A program that is under way, and the processes below it: to be interrupted, killed, or waited for.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "support/file_contents.h"
#include "volume/child_process.h"

namespace kerf::test {

/// Polls until the condition holds, at most 60 s; false if it never does.
template <class Condition>
bool await(Condition condition) {
    for (int i = 0; i < 6000; ++i) {
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

inline std::vector<pid_t> children_of(pid_t process) {
    const std::string id = std::to_string(process);
    std::istringstream list(bytes_of_file("/proc/" + id + "/task/" + id + "/children"));
    return {std::istream_iterator<pid_t>(list), {}};
}

/// The processes below one that have the name. Nothing below those: a child has its parent's name until it begins its
/// own program.
inline std::vector<pid_t> descendants_of(pid_t process, const std::string& name) {
    std::vector<pid_t> found;
    for (const pid_t child : children_of(process)) {
        if (bytes_of_file("/proc/" + std::to_string(child) + "/comm") == name + "\n") {
            found.push_back(child);
            continue;
        }
        for (const pid_t grandchild : descendants_of(child, name)) found.push_back(grandchild);
    }
    return found;
}

/// Ended, or waiting for its parent to notice.
inline bool has_ended(pid_t process) {
    const std::string stat = bytes_of_file("/proc/" + std::to_string(process) + "/stat");
    const std::size_t name_end = stat.rfind(')');
    return name_end == std::string::npos || stat.substr(name_end + 2, 1) == "Z";
}

class StartedRun {
 public:
    StartedRun(const std::string& program, const std::vector<std::string>& arguments) {
        constexpr double timeout_seconds = 300;
        const std::vector<pid_t> before = children_of(::getpid());
        pool_.start(0, program, arguments, {}, timeout_seconds);
        for (const pid_t child : children_of(::getpid()))
            if (std::find(before.begin(), before.end(), child) == before.end()) process_ = child;
    }
    pid_t process() const { return process_; }
    std::vector<pid_t> workers() const { return descendants_of(process_, "kerf-worker"); }
    ChildResult wait() { return pool_.wait_any()->result; }

 private:
    ChildPool pool_;
    pid_t process_ = -1;
};

/// Number of parts that the run into `output` has in its journal.
inline std::size_t finished_parts(const std::string& output) {
    std::error_code error;
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(output + ".kerf-partial/work/journal", error))
        count += entry.path().extension().empty() ? 1 : 0;
    return count;
}

}  // namespace kerf::test

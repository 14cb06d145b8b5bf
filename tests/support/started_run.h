// A program that is under way, and the processes below it: to be interrupted, killed, or waited for.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <ios>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "fill/volume/child_process.h"
#include "support/file_contents.h"

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

/// What the system tells of a process in one of its files; empty if the process has ended, be it while the file is
/// read.
inline std::string told_of(pid_t process, const std::string& file) {
    try {
        return bytes_of_file("/proc/" + std::to_string(process) + "/" + file);
    } catch (const std::ios_base::failure&) {
        return "";
    }
}

inline std::vector<pid_t> children_of(pid_t process) {
    std::istringstream list(told_of(process, "task/" + std::to_string(process) + "/children"));
    return {std::istream_iterator<pid_t>(list), {}};
}

/// The processes below one that have the name. Nothing below those: a child has its parent's name until it begins its
/// own program.
inline std::vector<pid_t> descendants_of(pid_t process, const std::string& name) {
    std::vector<pid_t> found;
    for (const pid_t child : children_of(process)) {
        if (told_of(child, "comm") == name + "\n") {
            found.push_back(child);
            continue;
        }
        for (const pid_t grandchild : descendants_of(child, name)) found.push_back(grandchild);
    }
    return found;
}

/// What the system tells of a process behind its name: its state, its parent, ...; empty if there is none.
inline std::string status_of(pid_t process) {
    const std::string stat = told_of(process, "stat");
    const std::size_t name_end = stat.rfind(')');
    return name_end == std::string::npos ? "" : stat.substr(name_end + 2);
}

/// Ended, or waiting for its parent to notice.
inline bool has_ended(pid_t process) {
    const std::string status = status_of(process);
    return status.empty() || status.front() == 'Z';
}

/// Seconds of processor time that a process has taken.
inline double seconds_computed(pid_t process) {
    std::istringstream status(status_of(process));
    constexpr int fields_before = 11;
    std::string other;
    for (int i = 0; i < fields_before; ++i) status >> other;
    double ticks = 0;
    status >> ticks;
    return ticks / static_cast<double>(::sysconf(_SC_CLK_TCK));
}

/// Whether a worker has asked to end with its parent, after which its standard output is its standard error
/// (cli/worker_main.cpp).
inline bool ends_with_parent(pid_t worker) {
    const std::string descriptors = "/proc/" + std::to_string(worker) + "/fd/";
    std::error_code error;
    const auto output = std::filesystem::read_symlink(descriptors + "1", error);
    return !error && output == std::filesystem::read_symlink(descriptors + "2", error);
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
    /// Waits for a worker and stops it in the middle of its part. From then on it ends only if somebody ends it, and
    /// the run cannot be complete, however slow the machine is. -1 if none comes.
    pid_t stop_worker() const {
        constexpr double well_begun_seconds = 0.05;
        pid_t stopped = -1;
        await([&] {
            for (const pid_t worker : workers()) {
                if (!ends_with_parent(worker) || seconds_computed(worker) < well_begun_seconds ||
                    ::kill(worker, SIGSTOP) != 0)
                    continue;
                await([&] { return has_ended(worker) || status_of(worker).starts_with('T'); });
                if (!has_ended(worker)) stopped = worker;
            }
            return stopped > 0;
        });
        return stopped;
    }
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
